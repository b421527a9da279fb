#pragma once
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "scenes/room.h"

namespace scenes {

/// Bottom, top and sides of a prism, counter-clockwise seen from outside.
/// @param plan_m  counter-clockwise seen from above
[[nodiscard]] std::vector<Outline> prism_faces(const Polygon& plan_m, double low_m, double high_m);

/// @param rotate_z_deg  about its own centre, counter-clockwise from above
[[nodiscard]] Body box_body(std::string name, const Eigen::Vector3d& min_m,
                            const Eigen::Vector3d& max_m, double rotate_z_deg = 0);

/// @param plan_m  simple, counter-clockwise seen from above
[[nodiscard]] Body prism_body(std::string name, const Polygon& plan_m, double low_m, double high_m);

/// A regular polygon with as much area as the circle; its first corner lies on +x.
[[nodiscard]] Polygon regular_polygon(const Eigen::Vector2d& centre_m, double radius_m, int sides);

/// A flight of solid steps.
struct Stairs {
  Eigen::Vector3d foot_m;    ///< middle of the lowest edge
  double direction_deg = 0;  ///< in which one climbs, counter-clockwise from +x seen from above
  double width_m = 0, rise_m = 0, going_m = 0;  ///< of a step: its height and its depth
  int steps = 0;
};

[[nodiscard]] Body stairs_body(std::string name, const Stairs& stairs);

/// A thin polygon that reflects on both sides.
/// @param outline  plane and simple
[[nodiscard]] Body sheet_body(std::string name, const Outline& outline);

[[nodiscard]] Body moved(const Body& body, const Eigen::Isometry3d& motion);

}  // namespace scenes
