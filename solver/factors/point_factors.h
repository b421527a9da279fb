#pragma once
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace solver {

/// For the kernel: quadrilaterals and their factors.
struct Quads {
  std::array<std::array<const double*, 3>, 4> vertex_m;
  std::size_t count = 0;
  double* factor = nullptr;
};

/// Convex polygons whose form factors from a point are asked for all at once: `point_to_polygon` of
/// each, a quadrilateral to a lane of the vector.
class PointFactors {
 public:
  void add(const std::vector<Eigen::Vector3d>& polygon);

  [[nodiscard]] std::size_t size() const { return first_quad_.size() - 1; }

  /// From a surface element to the polygons from `first` to before `end`, in the order of adding,
  /// with the sign of `point_to_polygon`.
  [[nodiscard]] Eigen::VectorXd from(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                                     std::size_t first, std::size_t end) const;

  [[nodiscard]] Eigen::VectorXd from(const Eigen::Vector3d& point,
                                     const Eigen::Vector3d& normal) const {
    return from(point, normal, 0, size());
  }

 private:
  std::array<std::array<std::vector<double>, 3>, 4> vertex_m_;  ///< [corner][axis][quadrilateral]
  std::vector<std::size_t> first_quad_{0};  ///< of each polygon, and one past the last
};

}  // namespace solver
