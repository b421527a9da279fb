#include "paints/recipe_fit.h"

#include <gtest/gtest.h>

#include <random>

#include "paints/piece_bound.h"
#include "paints/search_space.h"
#include "tests/paints/sphere_room.h"

namespace paints {
namespace {

using Eigen::Vector3d;

/// Bases whose colours mix as weighted points do: everything known in closed form.
JabOfParts weighted_points(const Parts& parts) {
  static const Eigen::Matrix<double, 3, 4> kPoints{{0, 10, 0, 0}, {0, 0, 10, 0}, {0, 0, 0, 10}};
  const double sum = parts.sum();
  const Vector3d jab = kPoints * parts / sum;
  return {.jab = jab, .by_parts = (kPoints.colwise() - jab) / sum};
}

TEST(FitParts, FindsThePartsOfAMixtureExactly) {
  const Parts wished(0.1, 0.2, 0.3, 0.4);
  const Fit fit = fit_parts(weighted_points, weighted_points(wished).jab, Parts::Constant(0.25),
                            Parts(1, 3, 0.1, 10));
  EXPECT_LT(fit.distance, 1e-12);
  EXPECT_LT((fit.parts - wished).norm(), 1e-12);
}

// The face z = 0 of the tetrahedron lies below x + y = 10, so (13, 5, -5) is nearest to (9, 1, 0).
TEST(FitParts, HoldsPartsAtZeroWhereTheWishLiesOutside) {
  const Fit fit = fit_parts(weighted_points, {13, 5, -5}, Parts::Constant(0.25), Parts::Ones());
  EXPECT_NEAR(fit.distance, Vector3d(4, 4, 5).norm(), 1e-9);
  EXPECT_NEAR(fit.parts[1], 0.9, 1e-6);
  EXPECT_NEAR(fit.parts[2], 0.1, 1e-6);
  EXPECT_EQ(fit.parts[3], 0);
}

TEST(FitParts, ReturnsToABaseThatWasLeftOutByMistake) {
  const Fit fit = fit_parts(weighted_points, weighted_points({1, 1, 1, 1}).jab, Parts(1, 1, 1, 0),
                            Parts::Ones());
  EXPECT_LT(fit.distance, 1e-12);
}

TEST(FitUnits, FindsTheNearestOfAllRecipesInUnits) {
  const auto look = [](const Parts& parts) { return weighted_points(parts).jab; };
  std::mt19937 draw(1);
  std::uniform_real_distribution<double> any(0, 1);
  for (int n = 0; n < 20; ++n) {
    const Parts parts(any(draw), any(draw), any(draw), any(draw));
    const Vector3d wish = look(parts);
    double nearest = 1e9;
    for (int a = 0; a <= 12; ++a) {
      for (int b = 0; a + b <= 12; ++b) {
        for (int c = 0; a + b + c <= 12; ++c) {
          nearest = std::min(nearest, (look(Parts(a, b, c, 12 - a - b - c)) - wish).norm());
        }
      }
    }
    const Fit fit = fit_units(look, wish, parts, 4, 12);
    EXPECT_NEAR(fit.distance, nearest, 1e-12);
    const Parts counts = fit.parts * 12;
    EXPECT_LT((counts - Parts(counts.array().round())).norm(), 1e-12);
    EXPECT_NEAR(counts.sum(), 12, 1e-12);
  }
}

TEST(PieceBound, OfAFlatPieceIsItsDistance) {
  const std::vector<Vector3d> corners{{3, -1, -1}, {3, 4, -1}, {3, -1, 4}},
      flat(3, Vector3d(0, 0, 0));
  EXPECT_NEAR(piece_bound(corners, flat, 0), 3, 1e-12);  // the origin projects inside
  const std::vector<Vector3d> edge{{1, 1, 0}, {1, 3, 0}};
  EXPECT_NEAR(piece_bound(edge, std::vector<Vector3d>(1, Vector3d(0, 0, 0)), 0), std::sqrt(2.0),
              1e-3);
}

// The assumption that the bound rests on, asked of real mixtures at random: pieces of one to three
// cuts, looked at from outside.
TEST(PieceBound, StaysBelowTheMixturesOfEveryPiece) {
  const BaseSet set = test::some_papers(6);
  const ViewedTable table(set, test::sphere_room, {});
  const SearchSpace space(set, table, {50, 0, 0}, 1);
  std::mt19937 draw(7);
  std::uniform_real_distribution<double> any(0, 1);
  for (int n = 0; n < 200; ++n) {
    BaseNumbers triple{.count = 3, .at = {}};
    for (int i : {0, 1, 2}) triple.at[static_cast<std::size_t>(i)] = static_cast<int>(draw() % 77);
    const double size = std::pow(0.5, static_cast<double>(draw() % 4));
    Parts inside(any(draw), any(draw), any(draw), 0);
    inside *= (1 - size) / inside.sum();
    std::vector<Vector3d> corners, deviations;
    const auto at = [&](const Parts& p) { return space.look(triple, inside + size * p); };
    const Vector3d wish(100 * any(draw), 150 * any(draw) - 75, 150 * any(draw) - 75);
    for (int i : {0, 1, 2}) corners.push_back(at(Parts::Unit(i)) - wish);
    double bulge = 0;
    for (int i : {0, 1, 2}) {
      const int j = (i + 1) % 3;
      const Vector3d ends =
          corners[static_cast<std::size_t>(i)] + corners[static_cast<std::size_t>(j)];
      deviations.push_back(at((Parts::Unit(i) + Parts::Unit(j)) / 2) - wish - ends / 2);
      bulge = std::max(bulge, deviations.back().norm());
    }
    const double bound = piece_bound(corners, deviations, bulge);
    for (int k = 0; k < 20; ++k) {
      Parts p(any(draw), any(draw), any(draw), 0);
      EXPECT_GE((at(p / p.sum()) - wish).norm(), bound - 1e-3);
    }
  }
}

}  // namespace
}  // namespace paints
