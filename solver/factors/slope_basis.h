#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "solver/factors/facet.h"

namespace solver {

/// The functions that light on a patch is a sum of: 1, and two that are linear in the plane,
/// psi_a(x) = gradient_a . (x - centre). Over the patch they are orthogonal to each other and to 1,
/// and the mean of their squares is 1.
struct SlopeBasis {
  static constexpr int kModes = 3;  ///< 1, psi_1, psi_2

  std::array<Eigen::Vector3d, 2> gradient_per_m;  ///< in the plane; 0 along which there is no width

  /// psi_1 and psi_2 at an offset from the centre.
  [[nodiscard]] Eigen::Vector2d at(const Eigen::Vector3d& offset_m) const {
    return {gradient_per_m[0].dot(offset_m), gradient_per_m[1].dot(offset_m)};
  }
};

/// The first slope runs along the first edge.
[[nodiscard]] SlopeBasis slope_basis(const Facet& facet);
[[nodiscard]] std::vector<SlopeBasis> slope_bases(const std::vector<Facet>& facets);

/// A convex polygon as a fan of quadrilaterals, each cut into 4 x 4.
[[nodiscard]] std::vector<std::vector<Eigen::Vector3d>> parts_of(
    const std::vector<Eigen::Vector3d>& polygon);

/// The mean of the corners.
[[nodiscard]] Eigen::Vector3d middle_of(const std::vector<Eigen::Vector3d>& polygon);

/// psi_1 and psi_2 in the middles of a facet's parts, 2 x parts, stretched so that the mean of
/// their squares is 1 as that of the functions is: by 16 / 15 in parallelograms. So sum_k F_k psi_k
/// over the parts is the moment of a kernel that hardly bends on a part.
[[nodiscard]] Eigen::Matrix2Xd slopes_of_parts(const Facet& facet, const SlopeBasis& basis);

}  // namespace solver
