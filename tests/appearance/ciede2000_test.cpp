#include "appearance/ciede2000.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace appearance {
namespace {

const spectra::RelativeXyz kWhite{.x = 95, .y = 100, .z = 109};

TEST(Cielab, FollowsItsDefinition) {
  const Lab white = cielab(kWhite, kWhite), black = cielab({0, 0, 0}, kWhite);
  EXPECT_NEAR(white.l, 100, 1e-12);
  EXPECT_NEAR(std::hypot(white.a, white.b), 0, 1e-12);
  EXPECT_NEAR(black.l, 0, 1e-13);
  const Lab sample = cielab({.x = 95. / 8, .y = 100. / 27, .z = 109. / 64}, kWhite);
  EXPECT_NEAR(sample.l, 116. / 3 - 16, 1e-12);
  EXPECT_NEAR(sample.a, 500 * (1. / 2 - 1. / 3), 1e-12);
  EXPECT_NEAR(sample.b, 200 * (1. / 3 - 1. / 4), 1e-12);
}

// Below (6/29)^3 of white a straight line: L* = (29/3)^3 Y / Y_n; negative values stay defined.
TEST(Cielab, IsAStraightLineForTheDarkest) {
  EXPECT_NEAR(cielab({0, 0.5, 0}, kWhite).l, 0.005 * std::pow(29. / 3, 3), 1e-12);
  EXPECT_NEAR(cielab({0, -0.5, 0}, kWhite).l, -0.005 * std::pow(29. / 3, 3), 1e-12);
}

TEST(Cielab, NeedsAWhite) {
  EXPECT_THROW((void)cielab({1, 1, 1}, {.x = 95, .y = 100, .z = 0}), std::domain_error);
}

TEST(Ciede2000, OfGreysIsTheWeightedLightness) {
  EXPECT_EQ(ciede2000({50, 10, -20}, {50, 10, -20}), 0);
  EXPECT_NEAR(ciede2000({49, 0, 0}, {51, 0, 0}), 2, 1e-12);
  const double from_50 = 30 * 30, weight = 1 + 0.015 * from_50 / std::sqrt(20 + from_50);
  EXPECT_NEAR(ciede2000({79, 0, 0}, {81, 0, 0}), 2 / weight, 1e-12);
}

}  // namespace
}  // namespace appearance
