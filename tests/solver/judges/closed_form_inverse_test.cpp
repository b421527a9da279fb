#include "solver/judges/closed_form_inverse.h"

#include <gmock/gmock.h>

#include <limits>
#include <random>

#include "tests/solver/office_brick.h"

namespace solver {
namespace {

using testing::Each;

/// Twenty wavelengths, values in 0..most.
Parts random_parts(Eigen::Index parts, unsigned seed, double most) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, most);
  return Parts::NullaryExpr(parts, 20, [&] { return uniform(random); });
}

Parts column(std::initializer_list<double> values) {
  Parts parts(static_cast<Eigen::Index>(values.size()), 1);
  Eigen::Index i = 0;
  for (const double v : values) parts(i++, 0) = v;
  return parts;
}

// Five walls that reflect nothing and shine with 1: the sixth receives 1 and sends rho.
TEST(InverseCube, AmongBlackLampsTheRadiosityIsTheReflectance) {
  const Parts emission = column({1, 1, 1, 0, 1, 1}), black = Parts::Zero(6, 1);
  for (const CubeFactors& factors : {CubeFactors{}, exact_cube_factors()}) {
    for (const double wished : {0.0, 0.25, 0.999}) {
      const auto found = inverse_cube(
          emission, black, {.of = 3, .by = 3, .radiosity = Eigen::ArrayXd::Constant(1, wished)},
          factors);
      EXPECT_NEAR(found.reflectance[0], wished, 1e-15);
      EXPECT_NEAR(found.least[0], 0, 1e-15);
      EXPECT_NEAR(found.limit[0], 1, 1e-15);
    }
  }
}

// [Neumann2004] section 1: walls that shine with 1 and reflect 0.95 all have 1/(1 - 0.95) = 20.
TEST(InverseCube, FindsTheReflectanceOfTheOpeningExample) {
  for (const double rho : {0.95, 0.90, 0.80}) {
    const double b = 1 / (1 - rho);
    const auto found =
        inverse_cube(Parts::Ones(6, 1), Parts::Constant(6, 1, rho),
                     {.of = 0, .by = 0, .radiosity = Eigen::ArrayXd::Constant(1, b)});
    EXPECT_NEAR(found.reflectance[0], rho, 1e-14);
  }
}

/// Every wall by every wall: wish what a known reflectance gives, and ask for it back.
template <typename Forward, typename Inverse>
void expect_round_trips(Eigen::Index parts, Forward forward, Inverse inverse) {
  const Parts emission = random_parts(parts, 1, 1);
  for (Eigen::Index by = 0; by < parts; ++by) {
    for (Eigen::Index of = 0; of < parts; ++of) {
      const Parts known = random_parts(parts, 2 + static_cast<unsigned>(by), 0.999);
      const WishedRadiosity wish{.of = of, .by = by, .radiosity = forward(emission, known).row(of)};
      const InverseReflectance found = inverse(emission, known, wish);
      EXPECT_THAT(found.reach, Each(Reach::attained)) << of << " by " << by;
      Parts painted = known;
      painted.row(by) = found.reflectance.transpose();
      const Eigen::ArrayXd again = forward(emission, painted).row(of);
      EXPECT_LT((again / wish.radiosity - 1).abs().maxCoeff(), 1e-12) << of << " by " << by;
      if (of == by) {
        const Eigen::ArrayXd truth = known.row(by);
        EXPECT_LT((found.reflectance - truth).abs().maxCoeff(), 1e-12) << by;
      }
    }
  }
}

TEST(InverseCube, ReturnsTheRadiosityThatWasWished) {
  for (const CubeFactors& factors : {CubeFactors{}, exact_cube_factors()}) {
    expect_round_trips(
        6, [&](const Parts& s, const Parts& rho) { return cube_radiosity(s, rho, factors); },
        [&](const Parts& s, const Parts& rho, const WishedRadiosity& wish) {
          return inverse_cube(s, rho, wish, factors);
        });
  }
}

TEST(InverseBrick, ReturnsTheRadiosityThatWasWished) {
  expect_round_trips(
      10, [](const Parts& s, const Parts& rho) { return brick_radiosity(kOffice, s, rho); },
      [](const Parts& s, const Parts& rho, const WishedRadiosity& wish) {
        return inverse_brick(kOffice, s, rho, wish);
      });
}

// The limits are the forward form at reflectance 0 and just below 1.
TEST(InverseBrick, LimitsAreThoseOfTheForwardForm) {
  const Parts emission = random_parts(10, 5, 1);
  Parts rho = random_parts(10, 6, 0.9);
  const WishedRadiosity wish{.of = 0, .by = 5, .radiosity = Eigen::ArrayXd::Ones(20)};
  const InverseReflectance found = inverse_brick(kOffice, emission, rho, wish);
  rho.row(5) = 0;
  const Eigen::ArrayXd darkest = brick_radiosity(kOffice, emission, rho).row(0);
  rho.row(5) = 1 - 1e-15;
  const Eigen::ArrayXd brightest = brick_radiosity(kOffice, emission, rho).row(0);
  EXPECT_LT((found.least / darkest - 1).abs().maxCoeff(), 1e-13);
  EXPECT_LT((found.limit / brightest - 1).abs().maxCoeff(), 1e-12);
}

TEST(InverseBrick, WishesOutOfReachAreNamedAndAnsweredByTheNearest) {
  const Parts emission = random_parts(10, 5, 1), rho = random_parts(10, 6, 0.9);
  WishedRadiosity wish{.of = 1, .by = 4, .radiosity = Eigen::ArrayXd::Ones(20)};
  const InverseReflectance limits = inverse_brick(kOffice, emission, rho, wish);
  wish.radiosity = limits.limit * (1 + 1e-9);
  const InverseReflectance bright = inverse_brick(kOffice, emission, rho, wish);
  EXPECT_THAT(bright.reach, Each(Reach::too_bright));
  EXPECT_GT(bright.reflectance.minCoeff(), 1 - 1e-15);
  EXPECT_LT(bright.reflectance.maxCoeff(), 1);
  wish.radiosity = limits.limit * (1 - 1e-9);
  EXPECT_THAT(inverse_brick(kOffice, emission, rho, wish).reach, Each(Reach::attained));
  wish.radiosity = limits.least * (1 - 1e-9);
  const InverseReflectance dark = inverse_brick(kOffice, emission, rho, wish);
  EXPECT_THAT(dark.reach, Each(Reach::too_dark));
  EXPECT_EQ(dark.reflectance.maxCoeff(), 0);
}

// A wall of no height changes nothing, whatever it reflects.
TEST(InverseBrick, PartWithoutAreaLeavesNoChoice) {
  BrickShape bare = kOffice;
  bare.furniture_height = 0;
  const Parts emission = random_parts(10, 5, 1), rho = random_parts(10, 6, 0.9);
  WishedRadiosity wish{.of = 0, .by = 7, .radiosity = brick_radiosity(bare, emission, rho).row(0)};
  const InverseReflectance found = inverse_brick(bare, emission, rho, wish);
  EXPECT_LT((found.limit / found.least - 1).abs().maxCoeff(), 1e-12);
  EXPECT_THAT(found.reach, Each(Reach::attained));
  wish.radiosity *= 1.01;
  EXPECT_THAT(inverse_brick(bare, emission, rho, wish).reach, Each(Reach::too_bright));
}

TEST(InverseClosedForm, RefusesWhatHasNoAnswer) {
  const Parts good = Parts::Constant(6, 2, 0.5);
  const WishedRadiosity wish{.of = 0, .by = 1, .radiosity = Eigen::ArrayXd::Ones(2)};
  EXPECT_NO_THROW((void)inverse_cube(good, good, wish));
  const auto refuses = [&](auto change) {
    WishedRadiosity bad = wish;
    Parts emission = good, reflectance = good;
    change(bad, emission, reflectance);
    EXPECT_THROW((void)inverse_cube(emission, reflectance, bad), std::invalid_argument);
  };
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  refuses([](auto& w, auto&, auto&) { w.of = 6; });
  refuses([](auto& w, auto&, auto&) { w.by = -1; });
  refuses([](auto& w, auto&, auto&) { w.radiosity = Eigen::ArrayXd::Ones(3); });
  refuses([](auto& w, auto&, auto&) { w.radiosity[1] = -0.1; });
  refuses([](auto& w, auto&, auto&) { w.radiosity[1] = kNaN; });
  refuses([](auto&, auto& s, auto&) { s(1, 1) = -0.1; });  // of the sought part itself
  refuses([](auto&, auto&, auto& rho) { rho(2, 0) = 1; });
  refuses([](auto&, auto& s, auto&) { s = Parts::Ones(5, 2); });
  refuses([](auto&, auto&, auto& rho) { rho = Parts::Ones(10, 2) / 2; });
  EXPECT_THROW((void)inverse_brick(kOffice, good, good, wish), std::invalid_argument);
}

}  // namespace
}  // namespace solver
