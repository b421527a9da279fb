// Hours of a weather file, as skies of a room.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "appearance/spectra/illuminants.h"
#include "scenes/files/room_reader.h"

namespace scenes {

using spectra::JsonNode;
using spectra::JsonObject;

namespace {

constexpr int kMostHours = 10'000'000, kMostScenarios = 100;

}  // namespace

std::optional<RoomReader::SunPlace> RoomReader::read_weather_hour(const JsonNode& node) {
  const JsonObject entry = node.object({"epw", "hour"});
  const auto path_node = entry.need("epw");
  const std::string path = path_node ? path_node->name() : "";
  const auto file = path.empty() ? nullptr : weather_file(*path_node, curves_.resolve(path));
  const auto hours = file ? read_hours(entry, *file) : std::nullopt;
  if (!hours) return std::nullopt;
  const WeatherHour& hour = file->hours[static_cast<std::size_t>(hours->first) - 1];
  const SunPosition sun = sun_position(file->latitude_deg, file->longitude_deg, hour.moment);
  return SunPlace{std::fmod(sun.azimuth_deg + north_deg_ + 360, 360), sun.altitude_deg,
                  hour.weather.day_of_year};
}

std::shared_ptr<const WeatherFile> RoomReader::weather_file(const JsonNode& node,
                                                            const std::string& path) {
  const auto known = weather_files_.find(path);
  if (known != weather_files_.end()) return known->second;
  std::shared_ptr<const WeatherFile>& file = weather_files_[path];
  try {
    file = std::make_shared<const WeatherFile>(read_epw(path));
  } catch (const spectra::FileError& error) {
    node.fault(error.what(), "give a path relative to the folder of this file");
  } catch (const spectra::InputError& error) {
    file_.add(error.faults());
    node.fault(fmt::format("{} is faulty", path), "mend that file");
  }
  return file;
}

/// Which hours of a file, the first and the last; none after a fault.
std::optional<std::pair<int, int>> RoomReader::read_hours(const JsonObject& at,
                                                          const WeatherFile& file) {
  const int count = static_cast<int>(file.hours.size());
  const auto one = at.find("hour"), several = at.find("hours");
  if (one && several) {
    several->fault("there are an hour and hours", "keep one of them");
    return std::nullopt;
  }
  if (!several) {
    const auto node = at.need("hour");
    const int hour = node ? node->whole_number(1, kMostHours) : 0;
    if (hour > count) {
      node->fault(fmt::format("the file has {} hours", count),
                  "count them from 1, the first after midnight of January 1st");
    }
    return hour < 1 || hour > count ? std::nullopt : std::make_optional(std::pair(hour, hour));
  }
  const std::vector<JsonNode> ends = several->list(2, 2);
  if (ends.size() != 2) return std::nullopt;
  const int first = ends[0].whole_number(1, kMostHours), last = ends[1].whole_number(1, kMostHours);
  if (last < first || last > count || last - first >= kMostScenarios) {
    several->fault(fmt::format("hours {} to {} of {}", first, last, count),
                   fmt::format("give the first and the last hour, at most {} of them; for more "
                               "there is \"roomhue daylight\"",
                               kMostScenarios));
    return std::nullopt;
  }
  return std::pair(first, last);
}

/// The sky of an hour, or of several: each a light, and a scenario if there is light in it.
void RoomReader::read_weather_sky(const LightEntry& entry, const JsonObject& node,
                                  const JsonNode& at, WeatherSky over) {
  const JsonObject place = at.object({"epw", "hour", "hours"});
  for (const char* key :
       {"direct_normal_W_m2", "diffuse_horizontal_W_m2", "dew_point_C", "zenith_cd_m2"}) {
    if (const auto given = node.find(key)) {
      given->fault("the weather file says how bright it is", "leave this out");
    }
  }
  if (const auto given = entry.light.find("illuminance_lx")) {
    given->fault("the weather file says how bright it is", "leave this out");
  }
  if (const auto spectrum = entry.light.find("spectrum")) {
    SkyColour colour = read_sky_colour(entry.light, false, entry.kind);
    over.by_direction = !colour.spectrum;
    over.spectrum = std::move(colour.spectrum);
  } else {
    room_.notes.push_back(entry.kind.pointer() +
                          ": no spectrum; CIE daylight of 6500 K, of 10000 K under clear skies");
  }
  over.sun_spectrum = sun_spectrum();
  const auto sun_node = node.find("sun");
  if (sun_node) {
    const auto shape = sun_node->object({"spectrum"}).find("spectrum");
    if (shape) over.sun_spectrum = curves_.light_shape(*shape).spectrum;
  }
  over.north_deg = north_deg_;
  const auto path_node = place.need("epw");
  const std::string path = path_node ? path_node->name() : "";
  over.file = path.empty() ? nullptr : weather_file(*path_node, curves_.resolve(path));
  const auto hours = over.file ? read_hours(place, *over.file) : std::nullopt;
  if (!hours || (over.spectrum && !over.spectrum->values.allFinite()) ||
      !over.sun_spectrum.values.allFinite()) {
    return;
  }
  dark_hours_.clear();
  for (int hour = hours->first; hour <= hours->second; ++hour) {
    const std::string name =
        place.has("hours") ? fmt::format("{} {}", entry.name, hour) : entry.name;
    add_weather_hour(entry, sun_node, over, hour, name);
  }
  const WeatherHour& first = over.file->hours[static_cast<std::size_t>(hours->first) - 1];
  room_.notes.push_back(fmt::format(
      "{}: {}, from {:02}-{:02}, {}:00 standard time{}{}", entry.kind.pointer(), over.file->place,
      first.month, first.day, first.hour - 1, dark_hours_.empty() ? "" : "; no daylight in hour ",
      fmt::join(dark_hours_, ", ")));
}

void RoomReader::add_weather_hour(const LightEntry& entry, const std::optional<JsonNode>& sun_node,
                                  WeatherSky over, int hour, const std::string& name) {
  const SkyOfHour light = sky_of_hour(curves_.grid(), over, static_cast<std::size_t>(hour) - 1);
  if (!light.defined) {
    entry.kind.fault(fmt::format("hour {}: {}", hour, kNoSuchSky), kMendWeather);
    return;
  }
  over.sky = static_cast<int>(room_.skies.size());
  room_.lights.push_back({.name = name, .sky = over.sky});
  room_.skies.push_back(light.sky ? *light.sky : dark_sky(curves_.grid()));
  room_.skies.back().name = name;
  if (sun_node) {
    over.sun = static_cast<int>(room_.suns.size());
    add_sun_of_sky(*sun_node, name, {light.azimuth_deg, light.altitude_deg}, light.beam);
  }
  if (!light.sky) dark_hours_.push_back(hour);
  room_.weather_skies.push_back(over);
  if (name == entry.name) return;
  claim_name(entry.kind, name);
  if (light.sky) hour_lights_.push_back(name);
}

}  // namespace scenes
