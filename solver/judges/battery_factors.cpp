#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "solver/factors/pair_factor.h"
#include "solver/judges/battery_cases.h"

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr int kPairs = 40;

/// F_12 of two equal rectangles a x b, one above the other at distance c [Howell2010] C-11:
/// pi X Y / 2 F = ln sqrt((1+X^2)(1+Y^2)/(1+X^2+Y^2)) + X sqrt(1+Y^2) atan(X/sqrt(1+Y^2))
///                + Y sqrt(1+X^2) atan(Y/sqrt(1+X^2)) - X atan X - Y atan Y,  X = a/c, Y = b/c.
double opposite_rectangles(double x, double y) {
  const double u = std::sqrt(1 + y * y), v = std::sqrt(1 + x * x);
  const double logarithm = std::log(u * u * v * v / (1 + x * x + y * y)) / 2;
  return 2 / (pi * x * y) *
         (logarithm + x * u * std::atan(x / u) + y * v * std::atan(y / v) - x * std::atan(x) -
          y * std::atan(y));
}

/// F_12 of perpendicular rectangles w x l and h x l that share the edge l [Howell2010] C-14:
/// pi W F = W atan(1/W) + H atan(1/H) - R atan(1/R) + 1/4 ln{(1+W^2)(1+H^2)/(1+R^2)
///          [W^2(1+R^2)/((1+W^2)R^2)]^W^2 [H^2(1+R^2)/((1+H^2)R^2)]^H^2},
/// W = w/l, H = h/l, R^2 = W^2 + H^2.
double adjacent_rectangles(double w, double h) {
  const double w2 = w * w, h2 = h * h, r2 = w2 + h2, r = std::sqrt(r2);
  const double logarithm = std::log((1 + w2) * (1 + h2) / (1 + r2)) +
                           w2 * std::log(w2 * (1 + r2) / ((1 + w2) * r2)) +
                           h2 * std::log(h2 * (1 + r2) / ((1 + h2) * r2));
  const double angles = w * std::atan(1 / w) + h * std::atan(1 / h) - r * std::atan(1 / r);
  return (angles + logarithm / 4) / (pi * w);
}

/// A_i F_ij without closed form and distance rule: Gauss over parts of one rectangle of the exact
/// factor from a point to the other [Lambert1760]. Parts are small beside the gap to the other (0.3
/// m), so that 8 points a side reach 1e-13.
double by_quadrature(const Facet& outer, const Facet& inner) {
  constexpr int kParts = 8;
  const Vector3d u = (outer.vertices[1] - outer.vertices[0]) / kParts;
  const Vector3d v = (outer.vertices[3] - outer.vertices[0]) / kParts;
  double sum = 0;
  for (int s = 0; s < kParts; ++s) {
    for (int t = 0; t < kParts; ++t) {
      const Vector3d a = outer.vertices[0] + s * u + t * v;
      for (const QuadraturePoint& p : quadrature({a, a + u, a + u + v, a + v}, 8)) {
        sum += p.weight_m2 * point_to_polygon(p.position, outer.normal, inner.vertices);
      }
    }
  }
  return sum;
}

using Pair = std::array<Facet, 2>;

/// On the floor, and facing it `height_m` and more above.
Pair parallel_pair(Dice& dice, double height_m) {
  const Vector3d at{dice(-2, 1), dice(-2, 1), dice(height_m, 1.5 * height_m)};
  const Vector3d size{dice(0.5, 1.5), dice(0.5, 1.5), 0};
  return {rectangle({0, 0, 0}, {1, dice(0.7, 1.4), 0}, Vector3d::UnitZ()),
          rectangle(at, at + size, at - Vector3d::UnitZ())};
}

/// On the floor, and on the wall x = 0; either is `gap_m` and more from the line where they meet.
Pair perpendicular_pair(Dice& dice, double gap_m) {
  const Vector3d on_floor{dice(gap_m, 1.3 * gap_m), dice(-1, 1), 0};
  const Vector3d on_wall{0, dice(-1, 1), dice(0.1, 0.8)};
  const Vector3d floor_size{dice(0.5, 1.5), dice(0.5, 1.5), 0};
  const Vector3d wall_size{0, dice(0.5, 1.5), dice(0.5, 1.5)};
  return {rectangle(on_floor, on_floor + floor_size, on_floor + Vector3d::UnitZ()),
          rectangle(on_wall, on_wall + wall_size, on_wall + Vector3d::UnitX())};
}

Check check_pairs(const Check& what, Pair (*pair)(Dice&, double), double gap_m) {
  Dice dice(3);
  ArrayXd expected(kPairs), computed(kPairs);
  for (int k = 0; k < kPairs; ++k) {
    const auto [a, b] = pair(dice, gap_m);
    expected[k] = by_quadrature(a, b);
    computed[k] = exchange_area(a, b);
  }
  return worst_of(what, expected, computed);
}

/// A strip's share per metre of its length: A F(L) = f L + b + c/L + O(1/L^3), so that
/// 2 (A F(4L) - A F(2L)) - (A F(2L) - A F(L)) = 3 f L, to O(1/L^3).
template <typename Factor>
double per_metre(Factor exchange_of_length) {
  constexpr double kLength_m = 200;
  const double once = exchange_of_length(kLength_m), twice = exchange_of_length(2 * kLength_m),
               four_times = exchange_of_length(4 * kLength_m);
  return (2 * (four_times - twice) - (twice - once)) / (3 * kLength_m);
}

double sum_over(const std::vector<Facet>& some, const std::vector<Facet>& others) {
  double sum = 0;
  for (const Facet& a : some) {
    for (const Facet& b : others) sum += exchange_area(a, b);
  }
  return sum;
}

}  // namespace

Facet rectangle(const Vector3d& low, const Vector3d& high, const Vector3d& front) {
  const Vector3d diagonal = high - low;
  int flat = 0;
  diagonal.cwiseAbs().minCoeff(&flat);
  const Vector3d u = diagonal.cwiseProduct(Vector3d::Unit((flat + 1) % 3));
  const Vector3d v = diagonal.cwiseProduct(Vector3d::Unit((flat + 2) % 3));
  const Facet facet = make_facet({low, low + u, low + u + v, low + v});
  return facet.plane().height_m(front) > 0 ? facet
                                           : make_facet({low, low + v, low + u + v, low + u});
}

std::vector<Check> check_squares() {
  const ArrayXd gap_m{{0.1, 0.3, 1.0, 2.0, 4.0}}, height_m{{0.05, 0.4, 1.0, 2.5, 8.0}};
  ArrayXd opposite(5), above(5), adjacent(5), beside(5);
  const Facet floor = rectangle({0, 0, 0}, {1, 1, 0}, {0, 0, 1});
  for (int k = 0; k < 5; ++k) {
    opposite[k] = opposite_rectangles(1 / gap_m[k], 1 / gap_m[k]);
    above[k] = exchange_area(floor, rectangle({0, 0, gap_m[k]}, {1, 1, gap_m[k]}, {0, 0, 0}));
    adjacent[k] = adjacent_rectangles(1, height_m[k]);
    beside[k] = exchange_area(floor, rectangle({0, 0, 0}, {0, 1, height_m[k]}, {1, 0, 0}));
  }
  return {
      worst_of({.name = "opposite squares", .quantity = "F12, gaps 0.1 to 4", .tolerance = 1e-12},
               opposite, above),
      worst_of(
          {.name = "adjacent squares", .quantity = "F12, heights 0.05 to 8", .tolerance = 1e-12},
          adjacent, beside)};
}

std::vector<Check> check_offsets() {
  // Near: 16 terms of the closed forms cancel. Far: what the distance rule leaves at a ratio of
  // sides up to 3, as much as the rounding to a float in storage.
  return {check_pairs({.name = "parallel rectangles, near",
                       .quantity = "A1 F12, m2, any offset",
                       .tolerance = 1e-11},
                      parallel_pair, 0.3),
          check_pairs({.name = "parallel rectangles, far",
                       .quantity = "A1 F12, m2, any offset",
                       .tolerance = 6e-8},
                      parallel_pair, 8),
          check_pairs({.name = "perpendicular rectangles, near",
                       .quantity = "A1 F12, m2, any offset",
                       .tolerance = 1e-11},
                      perpendicular_pair, 0.3),
          check_pairs({.name = "perpendicular rectangles, far",
                       .quantity = "A1 F12, m2, any offset",
                       .tolerance = 6e-8},
                      perpendicular_pair, 8)};
}

// Strips without end, by crossed strings [Hottel1954]: opposite ones of width w at distance h have
// F = sqrt(1 + (h/w)^2) - h/w; perpendicular ones that share an edge, w and h wide, have
// F = (w + h - sqrt(w^2 + h^2)) / 2w.
std::vector<Check> check_strips() {
  constexpr double kHeight_m = 0.7;
  const double opposite = per_metre([&](double length_m) {
    return exchange_area(rectangle({0, 0, 0}, {1, length_m, 0}, {0, 0, 1}),
                         rectangle({0, 0, kHeight_m}, {1, length_m, kHeight_m}, {0, 0, 0}));
  });
  const double adjacent = per_metre([&](double length_m) {
    return exchange_area(rectangle({0, 0, 0}, {1, length_m, 0}, {0, 0, 1}),
                         rectangle({0, 0, 0}, {0, length_m, kHeight_m}, {1, 0, 0}));
  });
  const double string_m = std::hypot(1, kHeight_m);
  return {
      {"infinite plates, opposite strips", "F12", string_m - kHeight_m, opposite, 1e-8},
      {"infinite plates, adjacent strips", "F12", (1 + kHeight_m - string_m) / 2, adjacent, 1e-8}};
}

// Parts of a rectangle exchange together what the rectangle does (C-14 above).
std::vector<Check> check_touching_polygons() {
  constexpr double kWidth_m = 1.1, kHeight_m = 0.9, kLength_m = 1.3;
  const auto floor = [](double x, double y) { return Vector3d(x * kWidth_m, y * kLength_m, 0); };
  const auto wall = [](double y, double z) { return Vector3d(0, y * kLength_m, z * kHeight_m); };
  const std::vector<Facet> triangles{make_facet({floor(0, 0), floor(1, 0), floor(1, 1)}),
                                     make_facet({floor(0, 0), floor(1, 1), floor(0, 1)})};
  const std::vector<Facet> trapezoids{
      make_facet({floor(0, 0), floor(1, 0), floor(1, 0.7), floor(0, 0.4)}),
      make_facet({floor(0, 0.4), floor(1, 0.7), floor(1, 1), floor(0, 1)})};
  const std::vector<Facet> whole_wall{make_facet({wall(0, 0), wall(1, 0), wall(1, 1), wall(0, 1)})};
  const std::vector<Facet> cut_wall{
      make_facet({wall(0, 0), wall(0.6, 0), wall(0.6, 1), wall(0, 1)}),
      make_facet({wall(0.6, 0), wall(1, 0), wall(0.6, 1)}),
      make_facet({wall(1, 0), wall(1, 1), wall(0.6, 1)})};
  const double exact_m2 =
      kWidth_m * kLength_m * adjacent_rectangles(kWidth_m / kLength_m, kHeight_m / kLength_m);
  const auto check = [&](const char* name, double computed_m2) {
    return Check{name, "sum of A1 F12, m2", exact_m2, computed_m2, 1e-8};
  };
  return {check("touching: triangles, rectangle", sum_over(triangles, whole_wall)),
          check("touching: trapezoids, rectangle", sum_over(trapezoids, whole_wall)),
          check("touching: triangles, trapezoids", sum_over(triangles, cut_wall)),
          check("touching: trapezoids, triangles", sum_over(trapezoids, cut_wall))};
}

}  // namespace solver
