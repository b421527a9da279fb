#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "scenes/mesh/patch_mesh.h"
#include "scenes/room.h"
#include "solver/factors/facet.h"
#include "solver/factors/slope_basis.h"
#include "solver/obstacles/blocker.h"
#include "solver/obstacles/segments.h"

namespace solver {

/// Which blockers a convex set (patch or point) cannot have in its way. One byte per blocker: bits
/// 0..6 say that the set lies outside that guard of the blocker, bit 7 that the blocker lies behind
/// the set's own plane.
using SeparationMask = std::vector<std::uint8_t>;

/// A share of light between two convex sets that gets past everything in between.
struct VisibleShare {
  double share = 1;           ///< 0..1, weighted by the kernel cos cos / r^2
  double standard_error = 0;  ///< 0 where no ray was needed or all rays agreed
};

/// What can stand between patches: furniture, and the shell of a room that is not convex.
class Visibility {
 public:
  /// @param mesh  its patches can be asked about by number
  /// @param skip  false: every blocker is tried for every pair
  Visibility(const scenes::Room& room, const scenes::PatchMesh& mesh, bool skip = true);
  Visibility() = default;  ///< nothing blocks anything

  /// Nothing can block anything: an empty convex room.
  [[nodiscard]] bool unobstructed() const { return blockers_.empty(); }

  /// False only if no blocker can touch any segment between the two: some guard of each blocker has
  /// both sets outside, or the blocker is behind one of them.
  [[nodiscard]] bool may_block(int patch_i, int patch_j) const;
  [[nodiscard]] bool may_block(const SeparationMask& set, int patch) const;
  [[nodiscard]] SeparationMask separation(const Eigen::Vector3d& point,
                                          const Eigen::Vector3d& normal) const;
  [[nodiscard]] SeparationMask separation(const Facet& facet) const;
  [[nodiscard]] std::span<const std::uint8_t> separation(int patch) const;
  [[nodiscard]] static bool may_block(std::span<const std::uint8_t> a,
                                      std::span<const std::uint8_t> b);

  /// Segments between two patches, low-discrepancy, call it once per pair. The first 16 decide
  /// if they agree; else as many as `most_rays`. Only blockers that the masks leave are tried.
  [[nodiscard]] VisibleShare between(const Facet& i, std::span<const std::uint8_t> mask_i,
                                     const Facet& j, std::span<const std::uint8_t> mask_j,
                                     std::uint64_t seed, int most_rays) const;

  /// What is hidden of the moments <psi_a, K psi_b> of two patches, a on i and b on j, as a share
  /// of all of their A_i F_ij, by the rays of `between`.
  [[nodiscard]] Eigen::Matrix3d hidden_moments(const Facet& i, const SlopeBasis& basis_i,
                                               std::span<const std::uint8_t> mask_i, const Facet& j,
                                               const SlopeBasis& basis_j,
                                               std::span<const std::uint8_t> mask_j,
                                               std::uint64_t seed, int most_rays) const;

  [[nodiscard]] const std::vector<Blocker>& blockers() const { return blockers_; }

 private:
  template <typename Add>
  [[nodiscard]] bool follow_rays(const Facet& i, std::span<const std::uint8_t> mask_i,
                                 const Facet& j, std::span<const std::uint8_t> mask_j,
                                 std::uint64_t seed, int most_rays, VisibleShare& agreed,
                                 const Add& add) const;
  template <typename Vertices>
  void separate(const Vertices& vertices, const Plane& own, std::uint8_t* mask) const;

  bool skip_ = true;
  std::vector<Blocker> blockers_;
  std::vector<std::uint8_t> patch_masks_;  ///< patch x blocker
  Segments segments_;
};

}  // namespace solver
