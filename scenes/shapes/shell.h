#pragma once
#include <vector>

#include "scenes/room.h"

namespace scenes {

/// A prism: floor (surface 0), ceiling (1), and a wall for each edge of the plan (2, 3, ...).
/// @param plan_m  corners, counter-clockwise seen from above
/// @throws std::invalid_argument  if it has no area to its left, or the height is not above 0
[[nodiscard]] std::vector<ShellFace> prism_shell(const Polygon& plan_m, double height_m);

/// Frame of a slanting or upright plane: level along, up; of a level one: x and y.
/// @param normal  unit, into the air
[[nodiscard]] Frame frame_of_plane(const Eigen::Vector3d& origin_m, const Eigen::Vector3d& normal);

/// A rectangle in a frame's plane, from the low corner to the high one, counter-clockwise seen from
/// the air.
[[nodiscard]] Outline rectangle_in(const Frame& frame, const Eigen::Vector2d& low_m,
                                   const Eigen::Vector2d& high_m);

}  // namespace scenes
