// Colour of lamps: temperature, alpha-opic light, and the choice by what is on the box.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "appearance/spectra/alpha_opic.h"
#include "appearance/spectra/correlated_temperature.h"
#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/lamp_choice.h"
#include "appearance/spectra/photometry.h"
#include "appearance/spectra/spectrum_library.h"

namespace spectra {
namespace {

constexpr Grid kFine{.first_nm = 380, .step_nm = 5, .count = 81};

std::optional<CorrelatedTemperature> temperature_of(const Samples& samples, const Grid& grid) {
  return correlated_temperature(chromaticity(absolute_xyz(light_on(grid, samples))));
}

TEST(CorrelatedTemperature, PlanckIsOnTheLocus) {
  for (const double kelvin : {1200.0, 2700.0, 4000.0, 6500.0, 20000.0}) {
    const auto found = temperature_of(planck(kelvin), kClosedFormGrid);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->cct_K / kelvin, 1, 1e-5) << kelvin;
    EXPECT_NEAR(found->duv, 0, 1e-6);
  }
}

TEST(CorrelatedTemperature, IlluminantsOfTheCie) {
  EXPECT_NEAR(temperature_of(illuminant("D65"), kClosedFormGrid)->cct_K, 6503, 3);
  EXPECT_NEAR(temperature_of(illuminant("D65"), kClosedFormGrid)->duv, 0.0032, 1e-4);
  EXPECT_NEAR(temperature_of(illuminant("A"), kClosedFormGrid)->cct_K, 2856, 1);
}

/// By an independent program from the same lamps at 5 nm: they were given to 0.1 K and 1e-5.
TEST(CorrelatedTemperature, AllMeasuredLamps) {
  const auto& measured = lamps("houser").entries;
  ASSERT_EQ(lamp_facts().size(), measured.size());
  double worst = 0, worst_duv = 0;
  for (std::size_t k = 0; k < measured.size(); ++k) {
    const LampFacts& facts = lamp_facts()[k];
    const auto found = temperature_of(measured[k].samples, kFine);
    ASSERT_TRUE(found) << facts.label;
    worst = std::max(worst, std::abs(found->cct_K / facts.cct_K - 1));
    worst_duv = std::max(worst_duv, std::abs(found->duv - facts.duv));
  }
  EXPECT_LT(worst, 1e-4);
  EXPECT_LT(worst_duv, 2e-5);
}

TEST(CorrelatedTemperature, ColoursThatHaveNone) {
  EXPECT_FALSE(correlated_temperature({.x = 0.2, .y = 0.7}));
  EXPECT_FALSE(correlated_temperature({.x = 0.7, .y = 0.29}));
  EXPECT_FALSE(correlated_temperature({}));
  EXPECT_FALSE(correlated_temperature({.x = 0.2, .y = 0.2}));
}

/// Equivalent daylight of daylight is its illuminance.
TEST(AlphaOpic, DaylightIsItsOwnEquivalent) {
  const Spectrum light = scaled_to_luminous(light_on(kFine, illuminant("D65")), 1000);
  for (const double lx : equivalent_daylight_lx(light)) EXPECT_NEAR(lx, 1000, 2);
}

TEST(AlphaOpic, IlluminantA) {
  const Spectrum light = scaled_to_luminous(light_on(kTransportGrid, illuminant("A")), 1);
  EXPECT_NEAR(equivalent_daylight_lx(light)[static_cast<std::size_t>(Receptor::melanopic)], 0.496,
              1e-3);
}

TEST(AlphaOpic, SensitivitiesPeakAtOne) {
  for (int r = 0; r < kReceptors; ++r) {
    double peak = 0;
    for (double nm = 380; nm <= 780; nm += 0.5) {
      peak = std::max(peak, sensitivity(static_cast<Receptor>(r), nm));
    }
    // Between samples of 5 nm.
    EXPECT_NEAR(peak, 1, 0.01) << to_string(static_cast<Receptor>(r));
  }
  EXPECT_EQ(sensitivity(Receptor::melanopic, 490), 1);
  EXPECT_EQ(sensitivity(Receptor::s_cone, 389), 0);
}

TEST(LampChoice, TakesWhatIsOnTheBox) {
  struct Case {
    LampBox box;
    std::vector<std::string> good;
  };

  for (const Case& c : {Case{{"LED", 2700, 90, {}}, {"143"}}, Case{{"LED", 3000, 90, {}}, {"122"}},
                        Case{{"fluorescent", 3000, 83, {}}, {"43", "46"}},
                        Case{{"fluorescent", 4000, 83, {}}, {"42", "288"}},
                        Case{{"incandescent", 2800, 100, {}}, {"11"}}}) {
    const LampMatch best = lamps_like(c.box).front();
    EXPECT_TRUE(stands_for(*best.lamp, c.box)) << best.lamp->label;
    EXPECT_EQ(best.lamp->kind, c.box.kind);
    EXPECT_THAT(c.good, testing::Contains(best.lamp->name))
        << c.box.kind << ' ' << c.box.cct_K << ": " << in_words(*best.lamp);
  }
  // No LED of 4000 K and Ra 90 was measured.
  const LampBox none{"LED", 4000, 90, {}};
  EXPECT_FALSE(stands_for(*lamps_like(none).front().lamp, none));
}

}  // namespace
}  // namespace spectra
