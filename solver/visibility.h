#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "scenes/patch_mesh.h"
#include "scenes/room.h"
#include "solver/blocker.h"
#include "solver/facet.h"

namespace solver {

class RayScene;

/// A point a row, m, relative to the middle of a RayScene.
using Points16 = Eigen::Array<float, 16, 3>;

/// Which blockers a convex set (patch or point) cannot have in its way. One byte per blocker: bits
/// 0..5 say that the set lies outside that face plane of the blocker, bit 7 that the blocker lies
/// behind the set's own plane.
using SeparationMask = std::vector<std::uint8_t>;

/// A share of light between two convex sets that gets past everything in between.
struct VisibleShare {
  double share = 1;           ///< 0..1, weighted by the kernel cos cos / r^2
  double standard_error = 0;  ///< 0 where no ray was needed or all rays agreed
};

/// What can stand between patches: furniture, and the walls of a plan that is not convex.
class Visibility {
 public:
  /// @param mesh  its patches can be asked about by number
  /// @param skip  false: every pair gets rays where there is anything to hit
  Visibility(const scenes::Room& room, const scenes::PatchMesh& mesh, bool skip = true);
  Visibility();  ///< nothing blocks anything
  ~Visibility();
  Visibility(const Visibility&) = delete;
  Visibility& operator=(const Visibility&) = delete;

  /// Nothing can block anything: an empty convex room.
  [[nodiscard]] bool unobstructed() const { return blockers_.empty(); }

  /// False only if no blocker can touch any segment between the two: some face plane of each
  /// blocker has both sets outside, or the blocker is behind one of them.
  [[nodiscard]] bool may_block(int patch_i, int patch_j) const;
  [[nodiscard]] bool may_block(const SeparationMask& set, int patch) const;
  [[nodiscard]] SeparationMask separation(const Eigen::Vector3d& point,
                                          const Eigen::Vector3d& normal) const;
  [[nodiscard]] SeparationMask separation(const Facet& facet) const;
  [[nodiscard]] static bool may_block(const SeparationMask& a, const SeparationMask& b);

  /// Rays between two patches, low-discrepancy, call it once per pair. The first 16 decide
  /// if they agree; else as many as `most_rays`.
  [[nodiscard]] VisibleShare between(const Facet& i, const Facet& j, std::uint64_t seed,
                                     int most_rays) const;

  [[nodiscard]] const std::vector<Blocker>& blockers() const { return blockers_; }

 private:
  template <typename Vertices>
  void separate(const Vertices& vertices, const Plane& own, std::uint8_t* mask) const;

  /// bit k set: segment k is blocked
  [[nodiscard]] std::uint32_t blocked16(const Points16& from, const Points16& to) const;

  bool skip_ = true;
  std::vector<Blocker> blockers_;
  std::vector<std::uint8_t> patch_masks_;  ///< patch x blocker
  std::unique_ptr<RayScene> scene_;
};

}  // namespace solver
