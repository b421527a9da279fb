#include "appearance/ciecam02.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

namespace appearance {
namespace {

using spectra::RelativeXyz;

constexpr SurroundFactors kAverage{.f = 1.0, .c = 0.69, .n_c = 1.0};
constexpr SurroundFactors kDim{.f = 0.9, .c = 0.59, .n_c = 0.9};
constexpr SurroundFactors kDark{.f = 0.8, .c = 0.525, .n_c = 0.8};
constexpr RelativeXyz kD65{95.047, 100, 108.883}, kA{109.85, 100, 35.585}, kE{100, 100, 100};
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr ViewingConditions kOffice{
    .white = kD65, .adapting_luminance_cd_m2 = 100, .background_y = 20, .surround = kAverage};

std::vector<ViewingConditions> grid_of_conditions() {
  std::vector<ViewingConditions> all;
  for (const RelativeXyz& white : {kD65, kA, kE, RelativeXyz{48.2, 50, 41.3}}) {
    for (const double adapting : {0.1, 20.0, 318.31, 1e4}) {
      for (const SurroundFactors& surround : {kAverage, kDim, kDark}) {
        all.push_back({white, adapting, 0.2 * white.y, surround});
      }
    }
  }
  return all;
}

double distance(const RelativeXyz& p, const RelativeXyz& q) {
  return std::max({std::abs(p.x - q.x), std::abs(p.y - q.y), std::abs(p.z - q.z)});
}

LightnessChromaHue jch(const Correlates& p) { return {p.lightness, p.chroma, p.hue_deg}; }

void expect_all_zero_except_hue(const Correlates& p) {
  for (const double v : {p.lightness, p.chroma, p.brightness, p.colourfulness, p.saturation, p.a_c,
                         p.b_c, p.a_m, p.b_m, p.a_s, p.b_s}) {
    EXPECT_EQ(v, 0);
  }
}

TEST(Ciecam02, BlackIsExactlyZero) {
  for (const ViewingConditions& view : grid_of_conditions()) {
    const Correlates p = ciecam02_forward({0, 0, 0}, adapt(view));
    expect_all_zero_except_hue(p);
    EXPECT_EQ(p.hue_deg, 0);
    EXPECT_EQ(to_string(p.status), "OK");
  }
}

TEST(Ciecam02, WhiteHasLightness100) {
  for (const ViewingConditions& view : grid_of_conditions()) {
    EXPECT_NEAR(ciecam02_forward(view.white, adapt(view)).lightness, 100, 1e-12);  // rounding
  }
}

// A = 0 with coloured cones: by continuity J = C = Q = M = 0. Found by bisection along blue.
TEST(Ciecam02, VanishesContinuouslyWithTheAchromaticResponse) {
  const Adaptation a = adapt({{96.8, 100, 125.5}, 318.31, 20, kAverage});
  const auto blue = [](double share) { return RelativeXyz{3.756, 0.1218 + share, 18.101}; };
  double negative = 0, positive = 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = (negative + positive) / 2;
    const bool below = ciecam02_forward(blue(middle), a).status.negative_achromatic;
    (below ? negative : positive) = middle;
  }
  const Correlates p = ciecam02_forward(blue(positive), a);
  ASSERT_TRUE(p.status.all_defined());
  // A is one rounding step, 1e-15 of A_w; J goes with its power 1.3, Q, C, M with 0.66.
  EXPECT_LT(p.lightness, 1e-15);
  EXPECT_LT(p.chroma, 1e-6);
  EXPECT_LT(p.brightness, 1e-6);
  EXPECT_GT(p.saturation, 10);
}

TEST(Ciecam02, LightnessAndBrightnessRiseWithLuminance) {
  const Adaptation a = adapt(kOffice);
  double lightness = 0, brightness = 0;
  for (double scale = 1e-9; scale < 100; scale *= 1.1) {
    const Correlates p = ciecam02_forward({40 * scale, 30 * scale, 20 * scale}, a);
    EXPECT_GT(p.lightness, lightness);
    EXPECT_GT(p.brightness, brightness);
    lightness = p.lightness;
    brightness = p.brightness;
  }
}

// [CIE159]: M = C F_L^0.25, s = 100 sqrt(M / Q), and the Cartesian pairs turn by h.
TEST(Ciecam02, CorrelatesAreTiedToEachOther) {
  for (const ViewingConditions& view : grid_of_conditions()) {
    const Adaptation a = adapt(view);
    const Correlates p = ciecam02_forward({20, 12, 8}, a);
    const double cos_h = std::cos(p.hue_deg * std::numbers::pi / 180),
                 sin_h = std::sin(p.hue_deg * std::numbers::pi / 180);
    const double rounding = 1e-12 * p.brightness;
    EXPECT_NEAR(p.colourfulness, p.chroma * a.f_l_4th, rounding);
    EXPECT_NEAR(p.saturation, 100 * std::sqrt(p.colourfulness / p.brightness), rounding);
    EXPECT_NEAR(p.a_c, p.chroma * cos_h, rounding);
    EXPECT_NEAR(p.b_c, p.chroma * sin_h, rounding);
    EXPECT_NEAR(p.a_m, p.colourfulness * cos_h, rounding);
    EXPECT_NEAR(p.b_m, p.colourfulness * sin_h, rounding);
    EXPECT_NEAR(p.a_s, p.saturation * cos_h, rounding);
    EXPECT_NEAR(p.b_s, p.saturation * sin_h, rounding);
  }
}

// Under equal-energy white greys have three equal cone responses, but for the fifth digit of M_HPE,
// whose rows sum to 1.00001, 1 and 1.
TEST(Ciecam02, GreysUnderEqualEnergyWhiteAreNeutral) {
  const Adaptation a = adapt({kE, 100, 20, kAverage});
  for (const double y : {1.0, 20.0, 50.0, 100.0}) {
    EXPECT_LT(ciecam02_forward({y, y, y}, a).chroma, 0.01);
  }
}

TEST(Ciecam02, InverseReturnsRandomColoursUnderEveryCondition) {
  std::mt19937 draw(7);
  std::uniform_real_distribution<double> share(0.02, 1);
  for (const ViewingConditions& view : grid_of_conditions()) {
    const Adaptation a = adapt(view);
    for (int i = 0; i < 200; ++i) {
      const double y = share(draw);
      const RelativeXyz sample{view.white.x * y * (0.8 + 0.4 * share(draw)), view.white.y * y,
                               view.white.z * y * (0.5 + share(draw))};
      const Correlates p = ciecam02_forward(sample, a);
      ASSERT_TRUE(p.status.all_defined());
      // 1e-12: [CIE159] loses two to three digits of the 16 where J is high and C small.
      EXPECT_LT(distance(ciecam02_inverse(jch(p), a), sample), 1e-12 * view.white.y);
    }
  }
}

TEST(Ciecam02, ForwardReturnsCorrelatesOfTheInverse) {
  const Adaptation a = adapt(kOffice);
  for (const double lightness : {1.0, 20.0, 50.0, 95.0}) {
    for (const double chroma : {0.0, 0.5, 20.0, 40.0}) {
      for (double hue_deg = 0; hue_deg < 360; hue_deg += 15) {
        const Correlates p = ciecam02_forward(ciecam02_inverse({lightness, chroma, hue_deg}, a), a);
        EXPECT_NEAR(p.lightness, lightness, 1e-11);
        // Chroma is a power 0.9 of a difference of responses: 1e-12 of it left at C = 0.
        EXPECT_NEAR(p.chroma, chroma, 1e-10);
        if (chroma > 0) {
          EXPECT_NEAR(std::remainder(p.hue_deg - hue_deg, 360), 0, 1e-10);
        }
      }
    }
  }
}

TEST(Ciecam02, InverseOfNoLightnessIsBlack) {
  const RelativeXyz black = ciecam02_inverse({0, 0, 123}, adapt(kOffice));
  EXPECT_EQ(distance(black, {0, 0, 0}), 0);
}

TEST(Ciecam02, StatusNamesWhatIsUndefinedAndLeavesItZero) {
  const Adaptation a = adapt(kOffice);
  const Correlates negative_cone = ciecam02_forward({1, 1, -0.5}, a);
  EXPECT_EQ(to_string(negative_cone.status), "NEGCONE");
  EXPECT_TRUE(negative_cone.status.all_defined());
  EXPECT_GT(negative_cone.chroma, 0);

  const Correlates no_chroma = ciecam02_forward({64, 10, -36}, a);
  EXPECT_EQ(to_string(no_chroma.status), "NEGCONE+TDEN");
  EXPECT_GT(no_chroma.lightness, 0);
  EXPECT_GT(no_chroma.brightness, 0);
  EXPECT_GT(no_chroma.hue_quadrature, 0);
  EXPECT_EQ(no_chroma.chroma, 0);
  EXPECT_EQ(no_chroma.saturation, 0);

  const Correlates nothing = ciecam02_forward({0.5, -33, 21}, a);
  EXPECT_EQ(to_string(nothing.status), "NEGCONE+A_NEG+TDEN");
  expect_all_zero_except_hue(nothing);
  EXPECT_GT(nothing.hue_deg, 0);
}

TEST(Ciecam02, HueStaysBelow360AndQuadratureBelow400) {
  const Adaptation a = adapt(kOffice);
  for (double hue_deg = -20; hue_deg < 380; hue_deg += 0.25) {
    const Correlates p = ciecam02_forward(ciecam02_inverse({50, 20, hue_deg}, a), a);
    EXPECT_GE(p.hue_deg, 0);
    EXPECT_LT(p.hue_deg, 360);
    EXPECT_GE(p.hue_quadrature, 0);
    EXPECT_LT(p.hue_quadrature, 400);
  }
}

// [CIE159] unique hues: red 20.14, yellow 90, green 164.25, blue 237.53 degrees.
TEST(HueQuadrature, IsAMultipleOf100AtUniqueHuesAndWrapsAtRed) {
  const Adaptation a = adapt(kOffice);
  const auto quadrature = [&](double hue_deg) {
    return ciecam02_forward(ciecam02_inverse({50, 20, hue_deg}, a), a).hue_quadrature;
  };
  EXPECT_NEAR(quadrature(20.14 + 1e-6), 0, 1e-5);
  EXPECT_NEAR(quadrature(20.14 - 1e-6), 400, 1e-5);
  EXPECT_NEAR(quadrature(90), 100, 1e-9);
  EXPECT_NEAR(quadrature(164.25), 200, 1e-9);
  EXPECT_NEAR(quadrature(237.53), 300, 1e-9);
}

// [Neumann2004] section 5 names the yellowish green "95Y 5G" by daylight and "3Y 97G" in the room.
TEST(HueComposition, NamesSharesOfTheNeighbouringUniqueHues) {
  EXPECT_EQ(hue_composition(105), "95Y 5G");
  EXPECT_EQ(hue_composition(197), "3Y 97G");
  EXPECT_EQ(hue_composition(50), "50R 50Y");
  EXPECT_EQ(hue_composition(278.06), "22G 78B");
  EXPECT_EQ(hue_composition(380.2), "20B 80R");
}

TEST(HueComposition, LeavesOutAShareOfNothing) {
  EXPECT_EQ(hue_composition(0), "100R");
  EXPECT_EQ(hue_composition(100.4), "100Y");
  EXPECT_EQ(hue_composition(199.6), "100G");
  EXPECT_EQ(hue_composition(400), "100R");
}

TEST(HueComposition, RefusesWhatIsNoQuadrature) {
  for (const double h : {-1.0, 400.1, kNaN, kInfinity}) {
    EXPECT_THROW((void)hue_composition(h), std::invalid_argument) << h;
  }
}

TEST(Ciecam02, RefusesConditionsWithoutMeaning) {
  const auto refused = [](auto change) {
    ViewingConditions view = kOffice;
    change(view);
    EXPECT_THROW((void)adapt(view), std::domain_error);
  };
  for (const double bad : {0.0, -1.0, kNaN, kInfinity}) {
    refused([&](ViewingConditions& v) { v.adapting_luminance_cd_m2 = bad; });
    refused([&](ViewingConditions& v) { v.background_y = bad; });
    refused([&](ViewingConditions& v) { v.white.y = bad; });
    refused([&](ViewingConditions& v) { v.surround.c = bad; });
    refused([&](ViewingConditions& v) { v.surround.n_c = bad; });
  }
  for (const double bad : {-0.1, 1.1, kNaN}) {
    refused([&](ViewingConditions& v) { v.surround.f = bad; });
  }
  for (const double bad : {kNaN, kInfinity}) {
    refused([&](ViewingConditions& v) { v.white.x = bad; });
    refused([&](ViewingConditions& v) { v.white.z = bad; });
  }
  refused([](ViewingConditions& v) { v.white = {276.9, 100, 0}; });  // a white of 700 nm
  refused([](ViewingConditions& v) { v.adapting_luminance_cd_m2 = 1e308; });
}

TEST(Ciecam02, ErrorsSayWhichConditionAndItsValue) {
  ViewingConditions view = kOffice;
  view.background_y = -3;
  try {
    (void)adapt(view);
    FAIL() << "accepted";
  } catch (const std::domain_error& error) {
    EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("Y_b"), testing::HasSubstr("-3")));
  }
}

TEST(Ciecam02, RefusesSamplesWithoutFiniteCorrelates) {
  const Adaptation a = adapt(kOffice);
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    EXPECT_THROW((void)ciecam02_forward({bad, 1, 1}, a), std::domain_error);
    EXPECT_THROW((void)ciecam02_forward({1, bad, 1}, a), std::domain_error);
    EXPECT_THROW((void)ciecam02_forward({1, 1, bad}, a), std::domain_error);
  }
  EXPECT_GT(ciecam02_forward({1e300, 1e300, 1e300}, a).lightness, 1000);  // saturated, but finite
  const Adaptation glare = adapt({kD65, 100, 1e12, kAverage});
  EXPECT_THROW((void)ciecam02_forward({200, 200, 200}, glare), std::domain_error);
}

TEST(Ciecam02, InverseRefusesWhatNoStimulusLooksLike) {
  const Adaptation a = adapt(kOffice);
  for (const double bad : {kNaN, kInfinity, -1.0}) {
    EXPECT_THROW((void)ciecam02_inverse({bad, 10, 10}, a), std::domain_error);
    EXPECT_THROW((void)ciecam02_inverse({10, bad, 10}, a), std::domain_error);
  }
  EXPECT_THROW((void)ciecam02_inverse({50, 10, kNaN}, a), std::domain_error);
  EXPECT_THROW((void)ciecam02_inverse({0, 10, 10}, a), std::domain_error);
  EXPECT_THROW((void)ciecam02_inverse({50, 500, 264}, a), std::domain_error);  // no such blue
  EXPECT_THROW((void)ciecam02_inverse({1e6, 0, 0}, a), std::domain_error);     // cones saturate
}

}  // namespace
}  // namespace appearance
