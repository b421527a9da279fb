// The four worked examples that accompany CIECAM02 [Fairchild2005], average surround, Y_b = 20.
#include <gtest/gtest.h>

#include "appearance/ciecam02.h"

namespace appearance {
namespace {

struct Example {
  const char* name;
  spectra::RelativeXyz sample, white;
  double adapting_luminance_cd_m2;
  double h, lightness, brightness, saturation, chroma, colourfulness;
};

constexpr spectra::RelativeXyz kD65{95.05, 100.00, 108.88}, kA{109.85, 100.00, 35.58};

constexpr Example kExamples[] = {
    {"case 1", {19.01, 20.00, 21.78}, kD65, 318.31, 219.0, 41.73, 195.37, 2.36, 0.10, 0.11},
    {"case 2", {57.06, 43.06, 31.96}, kD65, 31.83, 19.6, 65.96, 152.67, 52.25, 48.57, 41.67},
    {"case 3", {3.53, 6.56, 2.14}, kA, 318.31, 177.1, 21.79, 141.17, 58.79, 46.94, 48.80},
    {"case 4", {19.01, 20.00, 21.78}, kA, 31.83, 248.9, 42.53, 122.83, 60.22, 51.92, 44.54},
};

Correlates forward(const Example& e) {
  return ciecam02_forward(e.sample, adapt({.white = e.white,
                                           .adapting_luminance_cd_m2 = e.adapting_luminance_cd_m2,
                                           .background_y = 20,
                                           .surround = {}}));
}

// Half a unit of the last printed digit.
TEST(Ciecam02Examples, AgreeInEveryPrintedDigit) {
  for (const Example& e : kExamples) {
    SCOPED_TRACE(e.name);
    const Correlates p = forward(e);
    EXPECT_NEAR(p.hue_deg, e.h, 0.05);
    EXPECT_NEAR(p.lightness, e.lightness, 0.005);
    EXPECT_NEAR(p.brightness, e.brightness, 0.005);
    EXPECT_NEAR(p.saturation, e.saturation, 0.005);
    EXPECT_NEAR(p.chroma, e.chroma, 0.005);
    EXPECT_NEAR(p.colourfulness, e.colourfulness, 0.005);
  }
}

// The first example with more digits, as documented by the colour-science package [Colour].
TEST(Ciecam02Examples, FirstAgreesWithColourScience) {
  const Correlates p = forward(kExamples[0]);
  const double last_digit = 1e-7;
  EXPECT_NEAR(p.lightness, 41.7310911, last_digit);
  EXPECT_NEAR(p.chroma, 0.1047077, last_digit);
  EXPECT_NEAR(p.hue_deg, 219.0484326, last_digit);
  EXPECT_NEAR(p.saturation, 2.3603053, last_digit);
  EXPECT_NEAR(p.brightness, 195.3713259, last_digit);
  EXPECT_NEAR(p.colourfulness, 0.1088421, last_digit);
  EXPECT_NEAR(p.hue_quadrature, 278.0607358, last_digit);
}

}  // namespace
}  // namespace appearance
