#pragma once
#include <span>
#include <vector>

#include "scenes/room.h"

namespace scenes {

/// A ceiling's plane over the plan: z = height + slope . (x, y).
struct RoofPlane {
  double height_m = 0;  ///< over the origin
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();

  [[nodiscard]] double over(const Eigen::Vector2d& p) const { return height_m + slope.dot(p); }
};

/// Through three corners at least, by the plane of their outline.
[[nodiscard]] RoofPlane roof_plane_of(const Outline& corners);

/// Rises from a wall to the left of it, into the room.
[[nodiscard]] RoofPlane pitched_plane(const Line& wall, double height_m, double pitch_deg);

/// Of the lowest plane.
[[nodiscard]] double height_below(std::span<const RoofPlane> planes, const Eigen::Vector2d& p);

/// A room under several planes, of which the lowest counts: floor (surface 0), ceiling (1, a face
/// for each plane, more if the plan is not convex), walls (2, 3, ...). Under one level plane a
/// prism.
/// @param plan_m  simple, counter-clockwise
/// @param planes  above 0 over all of the plan
[[nodiscard]] std::vector<ShellFace> roofed_shell(const Polygon& plan_m,
                                                  const std::vector<RoofPlane>& planes);

}  // namespace scenes
