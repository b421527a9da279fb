#include "scenes/shapes/roof.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/mesh/surface_cutter.h"
#include "scenes/shapes/shell.h"

namespace scenes {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kStraight_m = 1e-12;
constexpr double kSliver_m2 = 1e-9;  ///< a face of the ceiling that is smaller is left out
constexpr double kSame = 1e-12;      ///< slopes and heights that differ by less are one plane

std::vector<RoofPlane> distinct(const std::vector<RoofPlane>& planes) {
  std::vector<RoofPlane> kept;
  for (const RoofPlane& p : planes) {
    const bool known = std::ranges::any_of(kept, [&](const RoofPlane& k) {
      return (k.slope - p.slope).norm() < kSame && std::abs(k.height_m - p.height_m) < kSame;
    });
    if (!known) kept.push_back(p);
  }
  return kept;
}

/// The part of a convex polygon over which `plane` is not above `other`.
Polygon below(const Polygon& convex, const RoofPlane& plane, const RoofPlane& other) {
  const Vector2d rise = plane.slope - other.slope;  // over `other`, per metre
  const double steepness = rise.norm();
  if (steepness < kSame) return plane.height_m < other.height_m ? convex : Polygon{};
  const Vector2d up = rise / steepness;
  const Vector2d level = up * (other.height_m - plane.height_m) / steepness;
  return clip(convex, {.point = level, .direction = {-up.y(), up.x()}});
}

/// Seen from below.
ShellFace ceiling_face(const Polygon& cell, const RoofPlane& plane) {
  ShellFace face{.surface = 1, .frame = {}, .outline = {}};
  for (const Vector2d& p : cell) face.outline.emplace_back(p.x(), p.y(), plane.over(p));
  std::ranges::reverse(face.outline);
  const Vector3d normal(plane.slope.x(), plane.slope.y(), -1);
  face.frame = frame_of_plane({0, 0, plane.height_m}, normal.stableNormalized());
  return face;
}

std::vector<ShellFace> ceiling_faces(const Polygon& plan_m, const std::vector<RoofPlane>& planes) {
  if (planes.size() == 1) return {ceiling_face(plan_m, planes.front())};
  std::vector<ShellFace> faces;
  const std::vector<Polygon> pieces = convex_pieces(plan_m);
  for (const RoofPlane& plane : planes) {
    for (Polygon cell : pieces) {
      for (const RoofPlane& other : planes) {
        if (&other != &plane && !cell.empty()) cell = below(cell, plane, other);
      }
      cell = without_collinear_corners(cell, kStraight_m);
      if (cell.size() > 2 && area(cell) > kSliver_m2) faces.push_back(ceiling_face(cell, plane));
    }
  }
  return faces;
}

/// From the first corner's top to the second's: where the lowest plane changes, too.
Polygon top_edge(double length_m, const std::vector<RoofPlane>& planes, const Vector2d& from,
                 const Vector2d& to) {
  const auto at = [&](double t) -> Vector2d { return from + t * (to - from); };
  std::vector<double> breaks{0, 1};
  for (std::size_t j = 0; j < planes.size(); ++j) {
    for (std::size_t k = 0; k < j; ++k) {
      const double start = planes[j].over(from) - planes[k].over(from),
                   end = planes[j].over(to) - planes[k].over(to), t = start / (start - end);
      if (!(t > 0 && t < 1)) continue;
      const bool lowest =
          planes[j].over(at(t)) <= height_below(planes, at(t)) + kStraight_m * length_m;
      if (lowest) breaks.push_back(t);
    }
  }
  std::ranges::sort(breaks);
  Polygon edge;
  for (const double t : breaks) {
    const Vector2d p(t * length_m, height_below(planes, at(t)));
    if (edge.empty() || (p - edge.back()).norm() > kCoplanar_m) edge.push_back(p);
  }
  return edge;
}

/// Seen from inside.
Outline wall_outline(const Vector2d& from, const Vector2d& to,
                     const std::vector<RoofPlane>& planes) {
  const double length_m = (to - from).norm();
  Polygon upright{{0, 0}, {length_m, 0}};  // along the wall, and up
  const Polygon top = top_edge(length_m, planes, from, to);
  upright.insert(upright.end(), top.rbegin(), top.rend());
  upright = without_collinear_corners(upright, kStraight_m);
  Outline outline;
  for (auto p = upright.rbegin(); p != upright.rend(); ++p) {
    const Vector2d foot =
        p->x() == length_m ? to : Vector2d(from + p->x() / length_m * (to - from));
    outline.emplace_back(foot.x(), foot.y(), p->y());
  }
  return outline;
}

}  // namespace

RoofPlane roof_plane_of(const Outline& corners) {
  const Vector3d normal = vector_area_m2(corners).normalized();
  const Vector2d slope = -normal.head<2>() / normal.z();
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& c : corners) middle += c / static_cast<double>(corners.size());
  return {.height_m = middle.z() - slope.dot(middle.head<2>()), .slope = slope};
}

RoofPlane pitched_plane(const Line& wall, double height_m, double pitch_deg) {
  const Vector2d inward(-wall.direction.y(), wall.direction.x());
  const Vector2d slope = std::tan(pitch_deg * std::numbers::pi / 180) * inward;
  return {.height_m = height_m - slope.dot(wall.point), .slope = slope};
}

double height_below(std::span<const RoofPlane> planes, const Vector2d& p) {
  double lowest_m = planes.front().over(p);
  for (const RoofPlane& plane : planes) lowest_m = std::min(lowest_m, plane.over(p));
  return lowest_m;
}

std::vector<ShellFace> roofed_shell(const Polygon& plan_m, const std::vector<RoofPlane>& all) {
  const std::vector<RoofPlane> planes = distinct(all);
  const bool level = planes.size() == 1 && planes.front().slope.isZero(0);
  std::vector<ShellFace> prism =
      prism_shell(plan_m, level ? planes.front().height_m : height_below(planes, plan_m.front()));
  if (level) return prism;
  std::vector<ShellFace> shell{prism[0]};
  for (ShellFace& face : ceiling_faces(plan_m, planes)) shell.push_back(std::move(face));
  for (std::size_t i = 0; i < plan_m.size(); ++i) {
    ShellFace wall = prism[2 + i];
    wall.outline = wall_outline(plan_m[i], plan_m[(i + 1) % plan_m.size()], planes);
    shell.push_back(std::move(wall));
  }
  return shell;
}

}  // namespace scenes
