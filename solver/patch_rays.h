#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "scenes/patch_mesh.h"

namespace solver {

/// What a ray meets first.
struct RayHit {
  int patch = -1;           ///< -1: nothing, which a closed room does not know
  Eigen::Vector3d point_m;  ///< on the plane of the patch
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

 private:
  const scenes::PatchMesh& mesh_;
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace solver
