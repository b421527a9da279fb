#include "scenes/skies/weather_sky.h"

#include <cmath>

#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/photometry.h"

namespace scenes {

Daylight daylight_by_weather(const Weather& weather, double azimuth_deg, double altitude_deg) {
  Daylight light;
  if (altitude_deg <= 0) return light;
  if (!(weather.diffuse_horizontal_W_m2 > 0)) {
    light.defined = !(weather.direct_normal_W_m2 > 0);  // a sun without any sky
    return light;
  }
  const Eigen::Vector3d to_sun = direction_of(azimuth_deg, altitude_deg);
  const DaylightEfficacy efficacy = daylight_efficacy(weather, to_sun);
  constexpr double kOvercastBelow = 1.23;
  light.pattern = perez_sky(weather, to_sun);
  light.overcast = sky_state(weather, to_sun).clearness < kOvercastBelow;
  light.horizontal_lx = efficacy.diffuse_lm_W * weather.diffuse_horizontal_W_m2;
  light.beam_lx = efficacy.direct_lm_W * weather.direct_normal_W_m2;
  light.defined = is_bounded(light.pattern) && light.horizontal_lx > 0;
  return light;
}

spectra::Spectrum usual_spectrum(const spectra::Grid& grid, bool overcast) {
  constexpr double kOvercast_K = 6500, kClear_K = 10000;
  return spectra::light_on(grid, spectra::daylight(overcast ? kOvercast_K : kClear_K));
}

SkyOfHour sky_of_hour(const spectra::Grid& grid, const WeatherSky& over, std::size_t hour) {
  const WeatherHour& at = over.file->hours.at(hour);
  const SunPosition sun =
      sun_position(over.file->latitude_deg, over.file->longitude_deg, at.moment);
  SkyOfHour result{.azimuth_deg = std::fmod(sun.azimuth_deg + over.north_deg + 360, 360),
                   .altitude_deg = sun.altitude_deg,
                   .beam = spectra::constant(grid, 0)};
  const Daylight light = daylight_by_weather(at.weather, result.azimuth_deg, sun.altitude_deg);
  result.defined = light.defined;
  if (!light.defined || !(light.horizontal_lx > 0)) return result;
  if (light.beam_lx > 0) {
    result.beam = spectra::scaled_to_luminous(over.sun_spectrum, light.beam_lx);
  }
  SkyColour colour{.spectrum = over.spectrum, .overcast = light.overcast};
  if (!over.spectrum && !over.by_direction) colour.spectrum = usual_spectrum(grid, light.overcast);
  result.sky = make_sky(grid, light.pattern, colour,
                        {.horizontal_lx = light.horizontal_lx,
                         .beam = result.beam.values,
                         .ground_reflectance = over.ground_reflectance});
  result.sky->obstruction = over.obstruction;
  return result;
}

}  // namespace scenes
