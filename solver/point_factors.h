#pragma once
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace solver {

/// For the kernel: quadrilaterals, their factors, and how far they reach above the horizon, m.
struct Quads {
  std::array<std::array<const double*, 3>, 4> vertex_m;
  std::size_t count = 0;
  double *factor = nullptr, *lowest_m = nullptr, *highest_m = nullptr;
};

/// Convex polygons whose form factors from a point are asked for all at once: `point_to_polygon` of
/// each, a quadrilateral to a lane of the vector.
class PointFactors {
 public:
  void add(const std::vector<Eigen::Vector3d>& polygon);

  /// From a surface element, in the order of adding, with the sign of `point_to_polygon`.
  [[nodiscard]] Eigen::VectorXd from(const Eigen::Vector3d& point,
                                     const Eigen::Vector3d& normal) const;

 private:
  std::array<std::array<std::vector<double>, 3>, 4> vertex_m_;  ///< [corner][axis][quadrilateral]
  std::vector<Eigen::Index> polygon_;                           ///< that a quadrilateral is part of
};

}  // namespace solver
