#include "scenes/skies/sky_pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/skies/sphere_integral.h"

namespace scenes {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

struct Parameters {
  double a, b, c, d, e;
};

/// [CIES011], ISO 15469:2004, types 1 to 15.
constexpr std::array<Parameters, 15> kCie{{{4, -0.7, 0, -1, 0},
                                           {4, -0.7, 2, -1.5, 0.15},
                                           {1.1, -0.8, 0, -1, 0},
                                           {1.1, -0.8, 2, -1.5, 0.15},
                                           {0, -1, 0, -1, 0},
                                           {0, -1, 2, -1.5, 0.15},
                                           {0, -1, 5, -2.5, 0.3},
                                           {0, -1, 10, -3, 0.45},
                                           {-1, -0.55, 2, -1.5, 0.15},
                                           {-1, -0.55, 5, -2.5, 0.3},
                                           {-1, -0.55, 10, -3, 0.45},
                                           {-1, -0.32, 10, -3, 0.45},
                                           {-1, -0.32, 16, -3, 0.3},
                                           {-1, -0.15, 16, -3, 0.3},
                                           {-1, -0.15, 24, -2.8, 0.15}}};

/// [Perez1993] Table 1: a row per bin of clearness; x1 to x4 of a, b, c, d, e.
constexpr double kPerez[8][20] = {
    {1.3525, -.2576, -.2690, -1.4366, -.7670, .0007, 1.2734, -.1233, 2.8,    .6004,
     1.2375, 1,      1.8734, .6297,   .9738,  .2809, .0356,  -.1246, -.5718, .9938},
    {-1.2219, -.7730, 1.4148,  1.1016, -.2054,  .0367, -3.9128, .9156, 6.975,  .1774,
     6.4477,  -.1239, -1.5798, -.5081, -1.7812, .1080, .2624,   .0672, -.2190, -.4285},
    {-1.1,  -.2515,  .8952, .0156,  .2782,  -.1812,  -4.5,   1.1766, 24.7219, -13.0812,
     -37.7, 34.8438, -5,    1.5218, 3.9229, -2.6204, -.0156, .1597,  .4199,   -.5562},
    {-.5484, -.6654,  -.2672, .7117, .7234,  -.6219, -5.6812, 2.6297, 33.3389, -18.3,
     -62.25, 52.0781, -3.5,   .0016, 1.1477, .1062,  .4659,   -.3296, -.0876,  -.0329},
    {-.6,      -.3566, -2.5, 2.325,  .2937,  .0496, -5.6812, 1.8415, 21,     -4.7656,
     -21.5906, 7.2492, -3.5, -.1554, 1.4062, .3988, .0032,   .0766,  -.0656, -.1294},
    {-1.0156, -.3670, 1.0078, 1.4051, .2875,  -.5328, -3.85,  3.375, 14,    -.9999,
     -7.1406, 7.5469, -3.4,   -.1078, -1.075, 1.5702, -.0672, .4016, .3017, -.4844},
    {-1,     .0211,   .5025, -.5119, -.3,   .1922, .7023,  -1.6317, 19,      -5,
     1.2438, -1.9094, -4,    .025,   .3844, .2656, 1.0468, -.3788,  -2.4517, 1.4656},
    {-1.05,    .0289,  .4260,   .3590, -.3250, .1156, .7781, .0025,  31.0625, -14.5,
     -46.1148, 55.375, -7.2312, .4050, 13.35,  .6234, 1.5,   -.6426, 1.8564,  .5636}};

/// [Perez1990] Table 4: per bin a, b, c, d of skylight, then of the beam.
constexpr double kEfficacy[8][8] = {{97.24, -.46, 12, -8.91, 57.2, -4.55, -2.98, 117.12},
                                    {107.22, 1.15, .59, -3.95, 98.99, -3.46, -1.21, 12.38},
                                    {104.97, 2.96, -5.53, -8.77, 109.83, -4.9, -1.71, -8.81},
                                    {102.39, 5.59, -13.95, -13.9, 110.34, -5.84, -1.99, -4.56},
                                    {100.71, 5.94, -22.75, -23.74, 106.36, -3.97, -1.75, -6.16},
                                    {106.42, 3.83, -36.15, -28.83, 107.19, -1.25, -1.51, -26.73},
                                    {141.88, 1.90, -53.24, -14.03, 105.75, .77, -1.26, -34.44},
                                    {152.23, .35, -45.27, -7.98, 101.18, 1.58, -1.1, -8.29}};

std::size_t clearness_bin(double clearness) {
  constexpr std::array<double, 7> kEnds{1.065, 1.23, 1.5, 1.95, 2.8, 4.5, 6.2};
  return static_cast<std::size_t>(std::ranges::upper_bound(kEnds, clearness) - kEnds.begin());
}

double zenith_angle(const Vector3d& to_sun) { return std::acos(std::clamp(to_sun.z(), -1.0, 1.0)); }

}  // namespace

SkyPattern cie_sky(int type, const Vector3d& to_sun) {
  if (type == kCieSkies) return {.traditional = true, .to_sun = to_sun};
  const Parameters& p = kCie.at(static_cast<std::size_t>(type - 1));
  return {.a = p.a,
          .b = p.b,
          .c = p.c,
          .d = p.d,
          .e = p.e,
          .shift = std::exp(p.d * pi / 2),
          .to_sun = to_sun};
}

double precipitable_water_cm(double dew_point_C) { return std::exp(0.07 * dew_point_C - 0.075); }

SkyState sky_state(const Weather& w, const Vector3d& to_sun) {
  const double zenith = zenith_angle(to_sun), cube = 1.041 * zenith * zenith * zenith;
  const double t = 2 * pi * (w.day_of_year - 1) / 365;
  const double outside_W_m2 = 1367 * (1.00011 + 0.034221 * std::cos(t) + 0.00128 * std::sin(t) +
                                      0.000719 * std::cos(2 * t) + 0.000077 * std::sin(2 * t));
  const double air_mass =
      1 / (std::cos(zenith) + 0.15 * std::pow(93.885 - zenith * 180 / pi, -1.253));
  const double clearness =
      ((w.diffuse_horizontal_W_m2 + w.direct_normal_W_m2) / w.diffuse_horizontal_W_m2 + cube) /
      (1 + cube);
  return {.clearness = std::clamp(clearness, 1.0, 12.0),
          .brightness = std::clamp(air_mass * w.diffuse_horizontal_W_m2 / outside_W_m2, 0.01, 0.6),
          .air_mass = air_mass};
}

SkyPattern perez_sky(const Weather& weather, const Vector3d& to_sun) {
  const SkyState state = sky_state(weather, to_sun);
  const double zenith = zenith_angle(to_sun);
  const bool middling = state.clearness > 1.065 && state.clearness < 2.8;
  const double delta = middling ? std::max(0.2, state.brightness) : state.brightness;
  const std::size_t bin = clearness_bin(state.clearness);
  const auto* x = kPerez[bin];
  const auto linear = [&](int k) {
    return x[k] + x[k + 1] * zenith + delta * (x[k + 2] + x[k + 3] * zenith);
  };
  SkyPattern sky{.a = linear(0),
                 .b = linear(4),
                 .c = linear(8),
                 .d = linear(12),
                 .e = linear(16),
                 .to_sun = to_sun};
  if (bin == 0) {
    sky.c = std::exp(std::pow(delta * (x[8] + x[9] * zenith), x[10])) - x[11];
    sky.d = -std::exp(delta * (x[12] + x[13] * zenith)) + x[14] + delta * x[15];
  }
  return sky;
}

DaylightEfficacy daylight_efficacy(const Weather& weather, const Vector3d& to_sun) {
  const SkyState state = sky_state(weather, to_sun);
  const auto* x = kEfficacy[clearness_bin(state.clearness)];
  const double water = weather.precipitable_water_cm, zenith = zenith_angle(to_sun);
  return {.diffuse_lm_W =
              x[0] + x[1] * water + x[2] * std::cos(zenith) + x[3] * std::log(state.brightness),
          .direct_lm_W = std::max(0.0, x[4] + x[5] * water + x[6] * std::exp(5.73 * zenith - 5) +
                                           x[7] * state.brightness)};
}

double relative_luminance(const SkyPattern& sky, const Vector3d& direction) {
  const double cos_zenith = direction.z();
  if (sky.traditional) return 1 + 2 * cos_zenith;
  const double cos_chi = std::clamp(direction.dot(sky.to_sun), -1.0, 1.0);
  const double gradation =
      sky.a == 0 ? 1 : 1 + sky.a * std::exp(sky.b / std::max(cos_zenith, 1e-9));
  if (sky.c == 0 && sky.e == 0) return std::max(0.0, gradation);
  const double indicatrix =
      1 + sky.c * (std::exp(sky.d * std::acos(cos_chi)) - sky.shift) + sky.e * cos_chi * cos_chi;
  return std::max(0.0, gradation * indicatrix);
}

bool is_bounded(const SkyPattern& sky) {
  return sky.traditional || ((sky.a == 0 || sky.b <= 0) && horizontal_integral(sky) > 0);
}

double horizontal_integral(const SkyPattern& sky) {
  double sum = 0;
  for_directions(sky.to_sun, {Vector3d::UnitZ()}, [&](const Vector3d& direction, double angle) {
    sum += relative_luminance(sky, direction) * direction.z() * angle;
  });
  return sum;
}

}  // namespace scenes
