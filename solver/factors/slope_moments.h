#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "solver/factors/facet.h"
#include "solver/factors/point_factors.h"
#include "solver/factors/slope_basis.h"

namespace solver {

/// Order of the far rule for the moments of two facets (centre distance / larger size): it need not
/// be as good as that of the exchange area, which is kept; 0: too near.
[[nodiscard]] inline int slope_order(double distance_over_size) {
  if (distance_over_size >= 8) return 2;
  if (distance_over_size >= 3.5) return 3;
  return distance_over_size >= 1.6 ? 4 : 0;
}

/// Moments of the form factor kernel K with the functions 1, psi_1, psi_2 of patches that nothing
/// hides.
class SlopeMoments {
 public:
  /// @param facets  must outlive this
  explicit SlopeMoments(const std::vector<Facet>& facets);

  [[nodiscard]] const std::vector<SlopeBasis>& bases() const { return bases_; }

  /// sum_k F_k (1, psi_1, psi_2) over the parts of a patch, seen from a surface element: F is exact
  /// [Lambert1760]; for psi it is taken that the kernel hardly bends on a part, a quarter as long
  /// as the patch.
  [[nodiscard]] Eigen::Vector3d from_point(const Eigen::Vector3d& point,
                                           const Eigen::Vector3d& normal, std::size_t patch) const;

  /// <psi_a, K psi_b> of near patches, also touching ones, a on i and b on j, m^2: Gauss points on
  /// the smaller, which crowd at its edges, from_point over the larger.
  [[nodiscard]] Eigen::Matrix3d near(std::size_t i, std::size_t j) const;

 private:
  const std::vector<Facet>& facets_;
  std::vector<SlopeBasis> bases_;
  PointFactors parts_;
  std::vector<std::size_t> first_part_;  ///< of each patch, and one past the last
  Eigen::Matrix2Xd slopes_;              ///< of all parts
};

}  // namespace solver
