#pragma once
#include <Eigen/Core>
#include <array>

namespace scenes {

/// Luminance of the sky by direction, in a measure of its own:
///   L = (1 + a exp(b / cos Z)) (1 + c (exp(d chi) - shift) + e cos^2 chi),
/// Z the angle from the zenith, chi from the sun. [CIES011] has shift exp(d pi / 2), [Perez1993] 0.
/// The traditional overcast sky is 1 + 2 cos Z.
struct SkyPattern {
  double a = 0, b = -1, c = 0, d = -1, e = 0;
  double shift = 0;
  bool traditional = false;
  Eigen::Vector3d to_sun = Eigen::Vector3d::UnitZ();
};

inline constexpr int kCieSkies = 16;

/// Types 1 to 15 of [CIES011] and 16, the traditional overcast sky.
[[nodiscard]] SkyPattern cie_sky(int type, const Eigen::Vector3d& to_sun);

/// What a weather station reports, and what follows from it.
struct Weather {
  double direct_normal_W_m2 = 0, diffuse_horizontal_W_m2 = 0;
  int day_of_year = 1;
  double precipitable_water_cm = 2;
};

/// exp(0.07 T - 0.075) [Perez1990].
[[nodiscard]] double precipitable_water_cm(double dew_point_C);

/// [Perez1993] clearness and brightness of the sky, within the limits of the model.
struct SkyState {
  double clearness = 1, brightness = 0, air_mass = 1;
};

/// @param to_sun  above the horizon
[[nodiscard]] SkyState sky_state(const Weather& weather, const Eigen::Vector3d& to_sun);
[[nodiscard]] SkyPattern perez_sky(const Weather& weather, const Eigen::Vector3d& to_sun);

/// Luminous efficacy of skylight and of the sun's beam, lm/W [Perez1990].
struct DaylightEfficacy {
  double diffuse_lm_W = 0, direct_lm_W = 0;
};

[[nodiscard]] DaylightEfficacy daylight_efficacy(const Weather& weather,
                                                 const Eigen::Vector3d& to_sun);

/// False where [Perez1993] was fitted to no such weather: its sky would grow without bounds towards
/// the horizon, or give no light.
[[nodiscard]] bool is_bounded(const SkyPattern& sky);

/// L in a direction (unit) above the horizon; nowhere below 0.
[[nodiscard]] double relative_luminance(const SkyPattern& sky, const Eigen::Vector3d& direction);

/// Integral of L cos Z over the sky: illuminance of an open plain, to 1e-9.
[[nodiscard]] double horizontal_integral(const SkyPattern& sky);

}  // namespace scenes
