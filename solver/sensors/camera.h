#pragma once
#include <Eigen/Core>

namespace solver {

/// A perspective camera with square pixels. Film points are in pixels: s to the right from the left
/// edge, t down from the top, so pixel (column x, row y) covers [x, x + 1] x [y, y + 1].
class Camera {
 public:
  /// @param fov_deg  horizontal field of view, above 0 and below 180
  /// @throws std::invalid_argument  if the eye looks at itself, or a number is out of its range
  Camera(const Eigen::Vector3d& eye_m, const Eigen::Vector3d& look_at_m, double fov_deg, int width,
         int height);

  [[nodiscard]] const Eigen::Vector3d& eye_m() const { return eye_m_; }

  [[nodiscard]] int width() const { return width_; }

  [[nodiscard]] int height() const { return height_; }

  /// From the eye through a film point; 1 along the axis.
  [[nodiscard]] Eigen::Vector3d direction(const Eigen::Vector2d& film) const {
    return corner_ + film.x() * per_column_ + film.y() * per_row_;
  }

  /// How far a point is in front of the eye, along the axis.
  [[nodiscard]] double depth_m(const Eigen::Vector3d& point_m) const {
    return forward_.dot(point_m - eye_m_);
  }

  /// The film point of a point in front of the eye.
  [[nodiscard]] Eigen::Vector2d film_of(const Eigen::Vector3d& point_m) const;

  [[nodiscard]] const Eigen::Vector3d& forward() const { return forward_; }

 private:
  Eigen::Vector3d eye_m_, forward_, right_, up_;
  Eigen::Vector3d corner_, per_column_, per_row_;
  double pixels_per_tangent_ = 0;
  int width_, height_;
};

}  // namespace solver
