#include "appearance/spectra/spectrum.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace spectra {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

double band_width_nm(int k) { return k == 0 || k == kTransportGrid.count - 1 ? 5 : 10; }

/// Integral over 400..700 nm of what the bands hold.
double energy(const Spectrum& bands) {
  double sum = 0;
  for (int k = 0; k < bands.grid.count; ++k) sum += bands.values[k] * band_width_nm(k);
  return sum;
}

Samples line(double centre_nm, double half_width_nm) {
  return {.nm = {380, centre_nm - half_width_nm, centre_nm, centre_nm + half_width_nm, 780},
          .values = {0, 0, 1, 0, 0}};
}

class LampLine : public testing::TestWithParam<double> {};

// A triangle of height 1 has the area of its half width, wherever the bands cut it.
TEST_P(LampLine, KeepsItsEnergyInTheBands) {
  for (const double half_width_nm : {0.5, 2.0, 30.0}) {
    const Spectrum bands = light_on(kTransportGrid, line(GetParam(), half_width_nm));
    EXPECT_NEAR(energy(bands), half_width_nm, 1e-13 * half_width_nm);
  }
}

INSTANTIATE_TEST_SUITE_P(Positions, LampLine, testing::Values(435.8, 444.9, 445.0, 545.5, 546.1),
                         [](const auto& position) {
                           return "at_" + std::to_string(static_cast<int>(position.param * 10));
                         });

TEST(LightOn, LineFallsIntoItsOwnBandAlone) {
  const Spectrum bands = light_on(kTransportGrid, line(546.1, 1));
  for (int k = 0; k < 31; ++k) {
    EXPECT_DOUBLE_EQ(bands.values[k], k == 15 ? 0.1 : 0.0) << kTransportGrid.wavelength_nm(k);
  }
}

// The mean of a straight line over a band is its value in the middle of the band.
TEST(LightOn, StraightLineGivesMidpointsAndOneSidedEnds) {
  const Samples ramp{.nm = {390, 531, 710}, .values = {390, 531, 710}};
  const Spectrum bands = light_on(kTransportGrid, ramp);
  EXPECT_NEAR(bands.values[0], 402.5, 1e-12);
  EXPECT_NEAR(bands.values[30], 697.5, 1e-12);
  for (int k = 1; k < 30; ++k) EXPECT_NEAR(bands.values[k], 400 + 10 * k, 1e-12);
}

TEST(LightOn, DataAtTheBandCentresAreTheBandValues) {
  Samples at_centres;
  for (int k = 0; k < 31; ++k) {
    at_centres.nm.push_back(kTransportGrid.wavelength_nm(k));
    at_centres.values.push_back(k % 2);
  }
  const Spectrum bands = light_on(kTransportGrid, at_centres);
  for (int k = 0; k < 31; ++k) EXPECT_EQ(bands.values[k], k % 2);

  at_centres.nm.push_back(710);  // one sample more, and the same data are a curve to average
  at_centres.values.push_back(1);
  EXPECT_NEAR(light_on(kTransportGrid, at_centres).values[1], 0.75, 1e-15);
}

TEST(LightOn, IsDarkBeyondItsSamplesOnTheOneNanometreGridOnly) {
  const Samples lamp{.nm = {380, 780}, .values = {2, 2}};
  const Spectrum fine = light_on(kClosedFormGrid, lamp);
  EXPECT_EQ(fine.values[379 - 360], 0);
  EXPECT_EQ(fine.values[380 - 360], 2);
  EXPECT_EQ(fine.values[780 - 360], 2);
  EXPECT_EQ(fine.values[781 - 360], 0);

  const Samples shorter{.nm = {415, 780}, .values = {2, 2}};
  EXPECT_THAT([&] { (void)light_on(kTransportGrid, shorter); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("lacks 400..415 nm")));
}

TEST(ReflectanceOn, IsLinearBetweenSamplesAndKeepsItsEndsOnTheOneNanometreGridOnly) {
  const Samples paper{.nm = {400, 500, 700}, .values = {0.2, 0.4, 0.8}};
  const Spectrum bands = reflectance_on(kTransportGrid, paper);
  EXPECT_NEAR(bands.values[5], 0.3, 1e-15);
  EXPECT_NEAR(bands.values[20], 0.6, 1e-15);
  const Spectrum fine = reflectance_on(kClosedFormGrid, paper);
  EXPECT_EQ(fine.values[0], 0.2);
  EXPECT_EQ(fine.values[470], 0.8);

  const Samples shorter{.nm = {400, 690}, .values = {0.2, 0.4}};
  EXPECT_THAT([&] { (void)reflectance_on(kTransportGrid, shorter); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("lacks 690..700 nm")));
}

TEST(MissingRange, NamesBothEnds) {
  EXPECT_EQ(missing_range({{380, 780}, {1, 1}}, kTransportGrid), "");
  EXPECT_EQ(missing_range({{400, 700}, {1, 1}}, kTransportGrid), "");
  EXPECT_EQ(missing_range({{400, 700}, {1, 1}}, kClosedFormGrid), "360..400 and 700..830 nm");
  EXPECT_EQ(missing_range({{800, 900}, {1, 1}}, kTransportGrid), "400..700 nm");
}

TEST(Samples, BrokenCurvesAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Samples& broken : {Samples{}, Samples{{400, 700}, {1}}, Samples{{400, 400}, {1, 1}},
                                Samples{{700, 400}, {1, 1}}, Samples{{400, 700}, {1, nan}},
                                Samples{{400, nan}, {1, 1}}, Samples{{400, 700}, {infinity, 1}}}) {
    EXPECT_THROW((void)light_on(kTransportGrid, broken), std::invalid_argument);
    EXPECT_THROW((void)reflectance_on(kClosedFormGrid, broken), std::invalid_argument);
  }
}

}  // namespace
}  // namespace spectra
