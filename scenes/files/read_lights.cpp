// The lights of a room file: what they are, and how much light they give.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "appearance/spectra/photometry.h"
#include "scenes/files/room_reader.h"
#include "scenes/geometry/fits.h"

namespace scenes {

using spectra::JsonNode;
using spectra::JsonObject;
using spectra::Limits;

namespace {

const std::vector<std::string> kKinds{"panel", "opening", "point", "sun", "sky", "luminaire"};
const std::vector<std::string> kAmounts{"flux_lm", "power_W", "illuminance_lx", "exitance_W_m2_nm"};
constexpr Limits kAmount{.least = 0, .most = 1e9, .above_least = true};

std::vector<std::string> present(const JsonObject& object, const std::vector<std::string>& keys) {
  std::vector<std::string> found;
  std::ranges::copy_if(keys, std::back_inserter(found),
                       [&](const std::string& key) { return object.has(key); });
  return found;
}

double efficacy_lm_W(const JsonObject& light, const LightShape& shape) {
  // No light source gives more than 683 lm per watt.
  const Limits limits{.least = 0, .most = 683, .above_least = true};
  if (light.has("efficacy_lm_W")) return light.number("efficacy_lm_W", limits);
  if (shape.efficacy_lm_W > 0) return shape.efficacy_lm_W;
  light.fault("\"power_W\" needs the efficacy of the lamp", "add \"efficacy_lm_W\"");
  return NAN;
}

}  // namespace

void RoomReader::read_lights() {
  opening_exitance_.resize(room_.openings.size());
  const auto lights = top_.need("lights");
  lights_known_ = lights && lights->is(JsonNode::Kind::list);
  if (!lights) return;
  const Places entries = lights->list();
  if (entries.empty() && lights->is(JsonNode::Kind::list)) {
    lights->fault("there is no light at all",
                  "add a panel, a lit opening, a luminaire, a point, a sun or a sky");
  }
  for (const JsonNode& node : entries) {
    read_light(node.object({"name", "panel", "opening", "point", "sun", "sky", "at", "luminaire",
                            "reflectance", "spectrum", "flux_lm", "dim", "power_W", "efficacy_lm_W",
                            "illuminance_lx", "exitance_W_m2_nm"}));
  }
}

void RoomReader::read_light(const JsonObject& light) {
  const std::string name = light.name("name");
  if (const auto node = light.find("name")) claim_name(*node, name);
  const std::vector<std::string> kinds = present(light, kKinds);
  if (kinds.size() != 1) {
    lights_known_ = false;
    light.fault(kinds.empty() ? "the light says not what it is"
                              : fmt::format("the light is both {} and {}", kinds[0], kinds[1]),
                "give exactly one of " + spectra::alternatives(kKinds));
    return;
  }
  const JsonNode node = *light.find(kinds[0]);
  if (const auto reflectance = light.find("reflectance"); reflectance && kinds[0] != "panel") {
    reflectance->fault(fmt::format("\"reflectance\" has no meaning for this light ({})", kinds[0]),
                       "an opening's stands in \"surfaces\"; leave it out here");
  }
  if (const auto dim = light.find("dim"); dim && kinds[0] != "luminaire") {
    dim->fault(fmt::format("\"dim\" has no meaning for this light ({})", kinds[0]),
               "only luminaires know their own flux; give less of the amount");
  }
  if (const auto at = light.find("at"); at && kinds[0] != "sun" && kinds[0] != "sky") {
    at->fault(fmt::format("\"at\" has no meaning for this light ({})", kinds[0]),
              "it says where the sun stands, for a sun or a sky");
  }
  const LightEntry entry{.light = light, .kind = node, .name = name};
  if (kinds[0] == "panel") {
    read_panel(entry);
  } else if (kinds[0] == "opening") {
    read_lit_opening(entry);
  } else if (kinds[0] == "point") {
    read_point(entry);
  } else if (kinds[0] == "luminaire") {
    read_luminaire_light(entry);
  } else if (kinds[0] == "sky") {
    read_sky(entry);
  } else {
    read_sun(entry);
  }
}

spectra::Spectrum RoomReader::emitted(const JsonObject& light, const AmountRules& rules) {
  const std::vector<std::string> amounts = present(light, kAmounts);
  const auto shape_node = light.find("spectrum");
  const auto efficacy = light.find("efficacy_lm_W");
  const LightShape shape =
      shape_node ? curves_.light_shape(*shape_node) : LightShape{.spectrum = curves_.zero()};
  if (amounts.size() != 1) {
    light.fault(amounts.empty()
                    ? "the light has no amount"
                    : fmt::format("the light has two amounts, {} and {}", amounts[0], amounts[1]),
                "give exactly one of " + spectra::alternatives(rules.keys));
    return curves_.zero();
  }
  const std::string& key = amounts[0];
  const JsonNode node = *light.find(key);
  if (std::ranges::find(rules.keys, key) == rules.keys.end()) {
    node.fault(fmt::format("\"{}\" has no meaning for a {}", key, rules.kind),
               "give " + spectra::alternatives(rules.keys));
    return curves_.zero();
  }
  if (efficacy && key != "power_W") {
    efficacy->fault("an efficacy goes with \"power_W\" only", "leave it out");
  }
  if (key == "exitance_W_m2_nm") {
    if (shape_node) {
      room_.notes.push_back(shape_node->pointer() + ": replaced by exitance_W_m2_nm");
    }
    return curves_.absolute_light(node);
  }
  if (!shape_node) light.fault("the key \"spectrum\" is missing", "add \"spectrum\"");

  double amount = node.number(kAmount);
  if (key == "power_W") amount *= efficacy_lm_W(light, shape);
  if (key != "illuminance_lx") amount /= rules.area_m2;
  if (!std::isfinite(amount) || !(spectra::luminous(shape.spectrum) > 0)) return curves_.zero();
  return spectra::scaled_to_luminous(shape.spectrum, amount);
}

void RoomReader::read_panel(const LightEntry& entry) {
  const JsonObject shape =
      entry.kind.object({"on", "center_m", "size_m", "outline_m", "reflectance"});
  const FacePart part = read_part(shape, "panel");
  if (!part.outline.empty()) check_overlap(part, entry.kind, "panel");
  Lamp lamp{.reflectance = {.spectrum = curves_.zero()},
            .exitance = emitted(entry.light, {.kind = "panel",
                                              .keys = {"flux_lm", "power_W", "exitance_W_m2_nm"},
                                              .area_m2 = part.area_m2})};
  const auto own = shape.find("reflectance"), beside = entry.light.find("reflectance");
  if (own && beside) own->fault("the panel has two reflectances", "keep one of them");
  if (own || beside) lamp.reflectance = curves_.reflectance(own ? *own : *beside);
  room_.lights.push_back({.name = entry.name,
                          .kind = SurfaceKind::panel,
                          .index = static_cast<int>(room_.panels.size()),
                          .exitance = lamp.exitance});
  room_.panels.push_back({.name = entry.name, .face = part.face, .outline = part.outline});
  lamps_.push_back(lamp);
}

int RoomReader::surface_named(const JsonNode& on) const {
  if (on.is(JsonNode::Kind::text)) {
    if (on.text() == "floor") return 0;
    if (on.text() == "ceiling") return 1;
  }
  const int wall = wall_named(on);
  return wall < 0 ? -1 : wall + 2;
}

void RoomReader::read_lit_opening(const LightEntry& entry) {
  std::vector<std::string> names;
  for (const Opening& o : room_.openings) names.push_back(o.name);
  const std::string name = entry.kind.name();
  const auto found = std::ranges::find(names, name);
  const bool known = found != names.end() && !name.empty();
  const auto index = static_cast<std::size_t>(found - names.begin());
  const spectra::Spectrum exitance =
      emitted(entry.light, {.kind = "lit opening",
                            .keys = {"flux_lm", "power_W", "illuminance_lx", "exitance_W_m2_nm"},
                            .area_m2 = known ? opening_area_m2_[index] : NAN});
  if (known) {
    auto& sum = opening_exitance_[index];
    if (!sum) sum = curves_.zero();
    sum->values += exitance.values;
    room_.lights.push_back({.name = entry.name,
                            .kind = SurfaceKind::opening,
                            .index = static_cast<int>(index),
                            .exitance = exitance});
    return;
  }
  lights_known_ = false;
  // An opening whose own name could not be read may be the one that is meant.
  if (!name.empty() && std::ranges::find(names, "") == names.end()) {
    entry.kind.fault(
        fmt::format("there is no opening \"{}\"", name),
        names.empty() ? "add it to \"openings\"" : "give " + spectra::alternatives(names));
  }
}

void RoomReader::read_point(const LightEntry& entry) {
  const std::vector<double> at = entry.kind.object({"at_m"}).numbers("at_m", 3, kCoordinate_m);
  const Eigen::Vector3d at_m(at[0], at[1], at[2]);
  room_.lights.push_back(
      {.name = entry.name, .point = static_cast<int>(room_.point_lights.size())});
  room_.point_lights.push_back(
      {.name = entry.name,
       .at_m = at_m,
       .spectral_flux = emitted(entry.light, {.kind = "point", .keys = {"flux_lm", "power_W"}})});
  // On a surface half of the flux would be lost; 1 mm is where a lamp is no point any more.
  if (at_m.allFinite() && shell_sound_ && clearance_m(at_m) < kShortest_m) {
    entry.kind.fault("the point light is outside the room, on a surface or in furniture",
                     "move it to where there is air around it, at least 1 mm");
  }
}

void RoomReader::read_sun(const LightEntry& entry) {
  const auto at = entry.light.find("at");
  Sun sun{.name = entry.name,
          .normal_irradiance = emitted(
              entry.light, {.kind = "sun", .keys = {"illuminance_lx", "exitance_W_m2_nm"}})};
  if (at) {
    (void)entry.kind.object({});
    const auto place = read_sun_place(*at);
    sun.azimuth_deg = place ? place->azimuth_deg : NAN;
    sun.altitude_deg = place ? place->altitude_deg : NAN;
  } else {
    const JsonObject place = entry.kind.object({"azimuth_deg", "altitude_deg"});
    sun.azimuth_deg = place.number("azimuth_deg", {.least = -360, .most = 360});
    sun.altitude_deg = place.number("altitude_deg", {.least = 0, .most = 90, .above_least = true});
  }
  if (sun.altitude_deg <= 0) {
    sun.normal_irradiance = curves_.zero();
    room_.notes.push_back(entry.kind.pointer() + ": this sun is below the horizon; no light");
  }
  room_.lights.push_back({.name = entry.name, .sun = static_cast<int>(room_.suns.size())});
  room_.suns.push_back(sun);
  if (opening_places_.empty()) {
    entry.kind.fault("the room has no opening for the sun", "add one to \"openings\"");
  } else if (shell_sound_ && sun.altitude_deg > 0) {
    check_sun(sun, entry.kind);
  }
}

void RoomReader::check_sun(const Sun& sun, const JsonNode& place) {
  const double azimuth = sun.azimuth_deg * std::numbers::pi / 180,
               altitude = sun.altitude_deg * std::numbers::pi / 180;
  const Eigen::Vector3d to_sun(std::sin(azimuth) * std::cos(altitude),
                               std::cos(azimuth) * std::cos(altitude), std::sin(altitude));
  const bool enters = std::ranges::any_of(room_.openings, [&](const Opening& o) {
    if (o.face < 0) return true;
    return -room_.shell[static_cast<std::size_t>(o.face)].frame.normal.dot(to_sun) > 1e-9;
  });
  if (enters) return;
  if (top_.find("lights")->list().size() == 1) {
    place.fault("the only light is a sun behind all openings",
                "turn azimuth_deg (clockwise from +y seen from above) or add a light");
  }
  room_.notes.push_back(place.pointer() + ": no opening faces this sun, it adds no light");
}

}  // namespace scenes
