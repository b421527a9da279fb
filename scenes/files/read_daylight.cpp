// Daylight of a room file: where the sun stands, the sky as it is then, and the glass before it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/photometry.h"
#include "scenes/files/room_reader.h"
#include "scenes/skies/sun_position.h"

namespace scenes {

using Eigen::ArrayXd;
using Eigen::Vector3d;
using spectra::JsonNode;
using spectra::JsonObject;

namespace {

constexpr spectra::Limits kTurn_deg{.least = -360, .most = 360};
constexpr spectra::Limits kAmount{.least = 0, .most = 1e9, .above_least = true};
constexpr spectra::Limits kIrradiance_W_m2{.least = 0, .most = 2000};
constexpr spectra::Limits kShare{.least = 0, .most = 1, .below_most = true};

/// "cie:N" or "perez"; 0 for perez, -1 after a fault.
int sky_type(const JsonNode& node) {
  const std::string type = node.text();
  if (type.empty() || type == "perez") return type.empty() ? -1 : 0;
  for (int n = 1; n <= kCieSkies; ++n) {
    if (type == fmt::format("cie:{}", n)) return n;
  }
  node.fault(fmt::format("\"{}\" is no type of sky", type),
             "give \"cie:1\" (overcast) to \"cie:15\" (clear, white horizon), \"cie:16\" (the "
             "traditional overcast sky) or \"perez\"");
  return -1;
}

bool is_overcast(int type) { return type == 1 || type == 3 || type == kCieSkies; }

}  // namespace

spectra::Spectrum RoomReader::sun_spectrum() const {
  constexpr double kSun_K = 5500;
  return spectra::light_on(curves_.grid(), spectra::daylight(kSun_K));
}

void RoomReader::read_north() { north_deg_ = top_.number_or("north_deg", 0, kTurn_deg); }

std::optional<RoomReader::SunPlace> RoomReader::read_sun_place(const JsonNode& node) {
  if (node.has("azimuth_deg") || node.has("altitude_deg")) {
    const JsonObject place = node.object({"azimuth_deg", "altitude_deg", "day"});
    const double azimuth_deg = place.number("azimuth_deg", kTurn_deg),
                 altitude_deg = place.number("altitude_deg", {.least = -90, .most = 90});
    const auto day = place.find("day");
    if (!std::isfinite(azimuth_deg + altitude_deg)) return std::nullopt;
    return SunPlace{azimuth_deg, altitude_deg, day ? day->whole_number(1, 366) : 1};
  }
  if (node.has("epw")) return read_weather_hour(node);
  const JsonObject place = node.object({"lat", "lon", "time"});
  const double latitude_deg = place.number("lat", {.least = -90, .most = 90}),
               longitude_deg = place.number("lon", {.least = -180, .most = 180});
  const auto time = place.need("time");
  const std::string text = time ? time->text() : "";
  const std::optional<Moment> moment = read_moment(text);
  if (!moment && !text.empty()) {
    time->fault(fmt::format("\"{}\" is no time with its zone", text),
                "write it as \"2024-06-01T10:00:00+02:00\", or with Z for universal time");
  }
  if (!moment || !std::isfinite(latitude_deg + longitude_deg)) return std::nullopt;
  const SunPosition sun = sun_position(latitude_deg, longitude_deg, *moment);
  return SunPlace{std::fmod(sun.azimuth_deg + north_deg_ + 360, 360), sun.altitude_deg,
                  moment->day_of_year};
}

std::optional<Glass> RoomReader::read_glass(const JsonNode& node) {
  const JsonObject glass = node.object({"panes", "transmittance"});
  const auto panes_node = glass.need("panes");
  const int panes = panes_node ? panes_node->whole_number(1, 2) : 1;
  const auto given = glass.find("transmittance");
  const ArrayXd at_normal =
      given ? curves_.transmittance(*given).values
            : ArrayXd::Constant(curves_.grid().count, Glass::clear_at_normal(panes));
  if (!at_normal.allFinite()) return std::nullopt;
  if (at_normal.maxCoeff() > Glass::most_at_normal(panes)) {
    given->fault(fmt::format("{} of uncoated glass let no more than {:.4f} through",
                             panes == 1 ? "one pane" : "two panes", Glass::most_at_normal(panes)),
                 "give what passes at right angles; for a bare opening leave \"glass\" out");
    return std::nullopt;
  }
  return Glass(panes, at_normal);
}

std::optional<Obstruction> RoomReader::read_obstruction(const JsonNode& node) {
  const JsonObject entry = node.object({"angle_deg", "distance_m", "top_m", "reflectance"});
  Obstruction obstruction{.reflectance = entry.number_or("reflectance", 0.2, kShare)};
  if (entry.has("angle_deg")) {
    for (const char* key : {"distance_m", "top_m"}) {
      if (const auto other = entry.find(key)) {
        other->fault(fmt::format("\"{}\" does not go with \"angle_deg\"", key), "keep one of them");
      }
    }
    obstruction.angle_deg = entry.number("angle_deg", {.least = 0, .most = 90, .below_most = true});
  } else {
    obstruction.distance_m = entry.number("distance_m", kLength_m);
    obstruction.top_m = entry.number("top_m", kCoordinate_m);
  }
  return obstruction;
}

/// Without a spectrum: CIE daylight, bluer where the sky is clear.
SkyColour RoomReader::read_sky_colour(const JsonObject& light, bool overcast,
                                      const JsonNode& place) {
  const auto node = light.find("spectrum");
  if (node && node->is(JsonNode::Kind::text)) {
    if (node->text() != "by direction") {
      node->fault("this is no spectrum of a sky", "give a spectrum, or \"by direction\"");
    }
    return {.overcast = overcast};
  }
  if (node) return {.spectrum = curves_.light_shape(*node).spectrum};
  room_.notes.push_back(fmt::format("{}: no spectrum; taken as CIE daylight of {} K",
                                    place.pointer(), overcast ? 6500 : 10000));
  return {.spectrum = usual_spectrum(curves_.grid(), overcast)};
}

std::optional<Weather> RoomReader::read_weather(const JsonObject& sky, int type, int day) {
  if (type != 0) {
    for (const char* key : {"direct_normal_W_m2", "diffuse_horizontal_W_m2", "dew_point_C"}) {
      if (const auto node = sky.find(key)) {
        node->fault(fmt::format("\"{}\" goes with the type \"perez\"", key), "leave it out");
      }
    }
    return std::nullopt;
  }
  Weather weather{
      .direct_normal_W_m2 = sky.number("direct_normal_W_m2", kIrradiance_W_m2),
      .diffuse_horizontal_W_m2 = sky.number("diffuse_horizontal_W_m2", kIrradiance_W_m2),
      .day_of_year = day};
  if (sky.has("dew_point_C")) {
    weather.precipitable_water_cm =
        precipitable_water_cm(sky.number("dew_point_C", {.least = -90, .most = 50}));
  }
  return weather;
}

/// Skylight on an open plain, lx; NaN after a fault.
double RoomReader::read_sky_amount(const LightEntry& entry, const JsonObject& sky, int type,
                                   const SkyPattern& pattern) {
  const auto plain = entry.light.find("illuminance_lx"), zenith = sky.find("zenith_cd_m2");
  if (type == 0) {
    for (const auto& amount : {plain, zenith}) {
      if (!amount) continue;
      amount->fault("the irradiances say how bright this sky is", "leave this out");
    }
    return NAN;
  }
  if (plain && zenith) zenith->fault("the sky has two amounts", "keep one of them");
  if (plain) return plain->number(kAmount);
  const double per_zenith =
      horizontal_integral(pattern) / relative_luminance(pattern, Vector3d::UnitZ());
  if (zenith) return zenith->number(kAmount) * per_zenith;
  if (!is_overcast(type)) {
    entry.light.fault("the light has no amount",
                      "give \"illuminance_lx\", skylight on an open plain without the sun, or "
                      "\"zenith_cd_m2\" in \"sky\"");
    return NAN;
  }
  const double cd_m2 = 123 + 8600 * pattern.to_sun.z();
  room_.notes.push_back(
      fmt::format("{}: no amount; {:.0f} cd/m2 at the zenith, as overcast skies "
                  "have in the mean with the sun that high",
                  entry.kind.pointer(), cd_m2));
  return cd_m2 * per_zenith;
}

/// The sun of this sky, normal to its beam; a light of its own if the sky has a "sun".
spectra::Spectrum RoomReader::read_beam(const LightEntry& entry, const JsonObject& sky,
                                        const SunPlace& place, double weather_lx) {
  const auto node = sky.find("sun");
  spectra::Spectrum shape = sun_spectrum();
  double beam_lx = weather_lx;
  if (node) {
    const JsonObject sun = node->object({"spectrum", "illuminance_lx"});
    if (const auto given = sun.find("spectrum")) shape = curves_.light_shape(*given).spectrum;
    const auto amount = sun.find("illuminance_lx");
    if (amount && std::isfinite(weather_lx)) {
      amount->fault("the irradiances say how bright this sun is", "leave this out");
    } else if (!std::isfinite(weather_lx)) {
      beam_lx = sun.number("illuminance_lx", {.least = 0, .most = 1e9});
    }
  }
  spectra::Spectrum beam = curves_.zero();
  if (beam_lx > 0 && spectra::luminous(shape) > 0) {
    beam = spectra::scaled_to_luminous(shape, beam_lx);
  }
  if (node) add_sun_of_sky(*node, entry.name, place, beam);
  return beam;
}

void RoomReader::add_sun_of_sky(const JsonNode& node, const std::string& sky, const SunPlace& place,
                                const spectra::Spectrum& beam) {
  const std::string name = sky + ".sun";
  claim_name(node, name);
  room_.lights.push_back({.name = name, .sun = static_cast<int>(room_.suns.size())});
  room_.suns.push_back({.name = name,
                        .azimuth_deg = place.azimuth_deg,
                        .altitude_deg = place.altitude_deg,
                        .normal_irradiance = beam});
}

void RoomReader::read_sky(const LightEntry& entry) {
  const JsonObject node =
      entry.kind.object({"type", "direct_normal_W_m2", "diffuse_horizontal_W_m2", "dew_point_C",
                         "zenith_cd_m2", "ground_reflectance", "obstruction", "sun"});
  for (const char* key : {"flux_lm", "power_W", "efficacy_lm_W", "exitance_W_m2_nm"}) {
    if (const auto amount = entry.light.find(key)) {
      amount->fault(fmt::format("\"{}\" has no meaning for a sky", key), "give \"illuminance_lx\"");
    }
  }
  if (opening_places_.empty()) {
    entry.kind.fault("the room has no opening for the sky", "add one to \"openings\"");
  }
  const auto type_node = node.need("type"), at = entry.light.need("at");
  const int type = type_node ? sky_type(*type_node) : -1;
  const double ground = node.number_or("ground_reflectance", 0.2, kShare);
  const auto opposite = node.find("obstruction");
  const auto obstruction = opposite ? read_obstruction(*opposite) : std::nullopt;
  if (at && at->has("epw")) {
    if (type > 0) type_node->fault("a weather file goes with the type \"perez\"", "give \"perez\"");
    read_weather_sky(entry, node, *at, {.ground_reflectance = ground, .obstruction = obstruction});
    return;
  }
  const std::optional<SunPlace> place = at ? read_sun_place(*at) : std::nullopt;
  room_.lights.push_back({.name = entry.name, .sky = static_cast<int>(room_.skies.size())});
  if (type < 0 || !place) {
    room_.skies.push_back({.name = entry.name});
    return;
  }
  room_.skies.push_back(sky_of(entry, node, type, *place, ground));
  room_.skies.back().name = entry.name;
  room_.skies.back().obstruction = obstruction;
}

Sky RoomReader::sky_of(const LightEntry& entry, const JsonObject& node, int type,
                       const SunPlace& place, double ground_reflectance) {
  const bool night = place.altitude_deg <= 0;
  const Vector3d to_sun =
      direction_of(place.azimuth_deg, night ? 90 : place.altitude_deg);  // any, where it is dark
  const std::optional<Weather> weather = read_weather(node, type, place.day);
  SkyPattern pattern = cie_sky(type > 0 ? type : 5, to_sun);
  bool overcast = is_overcast(type);
  double horizontal_lx = read_sky_amount(entry, node, type, pattern), beam_lx = NAN;
  if (weather && std::isfinite(weather->direct_normal_W_m2 + weather->diffuse_horizontal_W_m2)) {
    const Daylight light = daylight_by_weather(*weather, place.azimuth_deg, place.altitude_deg);
    if (!light.defined) {
      entry.kind.fault(kNoSuchSky, kMendWeather);
      return {};
    }
    pattern = light.horizontal_lx > 0 ? light.pattern : pattern;
    overcast = light.overcast;
    horizontal_lx = light.horizontal_lx;
    beam_lx = light.beam_lx;
  }
  const SkyColour colour = read_sky_colour(entry.light, overcast, entry.kind);
  const spectra::Spectrum beam = read_beam(entry, node, place, night ? 0 : beam_lx);
  if (night) {
    room_.notes.push_back(entry.kind.pointer() + ": the sun is below the horizon; no daylight");
  }
  const bool sound = beam.values.allFinite() && std::isfinite(horizontal_lx) &&
                     (!colour.spectrum || spectra::luminous(*colour.spectrum) > 0);
  if (!sound) return {};
  return make_sky(curves_.grid(), pattern, colour,
                  {.horizontal_lx = night ? 0 : horizontal_lx,
                   .beam = beam.values,
                   .ground_reflectance = ground_reflectance});
}

}  // namespace scenes
