#include "apps/run/room_options.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace apps {
namespace {

template <typename Value>
std::string name_in(const std::map<std::string, Value>& names, Value value) {
  return std::find_if(names.begin(), names.end(),
                      [&](const auto& entry) { return entry.second == value; })
      ->first;
}

Json to_json(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

}  // namespace

const std::map<std::string, solver::Light>& light_names() {
  static const std::map<std::string, solver::Light> names{{"linear", solver::Light::linear},
                                                          {"constant", solver::Light::constant}};
  return names;
}

const std::map<std::string, solver::Method>& method_names() {
  static const std::map<std::string, solver::Method> names{
      {"auto", solver::Method::automatic},          {"cg", solver::Method::conjugate_gradients},
      {"jacobi", solver::Method::jacobi},           {"gauss-seidel", solver::Method::gauss_seidel},
      {"progressive", solver::Method::progressive}, {"direct", solver::Method::direct},
      {"bicgstab", solver::Method::bicgstab},
  };
  return names;
}

const std::map<std::string, paints::Distance>& distance_names() {
  static const std::map<std::string, paints::Distance> names{
      {"jab", paints::Distance::jab},
      {"cam02-ucs", paints::Distance::cam02_ucs},
  };
  return names;
}

Json to_json(const RoomOptions& options) {
  return {{"patch_m", options.patch_m > 0 ? Json(options.patch_m) : Json()},
          {"light", name_in(light_names(), options.light)},
          {"method", name_in(method_names(), options.radiosity.method)},
          {"relative_error", options.radiosity.relative_error},
          {"skip", options.radiosity.skip}};
}

Json to_json(const SolveOptions& options) {
  Json json = to_json(options.room);
  json["tolerance"] = options.tolerance > 0 ? Json(options.tolerance) : Json();
  json["richardson"] = options.richardson;
  json["ambient"] = options.room.radiosity.ambient;
  json["overshoot"] = options.room.radiosity.overshoot;
  return json;
}

Json to_json(const RankOptions& options) {
  Json json = to_json(options.room);
  json["atlas"] = options.atlas.empty() ? Json() : Json(options.atlas);
  json["top"] = options.top > 0 ? Json(options.top) : Json();
  json["resolve_top"] = options.resolve_top;
  json["max_dJ"] = to_json(options.windows.lightness);
  json["max_dC"] = to_json(options.windows.chroma);
  json["max_dh_deg"] = to_json(options.windows.hue_deg);
  json["distance"] = name_in(distance_names(), options.distance);
  json["robust"] = options.robust;
  return json;
}

Json to_json(const MixOptions& options) {
  Json json = to_json(options.rank.room);
  json["atlas"] = options.rank.atlas.empty() ? Json() : Json(options.rank.atlas);
  json["top"] = options.rank.top > 0 ? Json(options.rank.top) : Json();
  json["bases"] = options.bases;
  json["step"] = options.step > 0 ? Json(options.step) : Json();
  json["saunderson"] = {options.surface.k1, options.surface.k2};
  return json;
}

}  // namespace apps
