#include "scenes/shapes/shell.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scenes/shapes/bodies.h"

namespace scenes {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Frame frame_of_wall(const Vector2d& from, const Vector2d& to) {
  // stableNormalized: exactly 1 along an axis, so that axis-aligned rooms have exact patches.
  const Vector2d along = (to - from).stableNormalized();
  return {.origin_m = {from.x(), from.y(), 0},
          .along = {along.x(), along.y(), 0},
          .up = Vector3d::UnitZ(),
          .normal = {-along.y(), along.x(), 0}};
}

}  // namespace

Frame frame_of_plane(const Vector3d& origin_m, const Vector3d& normal) {
  const Vector3d z = Vector3d::UnitZ();
  if (normal.cross(z).norm() < kCoplanar_m) {
    return {.origin_m = origin_m,
            .along = Vector3d::UnitX(),
            .up = Vector3d::UnitY(),
            .normal = normal};
  }
  const Vector3d up = (z - z.dot(normal) * normal).stableNormalized();
  return {.origin_m = origin_m, .along = normal.cross(up), .up = up, .normal = normal};
}

std::vector<ShellFace> prism_shell(const Polygon& plan_m, double height_m) {
  if (!(plan_m.size() > 2 && area(plan_m) > 0 && height_m > 0)) {  // so that NaN fails too
    throw std::invalid_argument("the plan is not counter-clockwise, or the height not above 0");
  }
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  std::vector<ShellFace> shell;
  for (Outline& face : prism_faces(plan_m, 0, height_m)) {
    std::ranges::reverse(face);  // seen from inside
    const std::size_t i = shell.size();
    shell.push_back({.surface = static_cast<int>(i), .outline = std::move(face)});
    if (i >= 2) shell[i].frame = frame_of_wall(plan_m[i - 2], plan_m[(i - 1) % plan_m.size()]);
  }
  shell[1].frame = {.origin_m = height_m * z, .along = x, .up = y, .normal = -z};
  return shell;
}

Outline rectangle_in(const Frame& frame, const Vector2d& low_m, const Vector2d& high_m) {
  const auto at = [&frame](double u, double v) -> Vector3d {
    return frame.origin_m + u * frame.along + v * frame.up;
  };
  Outline corners{at(low_m.x(), low_m.y()), at(high_m.x(), low_m.y()), at(high_m.x(), high_m.y()),
                  at(low_m.x(), high_m.y())};
  const bool mirrored = frame.along.cross(frame.up).dot(frame.normal) < 0;
  if (mirrored) std::ranges::reverse(corners);
  return corners;
}

}  // namespace scenes
