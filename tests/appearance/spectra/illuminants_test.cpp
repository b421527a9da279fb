#include "appearance/spectra/illuminants.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "appearance/spectra/spectrum_library.h"
#include "appearance/spectra/tristimulus.h"

namespace spectra {
namespace {

Chromaticity colour(const Grid& grid, const Samples& light) {
  return chromaticity(absolute_xyz(light_on(grid, light)));
}

struct Published {
  const char* name;
  double x, y;
};

class PublishedIlluminant : public testing::TestWithParam<Published> {};

// [CIE15] table T.3, 2 degree observer. Summed at 5 nm as there; 4e-5 because the table is rounded
// to 1e-5 and sums over a wider range than 380..780 nm.
TEST_P(PublishedIlluminant, HasItsChromaticity) {
  const Grid five_nm{.first_nm = 380, .step_nm = 5, .count = 81};
  Samples at_five_nm{.nm = {}, .values = {}};
  const Spectrum fine = light_on(kClosedFormGrid, illuminant(GetParam().name));
  for (int k = 0; k < five_nm.count; ++k) {
    at_five_nm.nm.push_back(five_nm.wavelength_nm(k));
    at_five_nm.values.push_back(fine.values[20 + 5 * k]);
  }
  const Chromaticity c = colour(five_nm, at_five_nm);
  EXPECT_NEAR(c.x, GetParam().x, 4e-5);
  EXPECT_NEAR(c.y, GetParam().y, 4e-5);
}

INSTANTIATE_TEST_SUITE_P(
    Cie15, PublishedIlluminant,
    testing::Values(Published{"A", 0.44757, 0.40745}, Published{"C", 0.31006, 0.31616},
                    Published{"D50", 0.34567, 0.35850}, Published{"D55", 0.33242, 0.34743},
                    Published{"D65", 0.31272, 0.32903}, Published{"D75", 0.29902, 0.31485}),
    [](const auto& row) { return row.param.name; });

// A is Planckian: 2848 K with the second radiation constant of 1931, 2855.5 K with today's.
TEST(Planck, WithTheConstantOf1931IsIlluminantA) {
  const Samples a = illuminant("A"), p = planck(2848 * (14387669 / 1.435e7));
  const double scale = a.values[200] / p.values[205];  // A begins at 360 nm, planck at 355 nm
  for (std::size_t k = 0; k < a.nm.size(); ++k) {
    EXPECT_NEAR(scale * p.values[k + 5] / a.values[k], 1, 1e-12) << a.nm[k];
  }
}

// The nominal 2856 K are 0.46 K more, which moves x by 4.0e-5 and y by 1.2e-5.
TEST(Planck, At2856KelvinIsNearlyIlluminantA) {
  const Chromaticity a = colour(kClosedFormGrid, illuminant("A"));
  const Chromaticity p = colour(kClosedFormGrid, planck(2856));
  EXPECT_NEAR(p.x, a.x, 5e-5);
  EXPECT_NEAR(p.y, a.y, 2e-5);
}

// Wien: the peak of the wavelength density is at 2.897772e6 nm K / T.
TEST(Planck, PeaksWhereWienSays) {
  const double temperature_K = 2.897772e6 / 600;
  const Samples p = planck(temperature_K);
  const auto peak = std::max_element(p.values.begin(), p.values.end()) - p.values.begin();
  EXPECT_EQ(p.nm[static_cast<std::size_t>(peak)], 600);
}

TEST(Planck, StaysFiniteFromEndToEnd) {
  for (const double temperature_K : {100.0, 1e6}) {
    for (const double value : planck(temperature_K).values) {
      EXPECT_TRUE(std::isfinite(value) && value > 0) << temperature_K;
    }
  }
}

// The daylight locus itself [CIE15]: light rebuilt from the components has the
// chromaticity it was built for. The rounded weights cost up to 1e-4, the cut at 380 and 780 nm
// another 2e-4.
TEST(Daylight, LiesOnTheDaylightLocus) {
  for (const double cct_K : {4000.0, 5000.0, 7000.0, 7001.0, 12000.0, 25000.0}) {
    const Chromaticity c = colour(kClosedFormGrid, daylight(cct_K));
    EXPECT_NEAR(c.y, -3.000 * c.x * c.x + 2.870 * c.x - 0.275, 3e-4) << cct_K;
  }
}

// [CIE15] table T.1 prints D65 to six digits; components and rounded weights give it to 1e-3.
TEST(Daylight, D65IsThePublishedTable) {
  const Samples d65 = illuminant("D65");
  EXPECT_NEAR(d65.values[4], 82.7549, 1e-3);   // 400 nm
  EXPECT_NEAR(d65.values[36], 100, 1e-12);     // 560 nm
  EXPECT_NEAR(d65.values[64], 71.6091, 1e-3);  // 700 nm
}

TEST(Illuminants, UnknownNamesAndTemperaturesAreRefused) {
  EXPECT_THROW((void)illuminant("D64"), std::invalid_argument);
  EXPECT_THROW((void)illuminant(""), std::invalid_argument);
  EXPECT_THROW((void)planck(99), std::invalid_argument);
  EXPECT_THROW((void)planck(std::nan("")), std::invalid_argument);
  EXPECT_THROW((void)daylight(3999), std::invalid_argument);
  EXPECT_THROW((void)daylight(25001), std::invalid_argument);
  EXPECT_THROW((void)daylight(std::nan("")), std::invalid_argument);
}

TEST(LampPresets, AreTheSeventeenRowsOfTheTable) {  // [Neumann2004] table 4
  ASSERT_EQ(lamp_presets().size(), 17U);
  for (const LampPreset& preset : lamp_presets()) {
    EXPECT_NO_THROW((void)planck(preset.temperature_K)) << preset.name;
  }
}

struct BandError {
  double x = 0, y = 0, z = 0;  ///< largest of |31 bands / 1 nm - 1|
};

void include(BandError& worst, const Samples& light) {
  const Xyz bands = absolute_xyz(light_on(kTransportGrid, light));
  const Xyz fine = absolute_xyz(light_on(kClosedFormGrid, light));
  worst.x = std::max(worst.x, std::abs(bands.x / fine.x - 1));
  worst.y = std::max(worst.y, std::abs(bands.y / fine.y - 1));
  worst.z = std::max(worst.z, std::abs(bands.z / fine.z - 1));
}

// Cutting the spectrum at 400 and 700 nm costs smooth lights this much; the README gives the
// figures.
TEST(ThirtyOneBands, GiveTheColourOfSmoothLights) {
  BandError worst;
  for (const std::string& name : illuminant_names()) include(worst, illuminant(name));
  EXPECT_LT(worst.x, 0.0023);
  EXPECT_LT(worst.y, 0.0008);
  EXPECT_LT(worst.z, 0.0037);
}

// Lamps with lines: band means keep the energy, but not where in the band it lies.
TEST(ThirtyOneBands, GiveTheColourOfMeasuredLamps) {
  BandError worst;
  for (const NamedSpectrum& lamp : lamps("houser").entries) include(worst, lamp.samples);
  EXPECT_LT(worst.x, 0.0046);
  EXPECT_LT(worst.y, 0.0036);
  EXPECT_LT(worst.z, 0.0183);
}

}  // namespace
}  // namespace spectra
