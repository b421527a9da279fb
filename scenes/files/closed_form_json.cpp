#include "scenes/files/closed_form_json.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "scenes/files/curve_reader.h"
#include "scenes/geometry/fits.h"

namespace scenes {
namespace {

using spectra::JsonNode;
using spectra::JsonObject;
using spectra::Limits;
using spectra::Spectrum;

constexpr Limits kLength_m{.least = 1e-3, .most = 1e4};
constexpr Limits kEmission{.least = 0, .most = 1e9};

/// A number or { nm, values }, W m^-2 nm^-1.
Spectrum light(CurveReader& curves, const JsonNode& node) {
  if (node.is(JsonNode::Kind::number)) {
    return spectra::constant(curves.grid(), node.number(kEmission));
  }
  return curves.absolute_light(node);
}

/// The key "wished"; part names are those of the model. By default the wished part paints itself.
std::optional<WishedPart> read_wished(const JsonObject& top, CurveReader& curves,
                                      std::span<const char* const> part_names) {
  const auto node = top.find("wished");
  if (!node) return std::nullopt;
  const std::vector<std::string> names(part_names.begin(), part_names.end());
  const JsonObject wish = node->object({"of", "by", "radiosity_W_m2_nm"});
  WishedPart wished{.radiosity = curves.zero()};
  if (const auto of = wish.need("of")) wished.of = wished.by = of->choice(names);
  if (const auto by = wish.find("by")) wished.by = by->choice(names);
  if (const auto radiosity = wish.need("radiosity_W_m2_nm")) {
    wished.radiosity = light(curves, *radiosity);
  }
  return wished;
}

/// What could not be read may well shine.
bool may_shine(const Spectrum& spectrum) { return !(spectrum.values <= 0).all(); }

void read_faces(const JsonObject& top, CurveReader& curves, CubeFile& cube) {
  cube.reflectance.fill(curves.zero());
  cube.emission.fill(curves.zero());
  if (const auto node = top.need("reflectance")) {
    const std::vector<JsonNode> faces = node->list(6, 6);
    for (std::size_t i = 0; i < faces.size(); ++i) {
      cube.reflectance[i] = curves.reflectance(faces[i]).spectrum;
    }
  }
  if (const auto node = top.need("emission_W_m2_nm")) {
    const std::vector<JsonNode> faces = node->list(6, 6);
    for (std::size_t i = 0; i < faces.size(); ++i) cube.emission[i] = light(curves, faces[i]);
    if (!faces.empty() && std::ranges::none_of(cube.emission, may_shine)) {
      node->fault("no face emits light", "give at least one face an emission above 0");
    }
  }
}

void read_window(const JsonNode& node, BrickFile& brick) {
  const Limits from_zero{.least = 0, .most = 1e4};
  const JsonObject window = node.object({"width_m", "height_m", "sill_m", "offset_m"});
  brick.window_width_m = window.number("width_m", kLength_m);
  brick.window_height_m = window.number("height_m", kLength_m);
  brick.window_sill_m = window.number("sill_m", from_zero);
  brick.window_offset_m = window.number("offset_m", from_zero);
  if (brick.window_offset_m + brick.window_width_m > brick.width_m + kTouch_m) {
    node.fault("the window is wider than its wall", "make offset_m or width_m smaller");
  }
  if (brick.window_sill_m + brick.window_height_m > brick.height_m + kTouch_m) {
    node.fault("the window is higher than its wall", "make sill_m or height_m smaller");
  }
}

void read_parts(const JsonObject& top, CurveReader& curves, BrickFile& brick) {
  const std::vector<std::string> parts(kBrickParts.begin(), kBrickParts.end());
  brick.reflectance.assign(parts.size(), curves.zero());
  brick.emission.assign(parts.size(), curves.zero());
  const auto reflectance_node = top.need("reflectance"),
             emission_node = top.need("emission_W_m2_nm");
  if (!reflectance_node || !emission_node) return;
  const JsonObject reflectances = reflectance_node->object(parts);
  const JsonObject emissions = emission_node->object(parts);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const bool furniture = parts[i].starts_with("furniture");
    const bool may_lack = parts[i] == "window" || (furniture && brick.furniture_height == 0);
    const auto rho = may_lack ? reflectances.find(parts[i]) : reflectances.need(parts[i]);
    if (rho) brick.reflectance[i] = curves.reflectance(*rho).spectrum;
    if (const auto given = emissions.find(parts[i])) {
      brick.emission[i] = light(curves, *given);
    }
  }
  if (emission_node->is(JsonNode::Kind::object) &&
      std::ranges::none_of(brick.emission, may_shine)) {
    emission_node->fault("no part emits light", "give for example \"window\" an emission above 0");
  }
}

}  // namespace

CubeFile read_cube(const std::string& path) {
  spectra::JsonFile file = spectra::read_json_file(path);
  CurveReader curves(file, spectra::kClosedFormGrid);
  const JsonObject top = file.root().object(
      {"roomhue_cube", "form_factors", "reflectance", "emission_W_m2_nm", "wished"});
  CubeFile cube;
  if (const auto version = top.need("roomhue_cube")) (void)version->whole_number(1, 1);
  if (const auto factors = top.need("form_factors")) {
    const std::array<std::string, 2> choices{"paper", "exact"};
    cube.exact_form_factors = factors->choice(choices) == 1;
  }
  read_faces(top, curves, cube);
  cube.wished = read_wished(top, curves, kCubeFaces);
  file.throw_faults();
  cube.notes = curves.notes();
  return cube;
}

BrickFile read_brick(const std::string& path) {
  spectra::JsonFile file = spectra::read_json_file(path);
  CurveReader curves(file, spectra::kClosedFormGrid);
  const JsonObject top =
      file.root().object({"roomhue_brick", "width_m", "depth_m", "height_m", "furniture_height",
                          "window", "reflectance", "emission_W_m2_nm", "wished"});
  BrickFile brick;
  if (const auto version = top.need("roomhue_brick")) (void)version->whole_number(1, 1);
  brick.width_m = top.number("width_m", kLength_m);
  brick.depth_m = top.number("depth_m", kLength_m);
  brick.height_m = top.number("height_m", kLength_m);
  brick.furniture_height =
      top.number("furniture_height", {.least = 0, .most = 1, .below_most = true});
  if (const auto window = top.need("window")) read_window(*window, brick);
  read_parts(top, curves, brick);
  brick.wished = read_wished(top, curves, kBrickParts);
  file.throw_faults();
  brick.notes = curves.notes();
  return brick;
}

}  // namespace scenes
