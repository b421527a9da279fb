#include "scenes/skies/sun_position.h"

#include <charconv>
#include <chrono>
#include <cmath>
#include <numbers>

namespace scenes {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Takes fixed-width numbers and marks off the front of a text.
class Cursor {
 public:
  explicit Cursor(std::string_view text) : left_(text) {}

  [[nodiscard]] std::optional<int> digits(std::size_t count) {
    if (left_.size() < count) return std::nullopt;
    int value = 0;
    for (const char c : left_.substr(0, count)) {
      if (c < '0' || c > '9') return std::nullopt;
      value = 10 * value + (c - '0');
    }
    left_.remove_prefix(count);
    return value;
  }

  [[nodiscard]] bool take(char mark) {
    if (left_.empty() || left_.front() != mark) return false;
    left_.remove_prefix(1);
    return true;
  }

  /// A fraction behind the point; its digits may be many.
  [[nodiscard]] double fraction() {
    double value = 0, place = 0.1;
    for (; !left_.empty() && left_.front() >= '0' && left_.front() <= '9'; place /= 10) {
      value += place * (left_.front() - '0');
      left_.remove_prefix(1);
    }
    return value;
  }

  [[nodiscard]] bool at_end() const { return left_.empty(); }

 private:
  std::string_view left_;
};

/// Minutes of a zone east of Greenwich, the last thing in a time.
std::optional<int> read_zone(Cursor& text) {
  if (text.take('Z')) return 0;
  const int sign = text.take('+') ? 1 : text.take('-') ? -1 : 0;
  if (sign == 0) return std::nullopt;
  const auto hours = text.digits(2);
  if (!hours || *hours > 14) return std::nullopt;
  (void)text.take(':');
  const auto minutes = text.digits(2);
  if (!minutes || *minutes > 59) return std::nullopt;
  return sign * (60 * *hours + *minutes);
}

}  // namespace

std::optional<Moment> read_moment(std::string_view iso8601) {
  using namespace std::chrono;
  Cursor text(iso8601);
  const auto year_number = text.digits(4);
  if (!year_number || !text.take('-')) return std::nullopt;
  const auto month_number = text.digits(2);
  if (!month_number || !text.take('-')) return std::nullopt;
  const auto day_number = text.digits(2);
  if (!day_number || !text.take('T')) return std::nullopt;
  const year_month_day date{year{*year_number}, month{static_cast<unsigned>(*month_number)},
                            day{static_cast<unsigned>(*day_number)}};
  const auto hour = text.digits(2);
  if (!date.ok() || !hour || *hour > 24 || !text.take(':')) return std::nullopt;
  const auto minute = text.digits(2);
  if (!minute || *minute > 59) return std::nullopt;
  double second = 0;
  if (text.take(':')) {
    const auto whole = text.digits(2);
    if (!whole || *whole > 60) return std::nullopt;
    second = *whole + (text.take('.') ? text.fraction() : 0);
  }
  const auto zone = read_zone(text);
  if (!zone || !text.at_end()) return std::nullopt;
  if (*hour == 24 && *minute + second > 0) return std::nullopt;
  const sys_days since_1970{date};
  const double whole_days = static_cast<double>(since_1970.time_since_epoch().count());
  const double minutes = 60.0 * *hour + *minute + second / 60 - *zone;
  const sys_days new_year{year_month_day{date.year(), January, day{1}}};
  return Moment{.julian_day = kJulianDayOf1970 + whole_days + minutes / 1440,
                .day_of_year = static_cast<int>((since_1970 - new_year).count()) + 1};
}

SunPosition sun_position(double latitude_deg, double longitude_deg, const Moment& moment) {
  constexpr double kDeltaT_s = 69, kParallax_deg = 8.794 / 3600;
  const double days = moment.julian_day - 2451545;
  const double t = (days + kDeltaT_s / 86400) / 36525;  // centuries of dynamical time
  const double mean_longitude = 280.46646 + t * (36000.76983 + t * 0.0003032);
  const double anomaly = (357.52911 + t * (35999.05029 - t * 0.0001537)) * kDegree;
  const double centre = (1.914602 - t * (0.004817 + t * 0.000014)) * std::sin(anomaly) +
                        (0.019993 - t * 0.000101) * std::sin(2 * anomaly) +
                        0.000289 * std::sin(3 * anomaly);
  const double node = (125.04 - 1934.136 * t) * kDegree;
  const double nutation_deg = -0.00478 * std::sin(node);
  const double longitude = (mean_longitude + centre - 0.00569 + nutation_deg) * kDegree;
  const double obliquity =
      (23.4392911 - t * (0.0130042 + t * (1.64e-7 - t * 5.04e-7)) + 0.00256 * std::cos(node)) *
      kDegree;
  const double right_ascension =
      std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude));
  const double declination = std::asin(std::sin(obliquity) * std::sin(longitude));

  const double centuries = days / 36525;
  const double sidereal_deg = 280.46061837 + 360.98564736629 * days +
                              centuries * centuries * (0.000387933 - centuries / 38710000) +
                              nutation_deg * std::cos(obliquity);
  const double hour_angle = (sidereal_deg + longitude_deg) * kDegree - right_ascension;
  const double latitude = latitude_deg * kDegree;
  const double altitude =
      std::asin(std::sin(latitude) * std::sin(declination) +
                std::cos(latitude) * std::cos(declination) * std::cos(hour_angle));
  const double from_south =
      std::atan2(std::sin(hour_angle), std::cos(hour_angle) * std::sin(latitude) -
                                           std::tan(declination) * std::cos(latitude));
  return {.azimuth_deg = std::fmod(from_south / kDegree + 540, 360),
          .altitude_deg = altitude / kDegree - kParallax_deg * std::cos(altitude)};
}

Eigen::Vector3d direction_of(double azimuth_deg, double altitude_deg) {
  const double azimuth = azimuth_deg * kDegree, altitude = altitude_deg * kDegree;
  return {std::sin(azimuth) * std::cos(altitude), std::cos(azimuth) * std::cos(altitude),
          std::sin(altitude)};
}

}  // namespace scenes
