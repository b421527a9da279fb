// How a room file wants the room and the swatch to be seen: viewing conditions and target.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "appearance/spectra/photometry.h"
#include "scenes/files/room_reader.h"

namespace scenes {

using spectra::JsonNode;
using spectra::JsonObject;

namespace {

constexpr spectra::Limits kAngle_deg{.least = 0, .most = 180, .above_least = true};
constexpr spectra::Limits kBackgroundY{.least = 0, .most = 100, .above_least = true};
constexpr spectra::Limits kShare{.least = 0, .most = 1};
constexpr spectra::Limits kIlluminance_lx{.least = 0, .most = 1e9, .above_least = true};

// In the order of the enumerations.
const std::array<std::string, 6> kSurrounds{"neumann", "cie", "illuminance",
                                            "average", "dim", "dark"};
const std::array<std::string, 2> kBackgrounds{"ring", "sample"};
const std::array<std::string, 3> kWhites{"ideal", "surfaces", "lamps"};

void read_white(const JsonNode& node, spectra::ViewingChoices& viewing) {
  if (node.is(JsonNode::Kind::object)) {
    viewing.white_share = node.object({"share"}).number("share", kShare);
    return;
  }
  const int choice = node.choice(kWhites);
  viewing.white = choice == 1 ? spectra::ReferenceWhite::surfaces : spectra::ReferenceWhite::ideal;
  if (choice == 2) viewing.white_share = 0;
}

void read_background(const JsonNode& node, spectra::ViewingChoices& viewing) {
  if (node.is(JsonNode::Kind::number)) {
    viewing.background = spectra::Background::fixed;
    viewing.background_y = node.number(kBackgroundY);
    return;
  }
  viewing.background = static_cast<spectra::Background>(node.choice(kBackgrounds));
}

void read_size_effect(const JsonNode& node, spectra::ViewingChoices& viewing) {
  viewing.size_effect = true;
  if (node.is(JsonNode::Kind::boolean)) {
    viewing.size_effect = node.truth();
  } else if (node.is(JsonNode::Kind::object)) {
    viewing.angle_deg = node.object({"angle_deg"}).number("angle_deg", kAngle_deg);
  } else {
    node.fault("this is no size effect", "give true, false or { \"angle_deg\": 60 }");
  }
}

}  // namespace

void RoomReader::read_viewing_choices(const JsonObject& view) {
  spectra::ViewingChoices& viewing = room_.viewing;
  if (const auto surround = view.find("surround")) {
    viewing.surround = static_cast<spectra::Surround>(surround->choice(kSurrounds));
  }
  if (const auto background = view.find("background")) read_background(*background, viewing);
  if (const auto white = view.find("white")) read_white(*white, viewing);
  if (const auto size = view.find("size_effect")) read_size_effect(*size, viewing);
  if (viewing.size_effect) room_.notes.emplace_back("/view/size_effect: unverified constants");
}

void RoomReader::read_target(const JsonNode& node, PaintTask& task) {
  const JsonNode colour = node.beside({"seen", "angle_deg"});
  TargetColour target{.name = "", .colour = curves_.zero()};
  const bool correlates = node.has("J") || node.has("C") || node.has("h_deg");
  if (correlates) {
    const JsonObject jch = colour.object({"J", "C", "h_deg"});
    const Eigen::Vector3d wished(jch.number("J", {.least = 0, .most = 150}),
                                 jch.number("C", {.least = 0, .most = 250}),
                                 jch.number("h_deg", {.least = 0, .most = 360}));
    target.name = fmt::format("J {} C {} h {}", wished[0], wished[1], wished[2]);
    target.colour = wished;
  } else {
    const Reflectance reflectance = curves_.reflectance(colour);
    target.name = reflectance.name;
    target.colour = reflectance.spectrum;
  }
  if (node.has("seen") || node.has("angle_deg")) read_swatch(node.any_object(), correlates, target);
  task.target = target;
}

void RoomReader::read_swatch(const JsonObject& swatch, bool correlates, TargetColour& target) {
  static const std::array<std::string, 2> places{"standard", "here"};  // as the enumeration
  if (correlates) {
    swatch.fault(
        "J, C and h say how the wall is to look, so there is no swatch to be held anywhere",
        "leave out \"seen\" and \"angle_deg\", or give a reflectance");
    return;
  }
  if (swatch.has("angle_deg")) target.angle_deg = swatch.number("angle_deg", kAngle_deg);
  const auto seen = swatch.find("seen");
  if (!seen) return;
  if (seen->is(JsonNode::Kind::object)) {
    target.seen = SwatchPlace::own;
    target.own = read_swatch_light(*seen);
    return;
  }
  target.seen = static_cast<SwatchPlace>(seen->choice(places));
  if (target.seen == SwatchPlace::here &&
      room_.viewing.white == spectra::ReferenceWhite::surfaces) {
    seen->fault("the white here is the light at the viewed point, not that of near-white surfaces",
                "take \"white\": \"ideal\", \"lamps\" or { \"share\": .. } in \"view\"");
  }
}

SwatchLight RoomReader::read_swatch_light(const JsonNode& node) {
  const JsonObject condition = node.object({"spectrum", "illuminance_lx", "Y_b", "surround"});
  SwatchLight light{.irradiance = curves_.zero()};
  const auto spectrum = condition.need("spectrum");
  const double illuminance_lx = condition.number("illuminance_lx", kIlluminance_lx);
  light.background_y = condition.number("Y_b", kBackgroundY);
  if (const auto surround = condition.need("surround")) {
    const int choice = surround->choice(std::span(kSurrounds).last(3));
    light.surround = static_cast<spectra::Surround>(3 + std::max(choice, 0));
  }
  if (!spectrum) return light;
  const spectra::Spectrum shape = curves_.light_shape(*spectrum).spectrum;
  if (spectra::luminous(shape) > 0 && illuminance_lx > 0) {
    light.irradiance = spectra::scaled_to_luminous(shape, illuminance_lx);
  }
  return light;
}

}  // namespace scenes
