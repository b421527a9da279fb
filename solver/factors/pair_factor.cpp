#include "solver/factors/pair_factor.h"

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
constexpr double kNoArea_m2 = 1e-18;  ///< a clipped sliver below this exchanges nothing

std::optional<RectanglePair> aligned_rectangles(const Facet& i, const Facet& j) {
  const auto a = rectangle_of(i), b = rectangle_of(j);
  return a && b ? aligned(*a, *b) : std::nullopt;
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
  if (!closed_form_suits(i.area_m2, j.area_m2)) return gauss_with_exact_inner(small, large);
  if (const auto pair = aligned_rectangles(i, j)) return exchange_area(*pair);
  return contour_exchange(small, large);
}

}  // namespace

double parallel_rectangles(Span x, Span y, Span xi, Span eta, double gap_m) {
  return exchange_area({Planes::parallel, x, y, xi, eta, gap_m});
}

double perpendicular_rectangles(Span x, Span y, Span xi, Span eta) {
  return exchange_area({Planes::perpendicular, x, y, xi, eta});
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

double exchange_error_m2(const Facet& i, const Facet& j) {
  const double distance_m = (i.centre - j.centre).norm(), size_m = std::max(i.size_m, j.size_m);
  const double ratio = distance_m / size_m, smaller_m2 = std::min(i.area_m2, j.area_m2);
  if (const int order = far_field_order(ratio)) {
    // Of what they exchange face to face: what a rule of degree 2 order - 1 leaves of 1 / r^4.
    return i.area_m2 * j.area_m2 / (pi * distance_m * distance_m) * std::pow(ratio, -2 * order);
  }
  if (!closed_form_suits(i.area_m2, j.area_m2)) return 1e-8 * smaller_m2;
  if (aligned_rectangles(i, j)) {
    const double reach_m = distance_m + 2 * size_m;
    return kClosedFormRounding * reach_m * reach_m;
  }
  return 3e-8 * smaller_m2;  // both contours, at a gap of a thousandth; else 2e-10
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
