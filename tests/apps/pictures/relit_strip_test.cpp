#include "apps/pictures/relit_strip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace apps {
namespace {

const float kInfinity = std::numeric_limits<float>::infinity();
const Relighting kTurn{.matrix = (Eigen::Matrix3f() << 0, 2, 0, 0, 0, 1, -1, 0, 0).finished(),
                       .infinite = {kInfinity, kInfinity, kInfinity}};

struct Strip {
  explicit Strip(int count) {
    for (std::size_t c = 0; c < 3; ++c) {
      for (int i = 0; i < count; ++i)
        values[c].push_back(static_cast<float>(1 + i % 97) + 0.25F * static_cast<float>(c));
    }
  }

  PixelStatistics relight(const Relighting& relighting) {
    PixelStatistics statistics;
    relight_strip(relighting, {values[0].data(), values[1].data(), values[2].data()},
                  static_cast<int>(values[0].size()), statistics);
    return statistics;
  }

  std::array<std::vector<float>, 3> values;
};

// Lengths about the number of lanes and the longest one: whatever is left over counts too.
TEST(RelitStrip, EveryLengthIsMultipliedAndCounted) {
  for (const int count : {1, 2, 15, 16, 17, 33, 97, 1023, kStrip}) {
    Strip strip(count);
    const Strip before = strip;
    const PixelStatistics s = strip.relight(kTurn);
    EXPECT_EQ(s.pixels, count);
    EXPECT_EQ(s.negative, count);  // blue becomes -red
    EXPECT_EQ(s.after[2].negative, count);
    EXPECT_EQ(s.after[0].negative, 0);
    double sum = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      EXPECT_EQ(strip.values[0][i], 2 * before.values[1][i]);
      EXPECT_EQ(strip.values[1][i], before.values[2][i]);
      EXPECT_EQ(strip.values[2][i], -before.values[0][i]);
      sum += static_cast<double>(before.values[0][i]);
    }
    EXPECT_EQ(s.before[0].sum, sum);  // quarters: exact in any order
    EXPECT_EQ(s.after[2].sum, -sum);
    EXPECT_EQ(s.before[0].lowest, 1);
    EXPECT_EQ(s.before[0].highest, static_cast<float>(std::min(count, 97)));
    EXPECT_EQ(s.after[2].lowest, -s.before[0].highest);
  }
}

TEST(RelitStrip, PixelsThatAreNoNumbersStayAndDisturbNothing) {
  Strip strip(100);
  const Strip before = strip;
  strip.values[0][3] = NAN;
  strip.values[1][50] = kInfinity;
  strip.values[2][99] = -kInfinity;
  const PixelStatistics s = strip.relight(kTurn);
  EXPECT_EQ(s.pixels, 100);
  EXPECT_EQ(s.not_finite, 3);
  EXPECT_EQ(s.negative, 97);
  EXPECT_TRUE(std::isfinite(s.before[1].sum));
  EXPECT_TRUE(std::isnan(strip.values[0][3]));
  EXPECT_EQ(strip.values[1][3], before.values[1][3]);
  EXPECT_EQ(strip.values[1][50], kInfinity);
  EXPECT_EQ(strip.values[0][4], 2 * before.values[1][4]);
  EXPECT_EQ(strip.values[0][98], 2 * before.values[1][98]);
}

TEST(RelitStrip, OnlyInfinitiesLeaveNoStatistics) {
  Strip strip(5);
  for (float& value : strip.values[0]) value = kInfinity;
  const PixelStatistics s = strip.relight(kTurn);
  EXPECT_EQ(s.not_finite, 5);
  EXPECT_EQ(s.before[1].sum, 0);
  EXPECT_EQ(s.before[1].lowest, kInfinity);
}

TEST(RelitStrip, CountsWhatItsTypeCannotHold) {
  Strip strip(20);
  strip.values[1][7] = 40000;  // doubled, above the largest half
  Relighting halves = kTurn;
  halves.infinite = {65520, 65520, 65520};
  EXPECT_EQ(Strip(strip).relight(kTurn).overflowed, 0);
  EXPECT_EQ(strip.relight(halves).overflowed, 1);
}

}  // namespace
}  // namespace apps
