#pragma once
#include <Eigen/Core>
#include <functional>
#include <vector>

namespace scenes {

/// Nodes and weights of Gauss-Legendre on [0, 1], for any number of points.
struct GaussLegendre {
  explicit GaussLegendre(int points);

  std::vector<double> node, weight;
};

/// Calls add(direction, solid angle) for the directions of a quadrature over the part of the sphere
/// that is in front of all planes through its centre, n . d > 0. Polar about an axis, which may be
/// where the integrand has a cusp; cut in azimuth where two planes meet. Good to 1e-9 for
/// integrands that are smooth but there.
void for_directions(const Eigen::Vector3d& axis, const std::vector<Eigen::Vector3d>& planes,
                    const std::function<void(const Eigen::Vector3d&, double)>& add);

}  // namespace scenes
