#include "appearance/cam02_ucs.h"

#include <gtest/gtest.h>

#include <cmath>

namespace appearance {
namespace {

// [Luo2006]: J' = 1.7 J / (1 + 0.007 J), M' = ln(1 + 0.0228 M) / 0.0228; black and white keep their
// lightness.
TEST(Cam02Ucs, FollowsItsDefinition) {
  EXPECT_EQ(cam02_ucs({0, 0, 0}).j, 0);
  EXPECT_NEAR(cam02_ucs({100, 0, 0}).j, 100, 1e-12);
  EXPECT_NEAR(cam02_ucs({50, 0, 0}).j, 85 / 1.35, 1e-12);
  const UcsColour red = cam02_ucs({50, 10, 0}), green = cam02_ucs({50, 10, 180});
  EXPECT_NEAR(red.a, std::log(1.228) / 0.0228, 1e-12);
  EXPECT_NEAR(green.a, -red.a, 1e-12);
  EXPECT_NEAR(cam02_ucs({50, 10, 90}).b, red.a, 1e-12);
}

TEST(Cam02Ucs, SmallColourfulnessIsKept) {
  EXPECT_NEAR(cam02_ucs({50, 1e-12, 0}).a, 1e-12, 1e-24);  // ln(1 + x) would lose four digits
}

TEST(Cam02Ucs, DistanceIsEuclidean) {
  EXPECT_EQ(ucs_distance({1, 2, 3}, {1, 2, 3}), 0);
  EXPECT_NEAR(ucs_distance({1, 2, 3}, {3, 5, 9}), 7, 1e-14);
}

}  // namespace
}  // namespace appearance
