#include "apps/pictures/false_colour.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace apps {
namespace {

using testing::ElementsAre;

TEST(FalseColour, TicksAreOneTwoAndFiveAroundTheRange) {
  EXPECT_THAT(decade_ticks(30, 450), ElementsAre(20, 50, 100, 200, 500));
  EXPECT_THAT(decade_ticks(100, 1000), ElementsAre(100, 200, 500, 1000));
  EXPECT_THAT(decade_ticks(3, 3), ElementsAre(2, 5));
}

TEST(FalseColour, ViridisHasItsEndsAndGrowsLighter) {
  EXPECT_LT((255 * viridis(0) - Eigen::Vector3d(68, 1, 84)).norm(), 1e-12);
  EXPECT_LT((255 * viridis(2) - Eigen::Vector3d(253, 231, 37)).norm(), 1e-12);
  double before = 0;
  for (double at = 0; at <= 1; at += 0.05) {
    const Eigen::Vector3d linear = viridis(at).array().pow(2.2);
    const double luminance = linear.dot(Eigen::Vector3d(0.2126, 0.7152, 0.0722));
    EXPECT_GT(luminance, before);
    before = luminance;
  }
}

// A ramp over two decades: colours stand at the logarithm, lines at the ticks, a legend beside.
TEST(FalseColour, APixelHasTheColourOfItsLogarithm) {
  constexpr int kWidth = 400, kHeight = 100;
  Eigen::ArrayXf values(kWidth * kHeight);
  const auto at = [](int x) { return static_cast<double>(x) / (kWidth - 1); };
  for (int k = 0; k < values.size(); ++k) {
    values[k] = static_cast<float>(std::pow(10, 1 + 2 * at(k % kWidth)));
  }
  const PngPicture png = false_colours(kWidth, kHeight, values, {"luminance", "cd/m2"});
  EXPECT_GT(png.width, kWidth);
  int lines = 0;
  for (int x = 0; x < kWidth; ++x) {
    const auto pixel = 3 * (50 * static_cast<std::size_t>(png.width) + static_cast<std::size_t>(x));
    double error = 0;
    for (int c = 0; c < 3; ++c) {
      error = std::max(error, std::abs(png.samples[pixel + static_cast<std::size_t>(c)] -
                                       255 * viridis(at(x))[c]));
    }
    lines += error > 2 ? 1 : 0;
  }
  EXPECT_GE(lines, 5);  // 20, 50, 100, 200, 500
  EXPECT_LE(lines, 7);  // and the ends
}

TEST(FalseColour, DarknessIsNoFault) {
  const PngPicture png = false_colours(2, 2, Eigen::ArrayXf::Zero(4), {"illuminance", "lx"});
  EXPECT_EQ(png.samples[0], 68);
}

}  // namespace
}  // namespace apps
