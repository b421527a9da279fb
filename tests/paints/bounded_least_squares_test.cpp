#include "paints/bounded_least_squares.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <random>

namespace paints {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd random_matrix(Index rows, Index columns, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

/// The least |a x - b| over all ways to hold unknowns at 0, at 1, or free, as far as they stay
/// within 0..1.
double least_by_trying_all(const MatrixXd& a, const VectorXd& b) {
  double least = 1e300;
  const auto unknowns = static_cast<int>(a.cols());
  for (int code = 0; code < std::pow(3, unknowns); ++code) {
    VectorXd x = VectorXd::Zero(unknowns);
    std::vector<Index> free;
    for (int i = 0, rest = code; i < unknowns; ++i, rest /= 3) {
      x[i] = rest % 3 == 1 ? 1 : 0;
      if (rest % 3 == 2) free.push_back(i);
    }
    const VectorXd left = b - a * x;
    if (!free.empty()) x(free) = MatrixXd(a(Eigen::all, free)).householderQr().solve(left);
    if ((x.array() < 0).any() || (x.array() > 1).any()) continue;
    least = std::min(least, (a * x - b).norm());
  }
  return least;
}

TEST(BoundedLeastSquares, IsTheBestOfAllActiveSets) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const MatrixXd a = random_matrix(8, 6, seed);
    const VectorXd b = 3 * random_matrix(8, 1, seed + 100);
    const VectorXd x = bounded_least_squares(a, b, VectorXd::Zero(6), VectorXd::Ones(6),
                                             VectorXd::Constant(6, 0.5));
    EXPECT_GE(x.minCoeff(), 0);
    EXPECT_LE(x.maxCoeff(), 1);
    EXPECT_NEAR((a * x - b).norm(), least_by_trying_all(a, b), 1e-12) << seed;
  }
}

TEST(BoundedLeastSquares, AnswerDoesNotDependOnTheStart) {
  const MatrixXd a = random_matrix(40, 31, 7);
  const VectorXd b = 3 * random_matrix(40, 1, 8), zero = VectorXd::Zero(31),
                 one = VectorXd::Ones(31);
  const VectorXd x = bounded_least_squares(a, b, zero, one, zero);
  EXPECT_LT((bounded_least_squares(a, b, zero, one, one) - x).norm(), 1e-12);
  EXPECT_LT((bounded_least_squares(a, b, zero, one, x) - x).norm(), 1e-12);
}

TEST(BoundedLeastSquares, WithinTheBoundsIsThatWithoutThem) {
  const MatrixXd a = random_matrix(9, 4, 3);
  const VectorXd truth = VectorXd::LinSpaced(4, 0.1, 0.9);
  const VectorXd x =
      bounded_least_squares(a, a * truth, VectorXd::Zero(4), VectorXd::Ones(4), VectorXd::Zero(4));
  EXPECT_LT((x - truth).norm(), 1e-14);
}

}  // namespace
}  // namespace paints
