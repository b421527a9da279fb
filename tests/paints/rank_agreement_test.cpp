#include "paints/rank_agreement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace paints {
namespace {

TEST(KendallTau, SameOrderIsOneAndTheReverseMinusOne) {
  EXPECT_DOUBLE_EQ(kendall_tau({0.1, 2, 30}, {5, 6, 7}), 1);
  EXPECT_DOUBLE_EQ(kendall_tau({0.1, 2, 30}, {7, 6, 5}), -1);
}

// 1 2 3 4 5 beside 2 1 4 3 5: 8 of the 10 pairs agree and 2 do not, (8 - 2) / 10.
TEST(KendallTau, CountsPairsByHand) {
  EXPECT_DOUBLE_EQ(kendall_tau({1, 2, 3, 4, 5}, {2, 1, 4, 3, 5}), 0.6);
}

// 1 1 2 3 beside 1 2 3 3: 4 pairs agree, none disagrees, each ties one of its 6 pairs:
// 4 / sqrt(5 * 5).
TEST(KendallTau, TiesCountInTheDenominator) {
  EXPECT_DOUBLE_EQ(kendall_tau({1, 1, 2, 3}, {1, 2, 3, 3}), 0.8);
}

TEST(KendallTau, RefusesWhatHasNoOrder) {
  EXPECT_THROW((void)kendall_tau({1, 2}, {1, 2, 3}), std::invalid_argument);
  EXPECT_THROW((void)kendall_tau({1, 1}, {1, 2}), std::invalid_argument);
  EXPECT_THROW((void)kendall_tau({1, std::numeric_limits<double>::quiet_NaN()}, {1, 2}),
               std::invalid_argument);
}

// The best three: places 0, 1, 2 and 2, 3, 0.
TEST(TopOverlap, CountsCommonPlacesByHand) {
  EXPECT_EQ(top_overlap({1, 2, 3, 4, 5}, {3, 5, 1, 2, 4}, 3), 2);
  EXPECT_EQ(top_overlap({1, 2, 3, 4}, {4, 3, 2, 1}, 2), 0);
  EXPECT_EQ(top_overlap({1, 2, 3, 4}, {4, 3, 2, 1}, 4), 4);
}

TEST(TopOverlap, TheEarlierOfEqualsComesFirst) {
  EXPECT_EQ(top_overlap({1, 1, 1}, {1, 2, 3}, 1), 1);
  EXPECT_EQ(top_overlap({1, 1, 1}, {3, 2, 1}, 1), 0);
}

TEST(TopOverlap, RefusesMoreThanThereAre) {
  EXPECT_THROW((void)top_overlap({1, 2}, {1, 2}, 3), std::invalid_argument);
}

}  // namespace
}  // namespace paints
