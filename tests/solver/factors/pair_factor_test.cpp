#include "solver/factors/pair_factor.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

namespace solver {
namespace {

using Eigen::Vector3d;

/// A rectangle from a corner and two edges; its front is where edge_1 x edge_2 points.
Facet rectangle(const Vector3d& corner, const Vector3d& edge_1, const Vector3d& edge_2) {
  return make_facet({corner, corner + edge_1, corner + edge_1 + edge_2, corner + edge_2});
}

/// Truth without the distance rule: both rectangles halved until Gauss has converged.
double subdivided(const Facet& a, const Facet& b, int depth) {
  const double distance = (a.centre - b.centre).norm();
  if (depth == 0 || distance > 12 * std::max(a.size_m, b.size_m)) {
    return far_exchange(quadrature(a.vertices, 4), a.normal, quadrature(b.vertices, 4), b.normal);
  }
  const Facet &large = a.size_m >= b.size_m ? a : b, &other = a.size_m >= b.size_m ? b : a;
  const auto& v = large.vertices;
  const bool first = (v[1] - v[0]).norm() >= (v[3] - v[0]).norm();
  const Vector3d e = first ? v[1] - v[0] : v[3] - v[0], f = first ? v[3] - v[0] : v[1] - v[0];
  const auto half = [&](const Vector3d& corner) {
    return first ? rectangle(corner, e / 2, f) : rectangle(corner, f, e / 2);
  };
  return subdivided(half(v[0]), other, depth - 1) +
         subdivided(half(v[0] + e / 2), other, depth - 1);
}

// Howell's catalogue, unit cube; digits from the closed form evaluated with 50 digits.
TEST(PairFactor, UnitCubeFactorsToRounding) {
  const Facet floor = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const Facet ceiling = rectangle({0, 0, 1}, {0, 1, 0}, {1, 0, 0});
  const Facet wall = rectangle({0, 0, 0}, {0, 1, 0}, {0, 0, 1});
  EXPECT_NEAR(exchange_area(floor, ceiling), 0.19982489569838746, 1e-15);
  EXPECT_NEAR(exchange_area(floor, wall), 0.20004377607540316, 1e-15);
}

// ln(c^2 + d^2) is 0 in the unit cube, so a slip in that term shows only here.
TEST(PairFactor, TouchingOneByTwoStrips) {
  const Facet a = rectangle({0, 0, 0}, {1, 0, 0}, {0, 2, 0});
  const Facet b = rectangle({0, 0, 0}, {0, 2, 0}, {0, 0, 1});
  EXPECT_NEAR(exchange_area(a, b), 0.4813, 5e-5);
}

TEST(PairFactor, RectanglesAtAnyOffsetAgreeWithSubdividedGauss) {
  const Facet a = rectangle({0, 0, 0}, {0.7, 0, 0}, {0, 0.4, 0});
  const Facet above = rectangle({0.9, -0.3, 0.8}, {0, 0.5, 0}, {0.3, 0, 0});
  const Facet beside = rectangle({1.0, 0.6, 0.2}, {0, 0, 0.4}, {0, 0.5, 0});
  EXPECT_NEAR(exchange_area(a, above) / subdivided(a, above, 12), 1, 1e-10);
  EXPECT_NEAR(exchange_area(a, beside) / subdivided(a, beside, 12), 1, 1e-10);
}

// Far sides of the switches of the distance rule, against the closed form, whose own cancellation
// is 1e-11 at 14.
TEST(PairFactor, DistanceRuleKeepsItsAccuracy) {
  for (const double ratio : {7.001, 10.0, 14.001, 18.0}) {
    const Span unit{0, 1}, shifted{0.4 * ratio, 0.4 * ratio + 1};
    const double gap = ratio * std::sqrt(1 - 0.16);
    const Facet a = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const Facet b = rectangle({0.4 * ratio, 0, gap}, {0, 1, 0}, {1, 0, 0});
    EXPECT_NEAR(exchange_area(a, b) / parallel_rectangles(unit, unit, shifted, unit, gap), 1, 4e-9)
        << ratio;
    const Facet c = rectangle({ratio, 0, 0.2}, {0, 0, 1}, {0, 1, 0});
    EXPECT_NEAR(
        exchange_area(a, c) / perpendicular_rectangles({ratio - 1, ratio}, unit, {0.2, 1.2}, unit),
        1, 4e-9)
        << ratio;
  }
}

// Near and at a middle distance, along common axes and not.
TEST(PairFactor, ErrorEstimateCoversRandomRectangles) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(0, 1);
  constexpr double kTruth = 1e-10;  // what the subdivided rule leaves of the value
  for (int n = 0; n < 60; ++n) {
    const Eigen::AngleAxisd turn(n % 2 == 0 ? 0 : 0.5 * unit(random),
                                 Vector3d(1, 2, 3).normalized());
    const Facet a = rectangle({0, 0, 0}, {0.3 + 0.6 * unit(random), 0, 0}, {0, 0.3, 0});
    const Vector3d from = Vector3d(unit(random), unit(random), 0.6 + unit(random)) * (n % 3 + 1);
    const Facet b = rectangle(from, turn * Vector3d(0, 0.5, 0), turn * Vector3d(0.4, 0, 0));
    const double exact = subdivided(a, b, 14);
    EXPECT_NEAR(exchange_area(a, b), exact, exchange_error_m2(a, b) + kTruth * exact) << n;
  }
}

TEST(PairFactor, RotatedPairAgreesWithTheSameRectanglesCutFiner) {
  const Eigen::AngleAxisd turn(0.6, Vector3d(1, 2, 3).normalized());
  const Facet a = rectangle({0, 0, 0}, {0.7, 0, 0}, {0, 0.4, 0});
  const Facet b =
      rectangle(Vector3d(0.2, 0.5, 0.9), turn * Vector3d(0, 0.5, 0), turn * Vector3d(0.6, 0, 0));
  ASSERT_LT(a.normal.dot(b.normal), 0);
  EXPECT_NEAR(exchange_area(a, b) / subdivided(a, b, 14), 1, 1e-8);
}

// A triangle and its complement make a rectangle; the factors must add up, touching or not.
TEST(PairFactor, PartsOfARectangleAddUpToTheWhole) {
  const Facet wall = rectangle({0, 0, 0}, {0, 1, 0}, {0, 0, 1});
  const Facet floor = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const Facet lower = make_facet({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
  const Facet upper = make_facet({{0, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  EXPECT_NEAR(exchange_area(wall, lower) + exchange_area(wall, upper), exchange_area(wall, floor),
              1e-9);
}

// So do triangles that almost touch, as furniture with a gap does.
TEST(PairFactor, NearlyTouchingTrianglesAddUpToTheRectangle) {
  for (const double gap : {1e-1, 1e-3, 1e-6}) {
    const Facet wall = rectangle({0, 0, 0}, {0, 1, 0}, {0, 0, 1});
    const Facet floor = rectangle({gap, 0, -gap}, {1, 0, 0}, {0, 1, 0});
    const Facet lower = make_facet({{gap, 0, -gap}, {1 + gap, 0, -gap}, {1 + gap, 1, -gap}});
    const Facet upper = make_facet({{gap, 0, -gap}, {1 + gap, 1, -gap}, {gap, 1, -gap}});
    EXPECT_NEAR(exchange_area(wall, lower) + exchange_area(wall, upper), exchange_area(wall, floor),
                1e-8)
        << gap;
  }
}

TEST(PairFactor, StraddlingFacetIsClippedToTheFront) {
  const Facet floor = rectangle({-1, 0, 0}, {2, 0, 0}, {0, 1, 0});
  const Facet front_half = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const Facet wall = rectangle({0, 0, 0}, {0, 1, 0}, {0, 0, 1});  // looks to +x
  EXPECT_DOUBLE_EQ(exchange_area(floor, wall), exchange_area(front_half, wall));
}

TEST(PairFactor, NothingBetweenFacetsThatDoNotFaceEachOther) {
  const Facet a = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const Facet coplanar = rectangle({2, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const Facet above_facing_up = rectangle({0, 0, 1}, {1, 0, 0}, {0, 1, 0});
  EXPECT_EQ(exchange_area(a, coplanar), 0);
  EXPECT_EQ(exchange_area(a, above_facing_up), 0);
}

TEST(PairFactor, SymmetricInItsFacets) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> at(-1, 1);
  const auto point = [&] { return Vector3d(at(random), at(random), at(random)); };
  for (int n = 0; n < 200; ++n) {
    const Facet a = make_facet({point(), point(), point()});
    const Facet b = make_facet({point(), point(), point()});
    const double ab = exchange_area(a, b), ba = exchange_area(b, a);
    EXPECT_NEAR(ab, ba, 1e-14);
    EXPECT_GE(ab, 0);
    EXPECT_LE(ab, std::min(a.area_m2, b.area_m2));
  }
}

// The form factors of a point to the five other faces of a closed box, from inside and on a face.
TEST(PointToPolygon, ClosedBoxSumsToOne) {
  const Vector3d size(2, 3, 1), p(0.3, 0.01, 0);
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d u = Vector3d::Unit((axis + 1) % 3).cwiseProduct(size);
    const Vector3d v = Vector3d::Unit((axis + 2) % 3).cwiseProduct(size);
    sum += point_to_polygon(p, Vector3d::UnitZ(), rectangle(Vector3d::Zero(), u, v).vertices);
    sum += point_to_polygon(p, Vector3d::UnitZ(),
                            rectangle(Vector3d::Unit(axis).cwiseProduct(size), v, u).vertices);
  }
  EXPECT_NEAR(sum, 1, 1e-14);
}

// A square of half-angle 45 degrees overhead: F = 4/pi * atan(1/sqrt 2)/sqrt 2 for a 2 x 2 square
// at height 1.
TEST(PointToPolygon, SquareOverhead) {
  const Facet square = rectangle({-1, -1, 1}, {0, 2, 0}, {2, 0, 0});
  const double exact = 4 / M_PI * std::atan(1 / std::sqrt(2.0)) / std::sqrt(2.0);
  EXPECT_NEAR(point_to_polygon({0, 0, 0}, {0, 0, 1}, square.vertices), exact, 1e-15);
}

}  // namespace
}  // namespace solver
