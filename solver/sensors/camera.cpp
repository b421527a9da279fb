#include "solver/sensors/camera.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace solver {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double kUpright = 1e-9;  ///< sine from the vertical at which the y axis is up

}  // namespace

Camera::Camera(const Vector3d& eye_m, const Vector3d& look_at_m, double fov_deg, int width,
               int height)
    : eye_m_(eye_m), width_(width), height_(height) {
  const Vector3d axis = look_at_m - eye_m;
  if (!(axis.norm() > 0) || !axis.allFinite()) {
    throw std::invalid_argument("the camera looks at itself");
  }
  if (!(fov_deg > 0 && fov_deg < 180)) {
    throw std::invalid_argument("a field of view lies above 0 and below 180 degrees");
  }
  if (width < 1 || height < 1) throw std::invalid_argument("a picture has one pixel at least");
  forward_ = axis.normalized();
  const Vector3d side = forward_.cross(Vector3d::UnitZ());
  right_ = (side.norm() > kUpright ? side : forward_.cross(Vector3d::UnitY())).normalized();
  up_ = right_.cross(forward_);
  const double tangent = std::tan(fov_deg * std::numbers::pi / 360);
  pixels_per_tangent_ = width / (2 * tangent);
  per_column_ = right_ / pixels_per_tangent_;
  per_row_ = -up_ / pixels_per_tangent_;
  corner_ = forward_ - 0.5 * width * per_column_ - 0.5 * height * per_row_;
}

Vector2d Camera::film_of(const Vector3d& point_m) const {
  const Vector3d r = point_m - eye_m_;
  const double scale = pixels_per_tangent_ / forward_.dot(r);
  return {0.5 * width_ + scale * right_.dot(r), 0.5 * height_ - scale * up_.dot(r)};
}

}  // namespace solver
