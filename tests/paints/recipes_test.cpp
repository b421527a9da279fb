#include "paints/recipes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "appearance/jab_slope.h"
#include "paints/viewed_table.h"
#include "tests/paints/sphere_room.h"

namespace paints {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

Vector3d jab_of(const spectra::Spectrum& paint) {
  return appearance::jab_slope(test::sphere_room(paint)).jab;
}

Target target_at(const Vector3d& jab) {
  return {.lightness = jab[0], .a_c = jab[1], .b_c = jab[2], .colourfulness = 0};
}

Vector3d mixed(const BaseSet& set, const std::vector<int>& bases, const VectorXd& parts) {
  return jab_of(mixture(set, bases, parts).reflectance);
}

Vector3d jab_of(const Recipe& recipe) {
  const appearance::Correlates& k = recipe.correlates;
  return {k.lightness, k.a_c, k.b_c};
}

const BaseSet& papers() {
  static const BaseSet kSet = test::some_papers(14);  // 33 papers
  return kSet;
}

TEST(ViewedTable, AgreesWithTheRoomAndItsSlopes) {
  const ViewedTable table(papers(), test::sphere_room, {});
  std::mt19937 draw(5);
  std::uniform_real_distribution<double> any(0, 1);
  for (int n = 0; n < 200; ++n) {
    BaseNumbers bases{.count = 3, .at = {}};
    for (std::size_t i = 0; i < 3; ++i) bases.at[i] = static_cast<int>(draw() % 33);
    const Parts parts(any(draw), any(draw), any(draw), 0);
    const Mixture exact =
        mixture(papers(), {bases.at[0], bases.at[1], bases.at[2]}, parts.head<3>());
    const auto wanted = appearance::jab_slope(test::sphere_room(exact.reflectance));
    EXPECT_LT((table.jab(bases, parts) - wanted.jab).norm(), 1e-3);  // float
    const JabOfParts slope = table.slope(bases, parts);
    const Eigen::Matrix3d by_parts = wanted.by_reflectance * exact.by_parts;
    EXPECT_LT((slope.jab - wanted.jab).norm(), 1e-3);
    EXPECT_LT((slope.by_parts.leftCols<3>() - by_parts).norm(), 1e-3 * (1 + by_parts.norm()));
  }
}

TEST(FindRecipes, RecoversAMixtureOfTwoPaints) {
  for (const auto& [first, second, share] :
       {std::tuple(3, 20, 0.7), std::tuple(12, 31, 0.02), std::tuple(30, 5, 0.5)}) {
    const Vector3d wish = mixed(papers(), {first, second}, VectorXd{{1 - share, share}});
    const Recipes found =
        find_recipes(papers(), target_at(wish), test::sphere_room, {.bases = 2, .threads = 2});
    const Recipe& best = found.recipes.front();
    EXPECT_LT((jab_of(best) - wish).cwiseAbs().maxCoeff(), 0.01);
    EXPECT_LT(best.distance, 1e-6);  // with exact slopes it is found to rounding
  }
}

TEST(FindRecipes, ReportsWhatItsRecipesLookLikeNearestFirst) {
  const Vector3d wish(45, 25, 10);
  const Recipes found =
      find_recipes(papers(), target_at(wish), test::sphere_room, {.bases = 3, .count = 30});
  ASSERT_EQ(found.recipes.size(), 30U);
  double last = 0;
  std::vector<std::vector<int>> seen;
  for (const Recipe& recipe : found.recipes) {
    EXPECT_LE(recipe.bases.size(), 3U);
    EXPECT_NEAR(recipe.parts.sum(), 1, 1e-12);
    EXPECT_GT(recipe.parts.minCoeff(), 0);
    EXPECT_LT((mixed(papers(), recipe.bases, recipe.parts) - jab_of(recipe)).norm(), 1e-9);
    EXPECT_NEAR(recipe.distance, (jab_of(recipe) - wish).norm(), 1e-9);
    EXPECT_GE(recipe.distance, last > 1e-6 ? last : 0);
    EXPECT_EQ(std::count(seen.begin(), seen.end(), recipe.bases), 0);
    seen.push_back(recipe.bases);
    last = recipe.distance;
  }
}

TEST(FindRecipes, FurtherBasesNeverTakeTheWallAway) {
  for (const Vector3d& wish : {Vector3d(45, 25, 10), Vector3d(80, 20, 70)}) {
    double last = std::numeric_limits<double>::infinity();
    for (int bases = 1; bases <= 4; ++bases) {
      const Recipes found =
          find_recipes(papers(), target_at(wish), test::sphere_room, {.bases = bases});
      EXPECT_LE(found.recipes.front().distance, last + 1e-9);
      last = found.recipes.front().distance;
    }
  }
}

/// The nearest of all triples of a small set on a fine lattice of shares, whose strength is near
/// enough that of the set.
double nearest_on_lattice(const BaseSet& set, const ViewedTable& table, const Vector3d& wish) {
  constexpr int kSteps = 24;
  double nearest = std::numeric_limits<double>::infinity();
  const auto strength = [&](int i) {
    const Base& base = set.bases[static_cast<std::size_t>(i)];
    return std::exp((base.absorption * base.scattering).log().mean() / 2);
  };
  const int n = static_cast<int>(set.bases.size());
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) {
      for (int k = j + 1; k < n; ++k) {
        for (int a = 0; a <= kSteps; ++a) {
          for (int b = 0; a + b <= kSteps; ++b) {
            const Parts parts(a / strength(i), b / strength(j), (kSteps - a - b) / strength(k), 0);
            const Vector3d jab = table.jab({.count = 3, .at = {i, j, k}}, parts);
            nearest = std::min(nearest, (jab - wish).norm());
          }
        }
      }
    }
  }
  return nearest;
}

TEST(FindRecipes, MissesNoTripleOfAFineLattice) {
  const BaseSet set = test::some_papers(52);  // 9 papers, 84 triples
  const ViewedTable table(set, test::sphere_room, {});
  std::mt19937 draw(11);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int n = 0; n < 6; ++n) {
    const Vector3d wish(50 + 45 * any(draw), 60 * any(draw), 60 * any(draw));
    const Recipes found = find_recipes(set, target_at(wish), test::sphere_room);
    EXPECT_TRUE(found.search.global_triples);
    EXPECT_EQ(found.search.unresolved, 0);
    EXPECT_LE(found.recipes.front().distance,
              nearest_on_lattice(set, table, wish) + found.search.tolerance + 1e-3);
  }
}

TEST(FindRecipes, AnswersTheSameForAnyNumberOfThreads) {
  const Target target = target_at({80, 20, 70});
  const Recipes one = find_recipes(papers(), target, test::sphere_room, {.threads = 1});
  const Recipes three = find_recipes(papers(), target, test::sphere_room, {.threads = 3});
  ASSERT_EQ(one.recipes.size(), three.recipes.size());
  EXPECT_EQ(one.search.pieces_cut, three.search.pieces_cut);
  for (std::size_t i = 0; i < one.recipes.size(); ++i) {
    EXPECT_EQ(one.recipes[i].bases, three.recipes[i].bases);
    EXPECT_EQ(one.recipes[i].parts, three.recipes[i].parts);
  }
}

TEST(FindRecipes, KeepsToUnitsThatCanBeWeighed) {
  const Target target = target_at({45, 25, 10});
  const Recipes any_parts = find_recipes(papers(), target, test::sphere_room, {.bases = 3});
  const Recipes units =
      find_recipes(papers(), target, test::sphere_room, {.bases = 3, .units = 20});
  EXPECT_GE(units.recipes.front().distance, any_parts.recipes.front().distance - 1e-9);
  for (const Recipe& recipe : units.recipes) {
    const VectorXd counts = 20 * recipe.parts;
    EXPECT_LT((counts - VectorXd(counts.array().round())).norm(), 1e-9);
  }
}

TEST(FindRecipes, OneBaseIsTheBestSinglePaint) {
  const Vector3d wish(45, 25, 10);
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < papers().bases.size(); ++i) {
    const Vector3d alone = mixed(papers(), {static_cast<int>(i)}, VectorXd::Ones(1));
    nearest = std::min(nearest, (alone - wish).norm());
  }
  const Recipes found = find_recipes(papers(), target_at(wish), test::sphere_room, {.bases = 1});
  EXPECT_NEAR(found.recipes.front().distance, nearest, 1e-9);
}

TEST(FindRecipes, RefusesWhatHasNoMeaning) {
  const Target target = target_at({50, 0, 0});
  const auto refuses = [&](const RecipeOptions& options) {
    EXPECT_THROW((void)find_recipes(papers(), target, test::sphere_room, options),
                 std::invalid_argument);
  };
  refuses({.bases = 0});
  refuses({.bases = 5});
  refuses({.units = -1});
  refuses({.threads = 0});
  EXPECT_THROW((void)find_recipes({}, target, test::sphere_room), std::invalid_argument);
  EXPECT_THROW((void)find_recipes(papers(), target_at({std::nan(""), 0, 0}), test::sphere_room),
               std::invalid_argument);
  const auto dark = [](const spectra::Spectrum& paint) {
    spectra::ViewedLightSlope light = test::sphere_room(paint);
    light.light.white.values.setZero();
    return light;
  };
  EXPECT_THROW((void)find_recipes(papers(), target, dark), std::domain_error);
}

}  // namespace
}  // namespace paints
