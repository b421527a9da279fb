#pragma once
#include <memory>
#include <optional>

#include "scenes/skies/epw_reader.h"
#include "scenes/skies/sky.h"

namespace scenes {

/// Daylight by measured irradiances [Perez1993] [Perez1990].
struct Daylight {
  SkyPattern pattern;
  double horizontal_lx = 0;  ///< skylight on an open plain; 0: night
  double beam_lx = 0;        ///< of the sun, normal to it
  bool overcast = false;
  bool defined = true;  ///< false: the model has no sky for this weather
};

/// @param azimuth_deg, altitude_deg  of the sun, clockwise from +y, and above the horizon
[[nodiscard]] Daylight daylight_by_weather(const Weather& weather, double azimuth_deg,
                                           double altitude_deg);

/// CIE daylight for a sky whose spectrum is not told.
[[nodiscard]] spectra::Spectrum usual_spectrum(const spectra::Grid& grid, bool overcast);

/// The sky over a room, hour by hour of a weather file.
struct WeatherSky {
  int sky = 0;   ///< into Room::skies
  int sun = -1;  ///< into Room::suns; -1: the sun itself is left out
  std::shared_ptr<const WeatherFile> file;
  double north_deg = 0;  ///< clockwise from +y
  std::optional<spectra::Spectrum> spectrum;
  bool by_direction = false;  ///< neither this nor a spectrum: usual_spectrum
  spectra::Spectrum sun_spectrum;
  double ground_reflectance = 0.2;
  std::optional<Obstruction> obstruction;
};

struct SkyOfHour {
  double azimuth_deg = 0, altitude_deg = 0;  ///< of the sun; clockwise from +y
  bool defined = true;                       ///< false: the model has no sky for this weather
  std::optional<Sky> sky;                    ///< none: there is no light
  spectra::Spectrum beam;                    ///< of the sun, normal to it, W m^-2 nm^-1
};

/// @param hour  into WeatherFile::hours
[[nodiscard]] SkyOfHour sky_of_hour(const spectra::Grid& grid, const WeatherSky& over,
                                    std::size_t hour);

}  // namespace scenes
