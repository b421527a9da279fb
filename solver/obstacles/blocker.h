#pragma once
#include <Eigen/Core>
#include <vector>

#include "scenes/room.h"
#include "solver/factors/facet.h"

namespace solver {

/// A convex body that stops light: a part of furniture, or of a wall as a plate with two faces.
struct Blocker {
  struct Face {
    Plane plane;               ///< outside is in front
    std::vector<int> corners;  ///< into Blocker::corners, counter-clockwise seen from outside
  };

  std::vector<Eigen::Vector3d> corners;
  std::vector<Face> faces;
  std::vector<Plane>
      guards;  ///< at most kMostGuards, with all of it behind: faces, or a box around
};

inline constexpr std::size_t kMostGuards = 7;

/// Furniture, and those faces of the shell that have some of the room behind them.
[[nodiscard]] std::vector<Blocker> blockers_of(const scenes::Room& room);

/// What is in front of a plane. A blocker that crosses it falls apart into plates, which together
/// hide the same.
[[nodiscard]] std::vector<Blocker> in_front_of(const std::vector<Blocker>& blockers,
                                               const Plane& plane);

/// Where light comes from, in homogeneous coordinates: a point (x, y, z, 1), or a direction towards
/// the sun (x, y, z, 0).
using LightOrigin = Eigen::Vector4d;

[[nodiscard]] inline LightOrigin from_point(const Eigen::Vector3d& point) {
  return {point.x(), point.y(), point.z(), 1};
}

[[nodiscard]] inline LightOrigin from_direction(const Eigen::Vector3d& towards_light) {
  return {towards_light.x(), towards_light.y(), towards_light.z(), 0};
}

/// What blockers hide from a light. The shadow of a convex body is convex: what lies behind its lit
/// faces, within the planes through the light and the edges that part lit faces from unlit ones. No
/// ray, no sampling: exact to rounding.
class Shadows {
 public:
  Shadows(const std::vector<Blocker>& blockers, const LightOrigin& light);

  [[nodiscard]] bool contain(const Eigen::Vector3d& point) const;

  /// The part of a convex polygon that the light reaches, as convex pieces that do not overlap: the
  /// polygon itself where no shadow falls on it, none where it is hidden.
  [[nodiscard]] std::vector<std::vector<Eigen::Vector3d>> lit_parts(
      const std::vector<Eigen::Vector3d>& polygon) const;

 private:
  using Shadow = std::vector<Plane>;  ///< dark in front of all of them

  std::vector<Shadow> shadows_;
};

}  // namespace solver
