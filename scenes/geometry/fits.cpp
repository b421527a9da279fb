#include "scenes/geometry/fits.h"

#include <algorithm>
#include <limits>

namespace scenes {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double distance_to_segment_m(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d edge = b - a;
  const double t = std::clamp((p - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
  return (p - a - t * edge).norm();
}

/// Segments that share at least a point, to kTouch_m.
bool meet(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const double c_side = cross(b - a, c - a), d_side = cross(b - a, d - a);
  const double a_side = cross(d - c, a - c), b_side = cross(d - c, b - c);
  if (c_side * d_side < 0 && a_side * b_side < 0) return true;
  return std::min({distance_to_segment_m(a, c, d), distance_to_segment_m(b, c, d),
                   distance_to_segment_m(c, a, b), distance_to_segment_m(d, a, b)}) <= kTouch_m;
}

/// Part of the segment lies deeper than kTouch_m within a convex polygon: clipped by each edge in
/// turn [CyrusBeck1978].
bool passes_through(const Vector2d& from, const Vector2d& to, const Polygon& convex) {
  double enter = 0, leave = 1;
  for (std::size_t i = 0; i < convex.size(); ++i) {
    const Vector2d edge = (convex[(i + 1) % convex.size()] - convex[i]).normalized();
    const double depth_from = cross(edge, from - convex[i]) - kTouch_m;
    const double depth_to = cross(edge, to - convex[i]) - kTouch_m;
    if (depth_from <= 0 && depth_to <= 0) return false;
    const double crossing = depth_from / (depth_from - depth_to);
    if (depth_from <= 0) enter = std::max(enter, crossing);
    if (depth_to <= 0) leave = std::min(leave, crossing);
  }
  return enter < leave;
}

/// Some edge of `convex` has all of `other` outside.
bool has_separating_edge(const Polygon& convex, const Polygon& other) {
  for (std::size_t i = 0; i < convex.size(); ++i) {
    const Vector2d edge = (convex[(i + 1) % convex.size()] - convex[i]).normalized();
    if (std::ranges::all_of(
            other, [&](const Vector2d& p) { return cross(edge, p - convex[i]) <= kTouch_m; })) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::optional<std::size_t> first_crossing_edge(const Polygon& plan) {
  const std::size_t n = plan.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d &a = plan[i], &b = plan[(i + 1) % n], &next = plan[(i + 2) % n];
    const double turn = cross(b - a, next - b);
    if (std::abs(turn) <= kTouch_m * (b - a).norm() && (b - a).dot(next - b) < 0) return i;
    for (std::size_t j = i + 2; j < n; ++j) {
      const bool neighbours = i == 0 && j == n - 1;
      if (!neighbours && meet(a, b, plan[j], plan[(j + 1) % n])) return i;
    }
  }
  return std::nullopt;
}

double distance_to_boundary_m(const Polygon& plan, const Vector2d& point) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < plan.size(); ++i) {
    nearest_m =
        std::min(nearest_m, distance_to_segment_m(point, plan[i], plan[(i + 1) % plan.size()]));
  }
  return nearest_m;
}

bool is_inside(const Polygon& plan, const Vector2d& point) {
  bool inside = false;  // a ray along +x meets the boundary an odd number of times
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const Vector2d &a = plan[i], &b = plan[(i + 1) % plan.size()];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    const double x = a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (x > point.x()) inside = !inside;
  }
  return inside;
}

bool is_inside_or_on(const Polygon& plan, const Vector2d& point) {
  return is_inside(plan, point) || distance_to_boundary_m(plan, point) <= kTouch_m;
}

bool fits_into(const Polygon& plan, const Polygon& convex) {
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (passes_through(plan[i], plan[(i + 1) % plan.size()], convex)) return false;
  }
  Vector2d middle = Vector2d::Zero();
  for (const Vector2d& corner : convex) middle += corner / static_cast<double>(convex.size());
  return is_inside(plan, middle);
}

bool overlap(const Polygon& convex, const Polygon& other_convex) {
  return !has_separating_edge(convex, other_convex) && !has_separating_edge(other_convex, convex);
}

Polygon rectangle(const Vector2d& low, const Vector2d& high) {
  return {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
}

}  // namespace scenes
