#include "solver/sensors/refined_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Vector3d;

const std::vector<Facet> kRectangle{make_facet({{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}})};

template <typename F>
RefinedField::Rules rules_of(const F& function, double tolerance, double coarse_m) {
  return {.sample =
              [=](std::size_t, const Vector3d& p) {
                return RefinedField::Sample{.values = ArrayXd::Constant(2, function(p)),
                                            .scale = 1};
              },
          .attention =
              [=](std::size_t, const RefinedField::Triangle& t) {
                const double edge_m =
                    std::max({(t[0] - t[1]).norm(), (t[1] - t[2]).norm(), (t[2] - t[0]).norm()});
                if (edge_m > coarse_m) return Attention::cut;
                return edge_m < 0.01 ? Attention::coarse : Attention::fine;
              },
          .tolerance = tolerance};
}

template <typename F>
double largest_error(const RefinedField& field, const F& function) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  double largest = 0;
  for (int k = 0; k < 5000; ++k) {
    const Vector3d p(3 * uniform(random), 2 * uniform(random), 0);
    ArrayXd sum = ArrayXd::Zero(2);
    field.add(0, p, sum);
    largest = std::max(largest, (sum - function(p)).abs().maxCoeff());
  }
  return largest;
}

TEST(RefinedField, QuadraticsAreExactWithTheFewestNodes) {
  const auto f = [](const Vector3d& p) {
    return 1 + p.x() - 2 * p.y() + p.x() * p.y() + 0.5 * p.x() * p.x();
  };
  const RefinedField field(kRectangle, rules_of(f, 1e-9, 10));
  EXPECT_LT(largest_error(field, f), 1e-12);
  EXPECT_EQ(field.nodes(), 29U);  // four triangles: 13 nodes; 4 x 3 of their halves, 8 of tests
}

// The tests are few, so the tolerance is an estimate: nowhere is the error twice as large.
TEST(RefinedField, SmoothAndSteepPlacesKeepTheTolerance) {
  const auto f = [](const Vector3d& p) {
    return std::exp(-10 * p.x()) + std::sin(2 * p.y()) / (0.1 + p.x() * p.x());
  };
  const RefinedField field(kRectangle, rules_of(f, 0.01, 0.6));
  EXPECT_LT(largest_error(field, f), 0.02);
  EXPECT_EQ(field.largest_left(), 0);
  EXPECT_LT(field.nodes(), 3000U);
}

// What cannot be reached is told.
TEST(RefinedField, AStepIsRefinedUntilTrianglesAreSmallAndTold) {
  const auto f = [](const Vector3d& p) { return p.x() + 0.31 * p.y() < 1.234 ? 1.0 : 0.0; };
  const RefinedField field(kRectangle, rules_of(f, 0.01, 0.6));
  EXPECT_GT(field.largest_left(), 0.1);
  ArrayXd sum = ArrayXd::Zero(2);
  field.add(0, {1.2, 1.0, 0}, sum);  // 0.27 m beyond the step
  EXPECT_NEAR(sum[0], 0, 1e-12);
}

TEST(RefinedField, AMirroredFunctionHasAMirroredField) {
  const auto f = [](const Vector3d& p) { return 1 / (0.05 + std::abs(p.x() - 1.5) + p.y()); };
  const RefinedField field(kRectangle, rules_of(f, 0.02, 0.6));
  for (double x = 0.01; x < 1.5; x += 0.0371) {
    ArrayXd left = ArrayXd::Zero(2), right = left;
    field.add(0, {x, 0.37 * x, 0}, left);
    field.add(0, {3 - x, 0.37 * x, 0}, right);
    EXPECT_NEAR(left[0], right[0], 1e-12 * std::abs(left[0]));
  }
}

}  // namespace
}  // namespace solver
