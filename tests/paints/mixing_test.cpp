#include "paints/mixing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/paints/sphere_room.h"

namespace paints {
namespace {

using Eigen::ArrayXd;
using Eigen::VectorXd;
using spectra::kTransportGrid;

BaseSet two_greys(double first_k, double first_s, double second_k, double second_s) {
  const auto grey = [](double v) { return ArrayXd(ArrayXd::Constant(31, v)); };
  return {.grid = kTransportGrid,
          .bases = {{"first", "", grey(first_k), grey(first_s)},
                    {"second", "", grey(second_k), grey(second_s)}}};
}

// [KubelkaMunk1931]: (1 - 0.5)^2 / (2 * 0.5) = 1/4, (1 - 0.2)^2 / 0.4 = 1.6.
TEST(KubelkaMunk, OpaqueFilmIsTheClosedForm) {
  EXPECT_DOUBLE_EQ(k_over_s(0.5), 0.25);
  EXPECT_DOUBLE_EQ(k_over_s(0.2), 1.6);
  EXPECT_DOUBLE_EQ(body_reflectance(0.25), 0.5);
  EXPECT_DOUBLE_EQ(body_reflectance(0), 1);
}

TEST(KubelkaMunk, ReturnsFromEitherEndWithItsDigits) {
  for (const double r : {1e-6, 0.014, 0.3, 0.93, 0.999999}) {
    EXPECT_NEAR(body_reflectance(k_over_s(r)) / r, 1, 1e-14);
  }
}

// [Saunderson1942]: a black body shows k1, a perfect white stays white.
TEST(SaundersonSurface, ShowsItselfOnBlackAndReturns) {
  const Saunderson gloss{.k1 = 0.04, .k2 = 0.6};
  EXPECT_DOUBLE_EQ(measured_reflectance(0, gloss), 0.04);
  EXPECT_DOUBLE_EQ(measured_reflectance(1, gloss), 1);
  // 0.04 + 0.96 * 0.4 * 0.5 / 0.7
  EXPECT_NEAR(measured_reflectance(0.5, gloss), 0.04 + 0.192 / 0.7, 1e-15);
  for (const double r : {0.05, 0.3, 0.93}) {
    EXPECT_NEAR(measured_reflectance(body_behind(r, gloss), gloss), r, 1e-15);
  }
}

// K/S 1/4 and 1.6 in equal parts: 0.925. In parts 1 : 3: 1.2625.
TEST(MixtureOf, SingleConstantBasesAveragesKOverS) {
  const BaseSet set = two_greys(0.25, 1, 1.6, 1);
  EXPECT_NEAR(mixture(set, {0, 1}, VectorXd{{1, 1}}).reflectance.values[7], body_reflectance(0.925),
              1e-15);
  EXPECT_NEAR(mixture(set, {0, 1}, VectorXd{{1, 3}}).reflectance.values[7],
              body_reflectance(1.2625), 1e-15);
}

// K 1 and 2, S 3 and 1: K/S of equal parts is 3/4, where K/S alone would average 7/6.
TEST(MixtureOf, TwoConstantBasesAddsKAndSApart) {
  const BaseSet set = two_greys(1, 3, 2, 1);
  EXPECT_NEAR(mixture(set, {0, 1}, VectorXd{{1, 1}}).reflectance.values[0], body_reflectance(0.75),
              1e-15);
}

TEST(MixtureOf, OnePaintIsThePaintItself) {
  for (const Saunderson& surface : {Saunderson{}, Saunderson{.k1 = 0.01, .k2 = 0.5}}) {
    const BaseSet set = test::some_papers(50, surface);
    const Atlas atlas = load_atlas("munsell-nickerson");
    for (std::size_t i = 0; i < set.bases.size(); ++i) {
      const Mixture alone = mixture(set, {static_cast<int>(i)}, VectorXd::Constant(1, 3));
      const ArrayXd& paper = atlas.paints[50 * i].reflectance.values;
      EXPECT_LT((alone.reflectance.values - paper).abs().maxCoeff(), 1e-14);
    }
  }
}

TEST(MixtureOf, SeveralPaintsLiesBetweenThemWhateverTheUnitOfParts) {
  const BaseSet set = test::some_papers(50);
  const std::vector<int> bases{1, 4, 7};
  const ArrayXd mixed = mixture(set, bases, VectorXd{{1, 2, 3}}).reflectance.values;
  ArrayXd least = ArrayXd::Ones(31), most = ArrayXd::Zero(31);
  for (const int base : bases) {
    const ArrayXd alone = mixture(set, {base}, VectorXd::Ones(1)).reflectance.values;
    least = least.min(alone), most = most.max(alone);
  }
  EXPECT_TRUE((mixed >= least).all() && (mixed <= most).all());
  const ArrayXd same = mixture(set, bases, VectorXd{{10, 20, 30}}).reflectance.values;
  EXPECT_LT((mixed - same).abs().maxCoeff(), 1e-15);
}

TEST(MixtureOf, PaintsHasTheSlopesOfCentralDifferences) {
  BaseSet two_constants = test::some_papers(50, {.k1 = 0.01, .k2 = 0.5});
  for (std::size_t i = 0; i < two_constants.bases.size(); ++i) {
    const double unit = 0.5 + 0.1 * static_cast<double>(i);
    two_constants.bases[i].absorption *= unit;
    two_constants.bases[i].scattering *= unit;
  }
  for (const BaseSet& set : {test::some_papers(50), two_constants}) {
    const std::vector<int> bases{1, 4, 7};
    const VectorXd parts{{0.2, 0.5, 0.3}};
    const Mixture mixed = mixture(set, bases, parts);
    for (int i = 0; i < 3; ++i) {
      const double step = 1e-5;
      const VectorXd offset = step * VectorXd::Unit(3, i);
      const ArrayXd difference = (mixture(set, bases, parts + offset).reflectance.values -
                                  mixture(set, bases, parts - offset).reflectance.values) /
                                 (2 * step);
      EXPECT_LT((mixed.by_parts.col(i).array() - difference).abs().maxCoeff(), 1e-8);
    }
    // Only proportions matter, so more of everything changes nothing (Euler).
    EXPECT_LT((mixed.by_parts * parts).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST(BasesOf, LeavesOutPaintsDarkerThanTheirSurface) {
  const Atlas atlas{.name = "two",
                    .source = "test",
                    .paints = {{"dark", spectra::constant(kTransportGrid, 0.03), ""},
                               {"light", spectra::constant(kTransportGrid, 0.5), ""}}};
  EXPECT_EQ(bases_of(atlas).bases.size(), 2U);
  const BaseSet set = bases_of(atlas, {.k1 = 0.04, .k2 = 0.6});
  EXPECT_EQ(set.bases.size(), 1U);
  EXPECT_THAT(set.left_out, testing::ElementsAre("dark"));
}

TEST(MixtureOf, NothingIsRefused) {
  const BaseSet set = two_greys(1, 3, 2, 1);
  EXPECT_THROW((void)mixture(set, {}, VectorXd()), std::invalid_argument);
  EXPECT_THROW((void)mixture(set, {0, 2}, VectorXd::Ones(2)), std::invalid_argument);
  EXPECT_THROW((void)mixture(set, {0, 1}, VectorXd::Ones(3)), std::invalid_argument);
  EXPECT_THROW((void)mixture(set, {0, 1}, VectorXd::Zero(2)), std::invalid_argument);
  EXPECT_THROW((void)mixture(set, {0, 1}, VectorXd{{2, -1}}), std::invalid_argument);
  EXPECT_THROW((void)bases_of(Atlas{}, {.k1 = 1, .k2 = 0}), std::invalid_argument);
  EXPECT_THROW((void)bases_of(Atlas{}, {.k1 = 0, .k2 = -0.1}), std::invalid_argument);
}

}  // namespace
}  // namespace paints
