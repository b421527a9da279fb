#include "scenes/skies/sky_pattern.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "scenes/skies/sphere_integral.h"
#include "scenes/skies/sun_position.h"

namespace scenes {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

/// Zenith luminance of the pattern.
double at_zenith(const SkyPattern& sky) { return relative_luminance(sky, Vector3d::UnitZ()); }

struct Ratios {
  int type;
  std::vector<double> at;  ///< Ed / Lz at sun altitudes of 15, 30, 45, 60 degrees; one: all alike
};

/// By an independent quadrature.
const std::vector<Ratios> kRatios{{1, {2.4495}},
                                  {2, {2.6615, 2.5566, 2.3635, 2.0860}},
                                  {3, {2.7700}},
                                  {4, {3.0298, 2.8901, 2.6467, 2.3154}},
                                  {5, {3.14159265}},
                                  {6, {3.4558, 3.2778, 2.9775, 2.5842}},
                                  {7, {3.9021, 3.6730, 3.1431, 2.4212}},
                                  {8, {4.4211, 4.1231, 3.3387, 2.3284}},
                                  {9, {4.8652, 4.5528, 4.0587, 3.4593}},
                                  {10, {5.5937, 5.1449, 4.2534, 3.1703}},
                                  {11, {6.4517, 5.8176, 4.4854, 2.9891}},
                                  {12, {7.2048, 6.3941, 4.8485, 3.1906}},
                                  {13, {8.0729, 6.9952, 4.9827, 3.0259}},
                                  {14, {9.1176, 7.7081, 5.3753, 3.2170}},
                                  {15, {10.338, 8.1160, 5.2711, 3.0159}}};

TEST(SkyPattern, GivesTheIlluminanceOfEveryTypeByItsZenith) {
  for (const Ratios& type : kRatios) {
    for (std::size_t k = 0; k < 4; ++k) {
      const double expected = type.at[type.at.size() == 1 ? 0 : k];
      const SkyPattern sky =
          cie_sky(type.type, direction_of(70, 15.0 * static_cast<double>(k + 1)));
      EXPECT_NEAR(horizontal_integral(sky) / at_zenith(sky), expected, 6e-5 * expected)
          << "type " << type.type << ", altitude " << 15 * (k + 1);
    }
  }
  EXPECT_NEAR(horizontal_integral(cie_sky(16, direction_of(0, 40))) / 3, 7 * pi / 9, 1e-9);
  EXPECT_NEAR(horizontal_integral(cie_sky(5, direction_of(0, 40))), pi, 1e-9);
}

/// The same integral in other coordinates, about the zenith, with a mesh so fine that the cusp at
/// the sun does not matter.
TEST(SkyPattern, AgreesWithAQuadratureAboutTheZenith) {
  for (const int type : {3, 8, 12, 15}) {
    const SkyPattern sky = cie_sky(type, direction_of(200, 33));
    double sum = 0;
    constexpr int kRows = 1500, kColumns = 3000;
    for (int i = 0; i < kRows; ++i) {
      const double z = (i + 0.5) / kRows, sine = std::sqrt(1 - z * z);
      for (int j = 0; j < kColumns; ++j) {
        const double psi = 2 * pi * (j + 0.5) / kColumns;
        sum += z * relative_luminance(sky, {sine * std::cos(psi), sine * std::sin(psi), z});
      }
    }
    sum *= 2 * pi / kRows / kColumns;
    EXPECT_NEAR(horizontal_integral(sky) / sum, 1, 1e-6) << type;
  }
}

TEST(SkyPattern, PerezFromIrradiances) {
  const Vector3d to_sun = direction_of(180, 35);
  const Weather weather{
      .direct_normal_W_m2 = 600, .diffuse_horizontal_W_m2 = 120, .day_of_year = 80};
  const SkyState state = sky_state(weather, to_sun);
  EXPECT_NEAR(state.clearness, 3.603066, 1e-6);
  EXPECT_NEAR(state.brightness, 0.151443, 1e-6);
  EXPECT_NEAR(state.air_mass, 1.738815, 1e-6);
  const SkyPattern sky = perez_sky(weather, to_sun);
  EXPECT_NEAR(sky.a, -1.0110048, 1e-7);
  EXPECT_NEAR(sky.b, -0.3163666, 1e-7);
  EXPECT_NEAR(sky.c, 13.0559004, 1e-6);
  EXPECT_NEAR(sky.d, -3.4380143, 1e-7);
  EXPECT_NEAR(sky.e, 0.2935791, 1e-7);
  EXPECT_NEAR(horizontal_integral(sky) / at_zenith(sky), 6.457174, 1e-6);
  Weather damp = weather;
  damp.precipitable_water_cm = precipitable_water_cm(10);
  const DaylightEfficacy efficacy = daylight_efficacy(damp, to_sun);
  EXPECT_NEAR(efficacy.diffuse_lm_W, 147.259, 1e-3);
  EXPECT_NEAR(efficacy.direct_lm_W, 98.316, 1e-3);
}

/// From the first to the last bin of clearness, sun low and high.
TEST(SkyPattern, PerezIsBoundedInWeatherThatHappens) {
  for (const double altitude : {5.0, 20.0, 50.0, 80.0}) {
    for (const double brightness : {0.1, 0.2, 0.4}) {
      for (const double direct : {0.0, 50.0, 200.0, 500.0}) {
        const Vector3d to_sun = direction_of(10, altitude);
        const SkyPattern sky = perez_sky({.direct_normal_W_m2 = direct * to_sun.z(),
                                          .diffuse_horizontal_W_m2 = 1300 * brightness * to_sun.z(),
                                          .day_of_year = 172},
                                         to_sun);
        EXPECT_TRUE(is_bounded(sky)) << altitude << ' ' << brightness << ' ' << direct;
      }
    }
  }
  const SkyPattern never =
      perez_sky({.direct_normal_W_m2 = 950, .diffuse_horizontal_W_m2 = 40, .day_of_year = 172},
                direction_of(10, 5));
  EXPECT_FALSE(is_bounded(never));
}

TEST(SphereIntegral, SolidAnglesOfWedges) {
  const Vector3d axis = Vector3d(0.3, -0.5, 0.8).normalized();
  for (const double angle : {0.1, 1.0, 2.5}) {
    double sum = 0;
    for_directions(axis, {Vector3d::UnitZ(), {0, std::sin(angle), -std::cos(angle)}},
                   [&](const Vector3d&, double solid_angle) { sum += solid_angle; });
    EXPECT_NEAR(sum, 2 * angle, 1e-9) << angle;
  }
}

TEST(SunPosition, PublishedAndTwoAlgorithms) {
  struct Case {
    double latitude_deg, longitude_deg;
    const char* time;
    double azimuth_deg, altitude_deg;
  };

  for (const Case& c : {Case{39.742476, -105.1786, "2003-10-17T12:30:30-07:00", 194.3402, 39.8721},
                        Case{52.52, 13.405, "2024-06-01T08:00Z", 112.8211, 43.6341},
                        Case{35.6762, 139.6503, "2025-12-21T12:00:00+0900", 185.4965, 30.6837},
                        Case{-0.1807, -78.4678, "2026-09-10T20:15:00.0Z", 276.6696, 43.7270}}) {
    const auto moment = read_moment(c.time);
    ASSERT_TRUE(moment) << c.time;
    const SunPosition sun = sun_position(c.latitude_deg, c.longitude_deg, *moment);
    EXPECT_NEAR(sun.azimuth_deg, c.azimuth_deg, 0.01) << c.time;
    EXPECT_NEAR(sun.altitude_deg, c.altitude_deg, 0.01) << c.time;
  }
}

TEST(SunPosition, TimesAreReadWholeOrNotAtAll) {
  for (const char* bad :
       {"", "2024-06-01", "2024-06-01T08:00", "2024-06-01 08:00Z", "2024-02-30T08:00Z",
        "2024-06-01T25:00Z", "2024-06-01T24:01Z", "2024-06-01T08:60Z", "2024-06-01T08:00:61Z",
        "2024-06-01T08:00+15:00", "2024-06-01T08:00Z ", "2024-6-1T08:00Z", "2024-06-01T8:00Z",
        "2024-06-01T08:00:00.5", "-024-06-01T08:00Z"}) {
    EXPECT_FALSE(read_moment(bad)) << bad;
  }
  const auto moment = read_moment("2000-01-01T12:00Z");
  ASSERT_TRUE(moment);
  EXPECT_EQ(moment->julian_day, 2451545);
  EXPECT_EQ(moment->day_of_year, 1);
  EXPECT_EQ(read_moment("2023-12-31T23:30-05:00")->day_of_year, 365);
}

}  // namespace
}  // namespace scenes
