#pragma once
#include <Eigen/Core>
#include <vector>

#include "scenes/geometry/plane_polygon.h"

namespace scenes {

/// Corners of a plane polygon in space, counter-clockwise seen from the air, in metres.
using Outline = std::vector<Eigen::Vector3d>;

/// Half the sum of the cross products of its edges: its area times its normal, m^2 (Newell's rule).
[[nodiscard]] Eigen::Vector3d vector_area_m2(const Outline& outline);

/// Coordinates in the plane of an outline, the first along its longest edge.
class PlaneCoordinates {
 public:
  explicit PlaneCoordinates(const Outline& outline);

  [[nodiscard]] const Eigen::Vector3d& normal() const { return normal_; }

  /// The same plane, seen from the same side (facing = 1) or from the other (-1).
  [[nodiscard]] bool same_plane(const PlaneCoordinates& other, int facing) const;

  [[nodiscard]] double height_m(const Eigen::Vector3d& p) const {
    return normal_.dot(p) - offset_m_;
  }

  [[nodiscard]] Eigen::Vector3d lift(const Eigen::Vector2d& p) const {
    return offset_m_ * normal_ + p.x() * along_ + p.y() * up_;
  }

  [[nodiscard]] Eigen::Vector2d flatten(const Eigen::Vector3d& p) const {
    return {along_.dot(p), up_.dot(p)};
  }

  /// Counter-clockwise in the plane, whichever side `outline` is seen from.
  [[nodiscard]] Polygon flatten(const Outline& outline) const;

 private:
  Eigen::Vector3d along_, up_, normal_;
  double offset_m_ = 0;
};

/// Faces nearer than this touch.
inline constexpr double kCoplanar_m = 1e-9;

}  // namespace scenes
