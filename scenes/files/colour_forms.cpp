#include "scenes/files/colour_forms.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "appearance/spectra/illuminants.h"

namespace scenes {
namespace {

using spectra::JsonNode;
using spectra::JsonObject;
using spectra::StatedWhite;

constexpr std::array kForms{"hex", "Lab", "XYZ", "xyY", "LRV"};

StatedWhite read_white(const JsonObject& colour) {
  StatedWhite white;
  if (const auto node = colour.find("illuminant")) {
    const int choice = node->choice(spectra::illuminant_names());
    if (choice >= 0)
      white.illuminant = spectra::illuminant_names()[static_cast<std::size_t>(choice)];
  }
  if (const auto node = colour.find("observer")) {
    const double degrees = node->number();
    if (degrees == 2 || degrees == 10) {
      white.observer_deg = static_cast<int>(degrees);
    } else if (std::isfinite(degrees)) {
      node->fault(fmt::format("there is no observer of {} degrees", degrees), "give 2 or 10");
    }
  }
  return white;
}

NamedColour of_three(const JsonNode& node, const std::string& form) {
  const JsonObject object = node.object({form, "illuminant", "observer"});
  const StatedWhite white = read_white(object);
  const std::vector<double> v = object.numbers(form, 3, {.least = -200, .most = 200});
  if (!std::isfinite(v[0] + v[1] + v[2])) return {};
  NamedColour named{.name =
                        fmt::format("{} {} {} {} ({})", form, v[0], v[1], v[2], to_string(white))};
  if (form == "Lab" && v[0] >= 0 && v[0] <= 100) {
    named.colour = spectra::from_lab({v[0], v[1], v[2]}, white);
  } else if (form == "XYZ" && std::min({v[0], v[1], v[2]}) >= 0) {
    named.colour = spectra::from_xyz({v[0], v[1], v[2]}, white);
  } else if (form == "xyY" && v[0] >= 0 && v[1] > 0 && v[0] + v[1] <= 1 && v[2] >= 0) {
    named.colour = spectra::from_xy_y(v[0], v[1], v[2], white);
  } else {
    node.fault(fmt::format("{} {} {} is no {}", v[0], v[1], v[2], form),
               "give L* 0..100; X, Y, Z from 0 with Y 0..100; or y above 0 and x + y up to 1");
  }
  return named;
}

}  // namespace

bool states_colour(const JsonNode& node) {
  return std::any_of(kForms.begin(), kForms.end(), [&](const char* f) { return node.has(f); });
}

NamedColour read_colour(const JsonNode& node) {
  if (node.has("hex")) {
    const std::string text = node.object({"hex"}).name("hex");
    const auto rgb = spectra::parse_hex(text);
    if (rgb) return {.colour = spectra::from_srgb(*rgb), .name = "hex " + text};
    if (!text.empty()) {
      node.fault(fmt::format("\"{}\" is no hex colour", text), "give one like \"#D8C9A7\"");
    }
    return {};
  }
  if (node.has("LRV")) {
    const double lrv = node.object({"LRV"}).number("LRV", {.least = 0, .most = 100});
    if (!std::isfinite(lrv)) return {};
    return {.colour = spectra::from_lrv(lrv), .name = fmt::format("LRV {}", lrv)};
  }
  return of_three(node, node.has("Lab") ? "Lab" : node.has("XYZ") ? "XYZ" : "xyY");
}

}  // namespace scenes
