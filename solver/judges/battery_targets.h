#pragma once
#include <Eigen/Core>
#include <cmath>
#include <numbers>

namespace solver {

/// A rectangle in a plane that a surface element looks at or along, and the plane's distance.
struct Target {
  Eigen::Vector2d low_m, high_m;
  double distance_m = 0;

  /// Sum of f over the corners with the signs of a double integral.
  template <typename Function>
  [[nodiscard]] double corners(Function f) const {
    return f(high_m.x(), high_m.y()) - f(low_m.x(), high_m.y()) - f(high_m.x(), low_m.y()) +
           f(low_m.x(), low_m.y());
  }
};

/// Element at the origin that faces a parallel plane at distance h: the integral of
/// cos^2 / (pi r^2) = h^2 / (pi r^4) over [0, x] x [0, y] is
/// (x/a atan(y/a) + y/b atan(x/b)) / 2pi with a^2 = x^2 + h^2, b^2 = y^2 + h^2.
inline double facing_factor(const Target& target) {
  return target.corners([h = target.distance_m](double x, double y) {
    const double a = std::hypot(x, h), b = std::hypot(y, h);
    return (x / a * std::atan(y / a) + y / b * std::atan(x / b)) / (2 * std::numbers::pi);
  });
}

/// Element whose normal points along the plane, along its x >= 0: h x / (pi r^4) integrates to
/// -h/a atan(y/a) / 2pi, up to a function of y alone; a^2 = x^2 + h^2.
inline double sideways_factor(const Target& target) {
  return target.corners([h = target.distance_m](double x, double y) {
    const double a = std::hypot(x, h);
    return -h / a * std::atan(y / a) / (2 * std::numbers::pi);
  });
}

}  // namespace solver
