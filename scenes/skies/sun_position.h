#pragma once
#include <Eigen/Core>
#include <optional>
#include <string_view>

namespace scenes {

/// A moment, by universal time.
struct Moment {
  double julian_day = 0;
  int day_of_year = 1;  ///< where its zone is
};

inline constexpr double kJulianDayOf1970 = 2440587.5;

/// "2024-06-01T10:00:00+02:00": date, time and zone, seconds as one likes, "Z" for universal time.
/// Nothing if it is anything else; local time without its zone is.
[[nodiscard]] std::optional<Moment> read_moment(std::string_view iso8601);

/// Where the sun stands, by its middle, without refraction.
struct SunPosition {
  double azimuth_deg = 0;   ///< clockwise from north
  double altitude_deg = 0;  ///< above the horizon
};

/// [Meeus1998] chapter 25, low accuracy, with nutation, aberration and parallax: within 0.01
/// degrees from 1990 to 2060.
/// @param longitude_deg  positive to the east
[[nodiscard]] SunPosition sun_position(double latitude_deg, double longitude_deg,
                                       const Moment& moment);

/// Unit vector; azimuth clockwise from +y seen from above.
[[nodiscard]] Eigen::Vector3d direction_of(double azimuth_deg, double altitude_deg);

}  // namespace scenes
