// [Neumann2004] Table 2: three stimuli under whites of 7500, 6000 and 4500 K that look alike,
// J = 81.59, C = 21.56, h = 59.40. Average surround, Y_b = 18, Y_w = 90.
#include <gtest/gtest.h>

#include "appearance/ciecam02.h"

namespace appearance {
namespace {

struct Row {
  const char* name;
  double adapting_luminance_cd_m2;
  spectra::RelativeXyz white, sample;
};

constexpr Row kRows[] = {
    {"7500 K", 954.93, {87.12, 90.00, 112.95}, {61.34, 59.94, 50.07}},
    {"6000 K", 636.62, {87.38, 90.00, 93.91}, {62.58, 60.41, 41.62}},
    {"4500 K", 318.31, {89.32, 90.00, 68.24}, {65.42, 61.10, 30.24}},
};

Adaptation adaptation(const Row& row) {
  return adapt({.white = row.white,
                .adapting_luminance_cd_m2 = row.adapting_luminance_cd_m2,
                .background_y = 18,
                .surround = {}});
}

// More digits than the paper prints, from its rounded input in 50-digit arithmetic
// (tests/support/ciecam02_reference.py).
TEST(Neumann2004Table2, FirstRowInFourDecimals) {
  const Correlates p = ciecam02_forward(kRows[0].sample, adaptation(kRows[0]));
  EXPECT_NEAR(p.lightness, 81.5925, 0.00005);
  EXPECT_NEAR(p.chroma, 21.5576, 0.00005);
  EXPECT_NEAR(p.hue_deg, 59.4027, 0.00005);
}

// XYZ is printed to 0.005, which is 0.003 in J, 0.007 in C and 0.03 degrees in h for 4500 K.
TEST(Neumann2004Table2, EveryRowHasTheSameAppearance) {
  for (const Row& row : kRows) {
    const Correlates p = ciecam02_forward(row.sample, adaptation(row));
    EXPECT_NEAR(p.lightness, 81.59, 0.005 + 0.003) << row.name;
    EXPECT_NEAR(p.chroma, 21.56, 0.005 + 0.007) << row.name;
    EXPECT_NEAR(p.hue_deg, 59.40, 0.005 + 0.05) << row.name;
  }
}

// From the appearance of the first row to the stimuli of the others: half a unit of the last digit
// printed, and once more what that leaves open in the first row.
TEST(Neumann2004Table2, InverseGivesThePrintedStimuli) {
  const Correlates p = ciecam02_forward(kRows[0].sample, adaptation(kRows[0]));
  for (const Row& row : kRows) {
    const auto xyz = ciecam02_inverse({p.lightness, p.chroma, p.hue_deg}, adaptation(row));
    EXPECT_NEAR(xyz.x, row.sample.x, 0.01) << row.name;
    EXPECT_NEAR(xyz.y, row.sample.y, 0.01) << row.name;
    EXPECT_NEAR(xyz.z, row.sample.z, 0.01) << row.name;
  }
}

}  // namespace
}  // namespace appearance
