#include "scenes/shapes/bodies.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/mesh/surface_cutter.h"
#include "scenes/shapes/plates.h"

namespace scenes {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kStraight_m = 1e-12;

/// Bottom corners first, then the top ones.
ConvexPart prism_part(const Polygon& convex_plan_m, double low_m, double high_m) {
  ConvexPart part;
  const int n = static_cast<int>(convex_plan_m.size());
  for (const double z : {low_m, high_m}) {
    for (const Vector2d& p : convex_plan_m) part.corners.emplace_back(p.x(), p.y(), z);
  }
  part.faces.resize(2);
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    part.faces[0].push_back(n - 1 - i);
    part.faces[1].push_back(n + i);
    part.faces.push_back({i, next, n + next, n + i});
  }
  return part;
}

Polygon footprint(const Vector2d& low, const Vector2d& high, double rotate_z_deg) {
  const Vector2d centre = (low + high) / 2;
  Polygon corners{low, {high.x(), low.y()}, high, {low.x(), high.y()}};
  // Added as a displacement (R - 1)(p - c): a box that is not rotated keeps its exact coordinates.
  const Eigen::Matrix2d turn =
      Eigen::Rotation2Dd(rotate_z_deg * kDegree).toRotationMatrix() - Eigen::Matrix2d::Identity();
  for (Vector2d& corner : corners) corner += turn * (corner - centre);
  return corners;
}

}  // namespace

std::vector<Outline> prism_faces(const Polygon& plan_m, double low_m, double high_m) {
  const auto at = [&plan_m](std::size_t i, double z) {
    const Vector2d& p = plan_m[i % plan_m.size()];
    return Vector3d(p.x(), p.y(), z);
  };
  std::vector<Outline> faces(2);
  for (std::size_t i = 0; i < plan_m.size(); ++i) {
    faces[0].push_back(at(plan_m.size() - 1 - i, low_m));
    faces[1].push_back(at(i, high_m));
    faces.push_back({at(i, low_m), at(i + 1, low_m), at(i + 1, high_m), at(i, high_m)});
  }
  return faces;
}

Body box_body(std::string name, const Vector3d& min_m, const Vector3d& max_m, double rotate_z_deg) {
  const Polygon foot = footprint(min_m.head<2>(), max_m.head<2>(), rotate_z_deg);
  return {.name = std::move(name),
          .faces = prism_faces(foot, min_m.z(), max_m.z()),
          .parts = {prism_part(foot, min_m.z(), max_m.z())}};
}

Body prism_body(std::string name, const Polygon& plan_m, double low_m, double high_m) {
  Body body{.name = std::move(name), .faces = prism_faces(plan_m, low_m, high_m), .parts = {}};
  for (const Polygon& piece : convex_pieces(plan_m)) {
    body.parts.push_back(prism_part(without_collinear_corners(piece, kStraight_m), low_m, high_m));
  }
  return body;
}

Polygon regular_polygon(const Vector2d& centre_m, double radius_m, int sides) {
  const double angle = 2 * std::numbers::pi / sides;
  const double corner_m = radius_m * std::sqrt(angle / std::sin(angle));  // pi r^2 = n/2 R^2 sin
  Polygon polygon;
  for (int i = 0; i < sides; ++i) {
    polygon.push_back(centre_m + corner_m * Vector2d(std::cos(i * angle), std::sin(i * angle)));
  }
  return polygon;
}

/// Its profile, x along the way and y up, drawn out to its width and stood up.
Body stairs_body(std::string name, const Stairs& s) {
  Polygon profile{{0, 0}};
  for (int i = s.steps; i > 0; --i) {
    profile.emplace_back(i * s.going_m, i == s.steps ? 0 : (i + 1) * s.rise_m);
    profile.emplace_back(i * s.going_m, i * s.rise_m);
  }
  profile.emplace_back(0, s.rise_m);
  Eigen::Isometry3d stand = Eigen::Isometry3d::Identity();
  stand.translate(s.foot_m);
  stand.rotate(Eigen::AngleAxisd(s.direction_deg * kDegree, Vector3d::UnitZ()));
  Eigen::Matrix3d axes;  // profile x, profile y, width
  axes << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  stand.rotate(axes);
  return moved(prism_body(std::move(name), profile, -s.width_m / 2, s.width_m / 2), stand);
}

Body sheet_body(std::string name, const Outline& outline) {
  Body body{.name = std::move(name),
            .faces = {outline, {outline.rbegin(), outline.rend()}},
            .parts = {},
            .two_sided = true};
  for (const Outline& piece : convex_parts(outline)) {
    body.parts.push_back(plate(piece));
  }
  return body;
}

Body moved(const Body& body, const Eigen::Isometry3d& motion) {
  Body copy = body;
  for (Outline& face : copy.faces) {
    for (Vector3d& p : face) p = motion * p;
  }
  for (ConvexPart& part : copy.parts) {
    for (Vector3d& p : part.corners) p = motion * p;
  }
  return copy;
}

}  // namespace scenes
