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

struct Edge {
  Vector3d start, along;  ///< along: unit
  double length_m = 0;
};

std::vector<Edge> edges_of(const std::vector<Vector3d>& polygon) {
  std::vector<Edge> edges;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector3d span = polygon[(k + 1) % polygon.size()] - polygon[k];
    edges.push_back({polygon[k], span.stableNormalized(), span.norm()});
  }
  return edges;
}

/// Integral of ln r along an edge, r the distance from a point.
double log_distance(const Vector3d& point, const Edge& edge) {
  const Vector3d r = point - edge.start;
  const double x = r.dot(edge.along), rest = edge.length_m - x;
  const double h = (r - x * edge.along).norm();
  const auto part = [h](double t) {
    const double r2 = t * t + h * h;
    return r2 > 0 ? t / 2 * std::log(r2) : 0.0;
  };
  const double angle = h > 0 ? h * (std::atan(x / h) + std::atan(rest / h)) : 0;
  return part(x) + part(rest) + angle - edge.length_m;
}

double distance_m(const Vector3d& point, const Edge& edge) {
  const Vector3d r = point - edge.start;
  return (r - std::clamp(r.dot(edge.along), 0.0, edge.length_m) * edge.along).norm();
}

/// The places on an edge that are nearest to the other's line and ends, and its own ends: between
/// them ln r is smooth.
std::array<double, 5> nearest_places_m(const Edge& e, const Edge& f) {
  const double cosine = e.along.dot(f.along), sine2 = 1 - cosine * cosine;
  const Vector3d w = f.start - e.start;
  const double start = w.dot(e.along), end = start + f.length_m * cosine;
  const double line = sine2 > 1e-12 ? (start - cosine * w.dot(f.along)) / sine2 : start;
  const auto on_edge = [&](double s) { return std::clamp(s, 0.0, e.length_m); };
  std::array places{0.0, on_edge(start), on_edge(end), on_edge(line), e.length_m};
  std::sort(places.begin(), places.end());
  return places;
}

/// Integral of ln r over a piece of the outer edge and the whole inner one, which is exact. Gauss
/// with 8 points, if that is farther off than the piece is long. Else s = u^3 (10 - 15 u + 6 u^2)
/// crowds 32 of them at the ends: what is left there of s ln s is smooth enough for 2e-10.
double log_distance(const Edge& outer, Span piece, const Edge& inner, bool near) {
  const GaussRule& rule = gauss(8);
  const double length = piece.to - piece.from;
  const std::size_t parts = near ? 4 : 1;
  double sum = 0;
  for (std::size_t k = 0; k < 8 * parts; ++k) {
    const double u = (static_cast<double>(k / 8) + rule.node[k % 8]) / static_cast<double>(parts);
    const double s = near ? u * u * u * (10 - u * (15 - 6 * u)) : u;
    const double ds = near ? 30 * u * u * (1 - u) * (1 - u) : 1;
    sum += rule.weight[k % 8] * ds *
           log_distance(outer.start + (piece.from + length * s) * outer.along, inner);
  }
  return sum * length / static_cast<double>(parts);
}

/// Integral of ln r over both edges. Between the nearest places r rises or falls.
double log_distance(const Edge& outer, const Edge& inner) {
  const std::array<double, 5> places = nearest_places_m(outer, inner);
  std::array<double, 5> distance{};
  for (std::size_t k = 0; k < places.size(); ++k) {
    distance[k] = distance_m(outer.start + places[k] * outer.along, inner);
  }
  if (*std::min_element(distance.begin(), distance.end()) > outer.length_m) {
    return log_distance(outer, {0, outer.length_m}, inner, false);
  }
  double sum = 0;
  for (std::size_t k = 0; k + 1 < places.size(); ++k) {
    const double length = places[k + 1] - places[k];
    const bool near = std::min(distance[k], distance[k + 1]) <= length;
    if (length > 0) sum += log_distance(outer, {places[k], places[k + 1]}, inner, near);
  }
  return sum;
}

/// Both areas by Stokes' theorem: A_i F_ij = 1/2pi times the integral of ln r dr_i . dr_j over both
/// contours [Sparrow1963]. Nothing in it is singular where they touch.
double contour_exchange(const Facet& outer, const Facet& inner) {
  const std::vector<Edge> inner_edges = edges_of(inner.vertices);
  double sum = 0;
  for (const Edge& e : edges_of(outer.vertices)) {
    for (const Edge& f : inner_edges) {
      const double cosine = e.along.dot(f.along);
      if (std::abs(cosine) > 1e-15) sum += cosine * log_distance(e, f);
    }
  }
  return sum / (2 * pi);
}

double gauss_with_exact_inner(const Facet& outer, const Facet& inner) {
  double sum = 0;
  for (const QuadraturePoint& p : quadrature(outer.vertices, 8)) {
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
  const Facet &small = i.area_m2 <= j.area_m2 ? i : j, &large = i.area_m2 <= j.area_m2 ? j : i;
  if (small.area_m2 < kTiny * large.area_m2) return gauss_with_exact_inner(small, large);
  if (const auto closed = aligned_rectangles(i, j)) return *closed;
  return contour_exchange(small, large);
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
