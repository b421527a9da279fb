#include "solver/pair_factor.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace solver {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

constexpr double kOnHorizon_m = 1e-12;
/// Closed forms are differences of terms as large as the larger area: below this ratio of areas
/// they keep less than 1e-7.
constexpr double kTiny = 1e-8;
constexpr double kNoArea_m2 = 1e-18;  ///< a clipped sliver below this exchanges nothing

/// sum over the corners of both rectangles of (-1)^(i+j+k+l) G
template <typename Function>
double corner_sum(Span x, Span y, Span xi, Span eta, Function g) {
  const auto difference = [&](double xv, double xiv) {
    return g(xv, xiv, y.from - eta.from) - g(xv, xiv, y.from - eta.to) -
           g(xv, xiv, y.to - eta.from) + g(xv, xiv, y.to - eta.to);
  };
  return difference(x.from, xi.from) - difference(x.from, xi.to) - difference(x.to, xi.from) +
         difference(x.to, xi.to);
}

/// Where a rectangle's edges lie along given axes; empty if they are not parallel to them.
std::optional<std::array<Span, 2>> spans_along(const Facet& f, const Vector3d& origin,
                                               const Vector3d& first, const Vector3d& second) {
  const Vector3d edge = (f.vertices[1] - f.vertices[0]).normalized();
  const double along_first = std::abs(edge.dot(first)), along_second = std::abs(edge.dot(second));
  if (std::min(along_first, along_second) > 1e-12 || std::max(along_first, along_second) < 0.5) {
    return {};
  }
  const Vector3d a = f.vertices[0] - origin, b = f.vertices[2] - origin;
  const auto span = [&](const Vector3d& axis) {
    const auto [from, to] = std::minmax({a.dot(axis), b.dot(axis)});
    return Span{from, to};
  };
  return std::array{span(first), span(second)};
}

/// Closed form, if both are rectangles with edges along common axes.
std::optional<double> aligned_rectangles(const Facet& i, const Facet& j) {
  if (!i.rectangle || !j.rectangle) return {};
  const double cosine = i.normal.dot(j.normal);
  if (cosine < -1 + 1e-14) {
    const Vector3d along = (i.vertices[1] - i.vertices[0]).normalized();
    const Vector3d across = i.normal.cross(along);
    const auto a = spans_along(i, i.centre, along, across);
    const auto b = spans_along(j, i.centre, along, across);
    if (!a || !b) return {};
    return parallel_rectangles((*a)[0], (*a)[1], (*b)[0], (*b)[1], i.plane().height_m(j.centre));
  }
  if (std::abs(cosine) < 1e-13) {
    const Vector3d line = i.normal.cross(j.normal);
    // A point on the common line; i extends along j's normal from it, j along i's.
    const Vector3d origin = i.centre - j.plane().height_m(i.centre) * j.normal;
    const auto a = spans_along(i, origin, j.normal, line);
    const auto b = spans_along(j, origin, i.normal, line);
    if (!a || !b) return {};
    const auto in_front = [](Span s) { return Span{std::max(s.from, 0.0), std::max(s.to, 0.0)}; };
    return perpendicular_rectangles(in_front((*a)[0]), (*a)[1], in_front((*b)[0]), (*b)[1]);
  }
  return {};
}

/// Shortest distance of the two circumscribed spheres in units of the larger size; negative if they
/// overlap.
double clearance(const Facet& i, const Facet& j) {
  const double size = std::max(i.size_m, j.size_m);
  return ((i.centre - j.centre).norm() - (i.size_m + j.size_m) / std::numbers::sqrt2) / size;
}

double gauss_with_exact_inner(const Facet& outer, const Facet& inner) {
  const double apart = clearance(outer, inner);
  const int order = apart < 0.1 ? 8 : apart < 1 ? 6 : apart < 4 ? 4 : 2;
  double sum = 0;
  for (const QuadraturePoint& p : quadrature(outer.vertices, order)) {
    sum += p.weight_m2 * point_to_polygon(p.position, outer.normal, inner.vertices);
  }
  return sum;
}

double facing_exchange(const Facet& i, const Facet& j) {
  const double ratio = (i.centre - j.centre).norm() / std::max(i.size_m, j.size_m);
  if (const int order = far_field_order(ratio)) {
    return far_exchange(quadrature(i.vertices, order), i.normal, quadrature(j.vertices, order),
                        j.normal);
  }
  const bool tiny = std::min(i.area_m2, j.area_m2) < kTiny * std::max(i.area_m2, j.area_m2);
  if (const auto closed = tiny ? std::nullopt : aligned_rectangles(i, j)) return *closed;
  return i.area_m2 <= j.area_m2 ? gauss_with_exact_inner(i, j) : gauss_with_exact_inner(j, i);
}

}  // namespace

double parallel_rectangles(Span x, Span y, Span xi, Span eta, double gap_m) {
  const double z2 = gap_m * gap_m;
  return corner_sum(x, y, xi, eta, [z2](double xv, double xiv, double v) {
    const double u = xv - xiv, a = std::sqrt(u * u + z2), b = std::sqrt(v * v + z2);
    return (v * a * std::atan(v / a) + u * b * std::atan(u / b) -
            z2 / 2 * std::log(u * u + v * v + z2)) /
           (2 * pi);
  });
}

double perpendicular_rectangles(Span x, Span y, Span xi, Span eta) {
  return corner_sum(x, y, xi, eta, [](double xv, double xiv, double d) {
    const double c2 = xv * xv + xiv * xiv, c = std::sqrt(c2), d2 = d * d;
    if (c2 + d2 == 0) return 0.0;
    const double angle = c > 0 ? d * c * std::atan(d / c) : 0;
    return (angle - (c2 - d2) / 4 * std::log(c2 + d2)) / (2 * pi);
  });
}

double point_to_polygon(const Vector3d& point, const Vector3d& normal,
                        const std::vector<Vector3d>& polygon) {
  const Plane horizon{normal, normal.dot(point)};
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const Vector3d& vertex : polygon) {
    const double height = horizon.height_m(vertex);
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  if (highest <= kOnHorizon_m) return 0;  // in the plane of the element, or behind it
  const std::vector<Vector3d> clipped =
      lowest < 0 ? clip(polygon, horizon) : std::vector<Vector3d>();
  const std::vector<Vector3d>& visible = lowest < 0 ? clipped : polygon;
  if (visible.empty()) return 0;
  double sum = 0;
  Vector3d r = visible.back() - point;
  for (const Vector3d& vertex : visible) {
    const Vector3d next = vertex - point, cross = next.cross(r);
    const double sine = cross.norm();
    if (sine > 0) sum += std::atan2(sine, r.dot(next)) * normal.dot(cross) / sine;
    r = next;
  }
  return sum / (2 * pi);
}

int far_field_order(double distance_over_size) {
  if (distance_over_size >= 20) return 2;
  if (distance_over_size >= 10) return 3;
  if (distance_over_size >= 5) return 4;
  return 0;
}

double far_exchange(const std::vector<QuadraturePoint>& from, const Vector3d& from_normal,
                    const std::vector<QuadraturePoint>& to, const Vector3d& to_normal) {
  double sum = 0;
  for (const QuadraturePoint& p : from) {
    for (const QuadraturePoint& q : to) {
      const Vector3d r = q.position - p.position;
      const double r2 = r.squaredNorm();
      sum -= p.weight_m2 * q.weight_m2 * from_normal.dot(r) * to_normal.dot(r) / (r2 * r2);
    }
  }
  return sum / pi;
}

double exchange_area(const Facet& i, const Facet& j) {
  const auto front_of = [](const Facet& f, const Facet& other) {
    return clip(f.vertices, other.plane());
  };
  std::vector<Vector3d> vi = front_of(i, j), vj = front_of(j, i);
  if (vi.empty() || vj.empty()) return 0;
  const bool whole = vi == i.vertices && vj == j.vertices;
  const auto value_of_clipped = [&] {
    const Facet a = make_facet(std::move(vi)), b = make_facet(std::move(vj));
    return a.area_m2 > kNoArea_m2 && b.area_m2 > kNoArea_m2 ? facing_exchange(a, b) : 0.0;
  };
  const double value = whole ? facing_exchange(i, j) : value_of_clipped();
  return std::clamp(value, 0.0, std::min(i.area_m2, j.area_m2));
}

}  // namespace solver
