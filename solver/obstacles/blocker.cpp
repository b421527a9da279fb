#include "solver/obstacles/blocker.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "scenes/shapes/plates.h"

namespace solver {
namespace {

using Eigen::Vector3d;
using Polygon = std::vector<Vector3d>;

constexpr double kTouching_m = 1e-9;
constexpr double kGrazing = 1e-12;  ///< sine of the angle at which the sun no longer lights a face

Plane plane_through(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a).normalized();
  return {normal, normal.dot(a)};
}

Plane reversed(const Plane& p) { return {-p.normal, -p.offset_m}; }

/// Its faces or, if they are many, the sides of a box around it that lies along the first of them.
std::vector<Plane> guards_of(const Blocker& blocker) {
  std::vector<Plane> guards;
  if (blocker.faces.size() <= kMostGuards) {
    for (const Blocker::Face& face : blocker.faces) guards.push_back(face.plane);
    return guards;
  }
  const Vector3d first = blocker.faces.front().plane.normal, second = first.unitOrthogonal();
  for (const Vector3d& axis : {first, second, Vector3d(first.cross(second))}) {
    for (const Vector3d& outwards : {axis, Vector3d(-axis)}) {
      double furthest_m = -std::numeric_limits<double>::infinity();
      for (const Vector3d& c : blocker.corners) furthest_m = std::max(furthest_m, outwards.dot(c));
      guards.push_back({outwards, furthest_m});
    }
  }
  return guards;
}

Blocker with_guards(Blocker blocker) {
  blocker.guards = guards_of(blocker);
  return blocker;
}

Blocker blocker_of(const scenes::ConvexPart& part) {
  Blocker b{.corners = part.corners, .faces = {}, .guards = {}};
  for (const std::vector<int>& corners : part.faces) {
    const auto at = [&](std::size_t k) { return b.corners[static_cast<std::size_t>(corners[k])]; };
    b.faces.push_back({plane_through(at(0), at(1), at(2)), corners});
  }
  return with_guards(std::move(b));
}

Blocker plate_of(Polygon polygon, const Plane& plane) {
  std::vector<int> front(polygon.size());
  for (std::size_t k = 0; k < front.size(); ++k) front[k] = static_cast<int>(k);
  const std::vector<int> back(front.rbegin(), front.rend());
  return with_guards({.corners = std::move(polygon),
                      .faces = {{plane, front}, {reversed(plane), back}},
                      .guards = {}});
}

/// Where the light is above a plane: m, or the sine of its altitude.
double height_over(const Plane& plane, const LightOrigin& light) {
  return plane.normal.dot(light.head<3>()) - plane.offset_m * light.w();
}

/// The planes of one blocker's shadow; none if the light touches it or is in it.
std::vector<Plane> shadow_of(const Blocker& blocker, const LightOrigin& light) {
  std::vector<Plane> shadow;
  std::vector<std::pair<int, int>> lit_edges;
  for (const Blocker::Face& face : blocker.faces) {
    if (height_over(face.plane, light) <= (light.w() > 0 ? kTouching_m : kGrazing)) continue;
    shadow.push_back(reversed(face.plane));
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
      lit_edges.emplace_back(face.corners[k], face.corners[(k + 1) % face.corners.size()]);
    }
  }
  for (const auto& [from, to] : lit_edges) {
    const bool between_lit_faces =
        std::ranges::find(lit_edges, std::pair(to, from)) != lit_edges.end();
    if (between_lit_faces) continue;
    const Vector3d &a = blocker.corners[static_cast<std::size_t>(from)],
                   &b = blocker.corners[static_cast<std::size_t>(to)];
    const Vector3d inwards = (light.head<3>() - light.w() * a).cross(b - a).normalized();
    shadow.push_back({inwards, inwards.dot(a)});
  }
  return shadow;
}

/// Appends what is left of a convex polygon outside of a convex shadow.
void subtract(const std::vector<Plane>& shadow, const Polygon& polygon,
              std::vector<Polygon>& left) {
  const std::size_t before = left.size();
  Polygon dark = polygon;
  for (const Plane& plane : shadow) {
    if (Polygon lit = clip(dark, reversed(plane)); !lit.empty()) left.push_back(std::move(lit));
    dark = clip(dark, plane);
    if (dark.empty()) {  // no shadow on it: whole, not in pieces
      left.resize(before);
      left.push_back(polygon);
      return;
    }
  }
}

bool outside(const Polygon& polygon, const std::vector<Plane>& shadow) {
  return std::ranges::any_of(shadow, [&](const Plane& plane) {
    return std::ranges::none_of(polygon,
                                [&](const Vector3d& v) { return plane.height_m(v) > kTouching_m; });
  });
}

}  // namespace

std::vector<Blocker> blockers_of(const scenes::Room& room) {
  std::vector<Blocker> blockers;
  for (const scenes::Body& body : room.furniture) {
    for (const scenes::ConvexPart& part : body.parts) blockers.push_back(blocker_of(part));
  }
  for (const scenes::ShellFace& face : room.shell) {
    const Plane plane{face.frame.normal, face.frame.normal.dot(face.frame.origin_m)};
    const auto has_behind = [&](const scenes::ShellFace& other) {
      return std::ranges::any_of(other.outline, [&](const Vector3d& corner) {
        return plane.height_m(corner) <= -kTouching_m;
      });
    };
    if (std::ranges::none_of(room.shell, has_behind)) continue;
    for (Polygon& part : scenes::convex_parts(face.outline, face.holes)) {
      blockers.push_back(plate_of(std::move(part), plane));
    }
  }
  return blockers;
}

std::vector<Blocker> in_front_of(const std::vector<Blocker>& blockers, const Plane& plane) {
  std::vector<Blocker> front;
  for (const Blocker& blocker : blockers) {
    const bool whole = std::ranges::all_of(
        blocker.corners, [&](const Vector3d& c) { return plane.height_m(c) >= -kTouching_m; });
    const bool none = std::ranges::all_of(
        blocker.corners, [&](const Vector3d& c) { return plane.height_m(c) <= kTouching_m; });
    if (none) continue;
    if (whole) {
      front.push_back(blocker);
      continue;
    }
    for (const Blocker::Face& face : blocker.faces) {
      Polygon polygon;
      for (const int c : face.corners) {
        polygon.push_back(blocker.corners[static_cast<std::size_t>(c)]);
      }
      polygon = clip(polygon, plane);
      if (!polygon.empty()) front.push_back(plate_of(std::move(polygon), face.plane));
    }
  }
  return front;
}

Shadows::Shadows(const std::vector<Blocker>& blockers, const LightOrigin& light) {
  for (const Blocker& blocker : blockers) {
    if (Shadow shadow = shadow_of(blocker, light); !shadow.empty()) {
      shadows_.push_back(std::move(shadow));
    }
  }
}

bool Shadows::contain(const Vector3d& point) const {
  return std::ranges::any_of(shadows_, [&](const Shadow& shadow) {
    return std::ranges::all_of(
        shadow, [&](const Plane& plane) { return plane.height_m(point) > kTouching_m; });
  });
}

std::vector<Polygon> Shadows::lit_parts(const Polygon& polygon) const {
  std::vector<Polygon> parts{polygon};
  for (const Shadow& shadow : shadows_) {
    if (outside(polygon, shadow)) continue;
    std::vector<Polygon> left;
    for (const Polygon& part : parts) subtract(shadow, part, left);
    parts = std::move(left);
    if (parts.empty()) break;
  }
  return parts;
}

}  // namespace solver
