#pragma once
#include <Eigen/Core>
#include <functional>
#include <limits>
#include <vector>

#include "solver/factors/facet.h"
#include "solver/factors/slope_basis.h"

namespace solver {

/// Luminous intensity by direction, as the quadrature asks for it; directions away from the light,
/// of any length.
struct Intensity {
  std::function<double(const Eigen::Vector3d&)> at;
  /// At least the largest intensity within an angle around a direction.
  std::function<double(const Eigen::Vector3d&, double radius_rad)> most_within;
  /// Smaller cones than this hold no peak that the quadrature could miss; infinite: there is none.
  double finest_rad = std::numeric_limits<double>::infinity();
};

/// Integral of I cos / r^2 over a part of a facet that shows its front to the light, cd sr; and the
/// same with psi_1 and psi_2 if there is a basis. Product Gauss on quadrilaterals that are
/// quartered until two orders agree within `tolerance` times the area, none reaches farther than
/// the light is away, and no peak can hide between the points.
[[nodiscard]] Eigen::Vector3d lit_flux(const std::vector<Eigen::Vector3d>& part, const Facet& facet,
                                       const SlopeBasis* basis, const Eigen::Vector3d& light_m,
                                       const Intensity& intensity, double tolerance);

}  // namespace solver
