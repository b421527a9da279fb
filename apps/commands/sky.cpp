#include <fmt/format.h>

#include <cmath>

#include "appearance/spectra/text/input_error.h"
#include "apps/commands/commands.h"
#include "apps/run/run_record.h"
#include "apps/system/terminal.h"
#include "scenes/skies/weather_sky.h"

namespace apps {
namespace {

using scenes::SkyState, scenes::SunPosition, scenes::WeatherFile, scenes::WeatherHour;

/// An hour of weather as a sky.
struct HourOfDaylight {
  SunPosition sun;
  scenes::Daylight light;
  SkyState state;
  double zenith_cd_m2 = 0;

  [[nodiscard]] bool night() const { return light.defined && !(light.horizontal_lx > 0); }
};

HourOfDaylight daylight_of(const WeatherFile& file, const WeatherHour& hour) {
  HourOfDaylight of{.sun =
                        scenes::sun_position(file.latitude_deg, file.longitude_deg, hour.moment)};
  of.light = scenes::daylight_by_weather(hour.weather, of.sun.azimuth_deg, of.sun.altitude_deg);
  if (of.night() || !of.light.defined) return of;
  of.state = scenes::sky_state(hour.weather,
                               scenes::direction_of(of.sun.azimuth_deg, of.sun.altitude_deg));
  of.zenith_cd_m2 = of.light.horizontal_lx / scenes::horizontal_integral(of.light.pattern) *
                    scenes::relative_luminance(of.light.pattern, Eigen::Vector3d::UnitZ());
  return of;
}

std::string text_of(const WeatherFile& file, const WeatherHour& hour, const HourOfDaylight& light) {
  std::vector<std::vector<std::string>> rows{
      {"what", "value"},
      {"place", fmt::format("{}, {:.3f} north, {:.3f} east", file.place, file.latitude_deg,
                            file.longitude_deg)},
      {"time", fmt::format("month {}, day {}, {}:00 to {}:00 standard time", hour.month, hour.day,
                           hour.hour - 1, hour.hour)},
      {"sun", fmt::format("azimuth {:.2f}, altitude {:.2f} degrees", light.sun.azimuth_deg,
                          light.sun.altitude_deg)},
      {"irradiance",
       fmt::format("direct normal {:g}, diffuse horizontal {:g} W/m2",
                   hour.weather.direct_normal_W_m2, hour.weather.diffuse_horizontal_W_m2)}};
  if (light.night()) {
    rows.push_back({"daylight", "none"});
  } else if (!light.light.defined) {
    rows.push_back({"daylight", "the Perez model has no sky for such weather"});
  } else {
    rows.push_back({"sky", fmt::format("clearness {:.3f}, brightness {:.3f}", light.state.clearness,
                                       light.state.brightness)});
    rows.push_back({"skylight on a plain", fmt::format("{:.0f} lx", light.light.horizontal_lx)});
    rows.push_back({"sun, normal to it", fmt::format("{:.0f} lx", light.light.beam_lx)});
    rows.push_back({"zenith", fmt::format("{:.0f} cd/m2", light.zenith_cd_m2)});
  }
  return table("<<", rows);
}

Json data_of(const WeatherHour& hour, const HourOfDaylight& light, const Json& entry) {
  return {{"azimuth_deg", light.sun.azimuth_deg},
          {"altitude_deg", light.sun.altitude_deg},
          {"direct_normal_W_m2", hour.weather.direct_normal_W_m2},
          {"diffuse_horizontal_W_m2", hour.weather.diffuse_horizontal_W_m2},
          {"clearness", light.night() ? Json() : Json(light.state.clearness)},
          {"brightness", light.night() ? Json() : Json(light.state.brightness)},
          {"skylight_lx", light.light.horizontal_lx},
          {"sun_lx", light.light.beam_lx},
          {"zenith_cd_m2", light.light.defined ? Json(light.zenith_cd_m2) : Json()},
          {"light", entry}};
}

}  // namespace

Exit describe_sky(const SkyCommand& command, const Session& session) {
  const WeatherFile file = scenes::read_epw(command.weather);
  if (static_cast<std::size_t>(command.hour) > file.hours.size()) {
    throw spectra::InputError(
        {{command.weather, 0, 0, "", fmt::format("there are {} hours in it", file.hours.size()),
          fmt::format("give --hour from 1 to {}", file.hours.size())}});
  }
  const WeatherHour& hour = file.hours[static_cast<std::size_t>(command.hour) - 1];
  const HourOfDaylight light = daylight_of(file, hour);
  const Json entry{{"name", "daylight"},
                   {"sky", {{"type", "perez"}, {"sun", Json::object()}}},
                   {"at", {{"epw", command.weather}, {"hour", command.hour}}}};
  put(session.json ? data_of(hour, light, entry).dump(2) + "\n"
                   : text_of(file, hour, light) + "\nas one of the \"lights\" of a room:\n" +
                         entry.dump() + "\n");
  return Exit::done;
}

}  // namespace apps
