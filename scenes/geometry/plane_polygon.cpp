#include "scenes/geometry/plane_polygon.h"

#include <cmath>

namespace scenes {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

Line edge_line(const Polygon& polygon, std::size_t i) {
  const Eigen::Vector2d edge = polygon[(i + 1) % polygon.size()] - polygon[i];
  return {.point = polygon[i], .direction = edge.stableNormalized()};
}

// Both sums are taken relative to the first corner: small polygons far from the origin keep their
// digits.
double area(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    twice += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  }
  return twice / 2;
}

Eigen::Vector2d centroid(const Polygon& polygon) {
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  double twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Eigen::Vector2d a = polygon[i - 1] - polygon[0], b = polygon[i] - polygon[0];
    moment += cross(a, b) * (a + b) / 3;
    twice += cross(a, b);
  }
  return polygon[0] + moment / twice;
}

Polygon clip(const Polygon& convex, const Line& line) {
  Polygon kept;
  for (std::size_t i = 0; i < convex.size(); ++i) {
    const Eigen::Vector2d &from = convex[i], &to = convex[(i + 1) % convex.size()];
    const double start = line.left_by(from), end = line.left_by(to);
    if (start >= 0) kept.push_back(from);
    if ((start > 0 && end < 0) || (start < 0 && end > 0)) {
      kept.emplace_back(from + start / (start - end) * (to - from));
    }
  }
  return kept;
}

double shared_area(const Polygon& convex, const Polygon& other_convex) {
  Polygon shared = convex;
  for (std::size_t i = 0; i < other_convex.size() && !shared.empty(); ++i) {
    shared = clip(shared, edge_line(other_convex, i));
  }
  return area(shared);
}

Polygon without_collinear_corners(const Polygon& polygon, double tolerance_m) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& before = kept.empty() ? polygon.back() : kept.back();
    const Eigen::Vector2d chord = polygon[(i + 1) % polygon.size()] - before;
    if (std::abs(cross(chord, polygon[i] - before)) > tolerance_m * chord.norm()) {
      kept.push_back(polygon[i]);
    }
  }
  return kept;
}

}  // namespace scenes
