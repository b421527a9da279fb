#pragma once
#include <string>
#include <vector>

#include "scenes/skies/sky_pattern.h"
#include "scenes/skies/sun_position.h"

namespace scenes {

/// A line of a weather file: means over the time until its hour ends; the sun stands as it does in
/// the middle.
struct WeatherHour {
  int month = 1, day = 1, hour = 1;  ///< local standard time; hour 1 is from 0:00 to 1:00
  Moment moment;
  Weather weather;
};

struct WeatherFile {
  std::string path, place;
  double latitude_deg = 0, longitude_deg = 0, zone_h = 0;
  std::vector<WeatherHour> hours;
};

/// EnergyPlus weather, .epw: eight lines of header that begin with LOCATION, then a line an hour.
/// Read are place, zone, time, dew point and the two irradiances; a missing dew point (99.9) stands
/// for 2 cm of water in the air.
/// @throws spectra::FileError   if it cannot be read
/// @throws spectra::InputError  with every fault (the first 100): no such file, numbers that are
/// none, dates that are none, irradiances missing (9999) or outside 0 to 2000 W/m^2
[[nodiscard]] WeatherFile read_epw(const std::string& path);

}  // namespace scenes
