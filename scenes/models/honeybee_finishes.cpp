#include "scenes/models/honeybee_finishes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace scenes {
namespace {

using spectra::JsonNode;
using spectra::JsonObject;

constexpr spectra::Limits kShare{.least = 0, .most = 1};

/// Transmittance of a pane from Radiance's transmissivity, both at right angles.
/// tn = (sqrt(a + b Tn^2) - c) / (d Tn) [Larson1998], solved for Tn; c^2 = a.
double transmittance_of(double transmissivity) {
  constexpr double kB = 0.0072522239, kC = 0.9166530661, kD = 0.0036261119;
  return 2 * kC * kD * transmissivity / (kB - kD * kD * transmissivity * transmissivity);
}

/// Honeybee's own set, Generic_Interior_Visible.
const std::map<std::string, ModelFinish>& defaults() {
  const auto grey = [](double r) {
    return ModelFinish{.reflectance = Eigen::Array3d::Constant(r)};
  };
  const auto glass = [](double t) { return ModelFinish{.transmittance = t}; };
  static const std::map<std::string, ModelFinish> kDefaults{
      {"wall_set/interior_modifier", grey(0.5)},
      {"wall_set/exterior_modifier", grey(0.5)},
      {"floor_set/interior_modifier", grey(0.2)},
      {"floor_set/exterior_modifier", grey(0.2)},
      {"roof_ceiling_set/interior_modifier", grey(0.8)},
      {"roof_ceiling_set/exterior_modifier", grey(0.8)},
      {"door_set/interior_modifier", grey(0.5)},
      {"door_set/exterior_modifier", grey(0.5)},
      {"door_set/overhead_modifier", grey(0.5)},
      {"shade_set/interior_modifier", grey(0.5)},
      {"shade_set/exterior_modifier", grey(0.35)},
      {"aperture_set/window_modifier", glass(0.64)},
      {"aperture_set/skylight_modifier", glass(0.64)},
      {"aperture_set/operable_modifier", glass(0.64)},
      {"aperture_set/interior_modifier", glass(0.88)},
      {"door_set/exterior_glass_modifier", glass(0.64)},
      {"door_set/interior_glass_modifier", glass(0.88)}};
  return kDefaults;
}

std::string text_of(const JsonObject& object, const char* key) {
  const auto node = given(object, key);
  return node && node->is(JsonNode::Kind::text) ? node->text() : "";
}

}  // namespace

std::optional<JsonNode> given(const JsonObject& object, const char* key) {
  const auto node = object.find(key);
  return node && !node->is(JsonNode::Kind::null) ? node : std::nullopt;
}

HoneybeeFinishes::HoneybeeFinishes(const std::optional<JsonNode>& radiance,
                                   std::vector<std::string>& notes)
    : notes_(notes) {
  if (!radiance) return;
  const JsonObject properties = radiance->any_object();
  if (const auto list = given(properties, "modifiers")) {
    for (const JsonNode& node : list->list(0, 100'000)) read_modifier(node);
  }
  if (const auto list = given(properties, "modifier_sets")) {
    for (const JsonNode& node : list->list(0, 10'000)) read_set(node);
  }
  if (const auto global = given(properties, "global_modifier_set")) {
    if (global->is(JsonNode::Kind::object)) {
      global_set_ = text_of(global->any_object(), "identifier");
      const JsonObject set = global->any_object();
      if (const auto list = given(set, "modifiers")) {
        for (const JsonNode& node : list->list(0, 100'000)) read_modifier(node);
      }
      read_set(*global);
    } else {
      global_set_ = global->text();
    }
  }
}

void HoneybeeFinishes::note_once(const std::string& note) {
  if (std::ranges::find(notes_, note) == notes_.end()) notes_.push_back(note);
}

void HoneybeeFinishes::read_modifier(const JsonNode& node) {
  const std::string name = text_of(node.any_object(), "identifier");
  if (!name.empty()) modifiers_[name] = finish_of(node);
}

ModelFinish HoneybeeFinishes::finish_of(const JsonNode& node) {
  const JsonObject modifier = node.any_object();
  const std::string type = text_of(modifier, "type"), name = text_of(modifier, "identifier");
  const auto rgb = [&](const char* what) {
    Eigen::Array3d values;
    for (int k = 0; k < 3; ++k) {
      values[k] = modifier.number(std::string(1, "rgb"[k]) + "_" + what, kShare);
    }
    return values;
  };
  if (type == "Plastic" || type == "Metal") {
    const double specular =
        given(modifier, "specularity") ? modifier.number("specularity", kShare) : 0;
    if (specular > 0) {
      note_once(
          fmt::format("modifier \"{}\": {:g} of its light is mirrored; not carried over, the "
                      "rest is",
                      name, specular));
    }
    return {.reflectance = rgb("reflectance") * (1 - specular)};
  }
  if (type == "Glass") {
    const Eigen::Array3d t = rgb("transmissivity");
    if (t.maxCoeff() - t.minCoeff() > 1e-6) {
      note_once(fmt::format("modifier \"{}\": the glass is tinted; its mean is taken", name));
    }
    return {.transmittance = transmittance_of(t.mean())};
  }
  if (type == "Void") return {.transmittance = 1};
  note_once(fmt::format("modifier \"{}\" is a {}: not carried over, taken as black", name,
                        type.empty() ? "thing without a type" : type));
  return {};
}

/// Abridged sets name their modifiers, full ones hold them.
void HoneybeeFinishes::read_set(const JsonNode& node) {
  const JsonObject set = node.any_object();
  std::map<std::string, std::string>& parts = sets_[text_of(set, "identifier")];
  for (const auto& [part, finish] : defaults()) {
    const std::size_t slash = part.find('/');
    const auto group = given(set, part.substr(0, slash).c_str());
    if (!group) continue;
    const auto modifier = given(group->any_object(), part.substr(slash + 1).c_str());
    if (!modifier) continue;
    if (modifier->is(JsonNode::Kind::text)) {
      parts[part] = modifier->text();
    } else {
      read_modifier(*modifier);
      parts[part] = text_of(modifier->any_object(), "identifier");
    }
  }
}

ModelFinish HoneybeeFinishes::of(const std::optional<JsonNode>& own, const std::string& set,
                                 const std::string& part) {
  std::string name;
  if (own) {
    const JsonObject radiance = own->any_object();
    name = text_of(radiance, "modifier");
    if (given(radiance, "dynamic_group_identifier")) {
      note_once("states of dynamic groups are not carried over; state 0 is taken");
    }
    if (name.empty()) {
      if (const auto held = given(radiance, "modifier")) return finish_of(*held);
    }
  }
  for (const std::string& of : {set, global_set_}) {
    const auto known = sets_.find(of);
    if (!name.empty() || known == sets_.end()) continue;
    const auto found = known->second.find(part);
    if (found != known->second.end()) name = found->second;
  }
  const auto modifier = modifiers_.find(name);
  if (modifier != modifiers_.end()) return modifier->second;
  if (!name.empty())
    note_once(fmt::format("modifier \"{}\" is not in the model; the default is taken", name));
  return defaults().at(part);
}

}  // namespace scenes
