#pragma once
#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "scenes/mesh/patch_mesh.h"

namespace solver {

/// What a ray meets first.
struct RayHit {
  int patch = -1;           ///< -1: nothing, which a closed room does not know
  Eigen::Vector3d point_m;  ///< on the plane of the patch
};

/// Rays in one direction from places near each other, traced together.
inline constexpr int kRayPacket = 16;

struct ParallelHits {
  std::array<int, kRayPacket> patch{};  ///< -1: nothing, or a patch from behind
  std::array<double, kRayPacket> distance_m{};
};

/// Rays against the patches themselves: which patch is seen in a direction.
class PatchRays {
 public:
  explicit PatchRays(const scenes::PatchMesh& mesh);
  ~PatchRays();
  PatchRays(const PatchRays&) = delete;
  PatchRays& operator=(const PatchRays&) = delete;

  [[nodiscard]] RayHit first_hit(const Eigen::Vector3d& origin,
                                 const Eigen::Vector3d& direction) const;

  /// @param direction  unit
  /// @param count  how many of the origins are there
  [[nodiscard]] ParallelHits first_hits(const std::array<Eigen::Vector3d, kRayPacket>& origin,
                                        int count, const Eigen::Vector3d& direction) const;

 private:
  const scenes::PatchMesh& mesh_;
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace solver
