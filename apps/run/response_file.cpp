#include "apps/run/response_file.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "appearance/spectra/text/input_error.h"
#include "apps/system/sha256.h"

namespace apps {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr const char* kFormat = "roomhue_response";
constexpr int kVersion = 3;

template <typename Values>
Json list_of(const Values& values) {
  Json list = Json::array();
  for (Index i = 0; i < values.size(); ++i) list.push_back(values[i]);
  return list;
}

Json json_of(const spectra::Spectrum& s) { return list_of(s.values); }

Json json_of(const MatrixXd& m) {
  return {{"rows", m.rows()}, {"columns", m.cols()}, {"values", list_of(m.reshaped())}};
}

MatrixXd matrix_of(const Json& json) {
  const auto values = json.at("values").get<std::vector<double>>();
  const auto rows = json.at("rows").get<Index>(), columns = json.at("columns").get<Index>();
  if (rows < 0 || columns < 0 || rows * columns != static_cast<Index>(values.size())) {
    throw std::out_of_range("a matrix of another size");
  }
  return Eigen::Map<const MatrixXd>(values.data(), rows, columns);
}

/// Sizes that fit together, whatever the numbers are.
bool is_sound(const solver::ReducedViews& views) {
  const auto& transfers = views.room.transfers;
  const auto& bands = views.room.bands;
  if (static_cast<int>(bands.size()) != views.grid.count || transfers.empty()) return false;
  const auto outputs = transfers.front().phi.rows();
  const auto lights = bands.empty() ? 0 : bands.front().gamma.cols();
  for (const auto& t : transfers) {
    const auto n = static_cast<Index>(t.group.size());
    if (t.k.rows() != n || t.k.cols() != n || t.phi.rows() != outputs || t.phi.cols() != n) {
      return false;
    }
    for (const int g : t.group) {
      if (g < 0 || g >= views.room.groups) return false;
    }
  }
  for (const auto& b : bands) {
    if (b.transfer < 0 || b.transfer >= static_cast<int>(transfers.size())) return false;
    const auto n = transfers[static_cast<std::size_t>(b.transfer)].k.rows();
    if (b.gamma.rows() != n || b.gamma.cols() != lights || b.constant.rows() != outputs ||
        b.constant.cols() != lights) {
      return false;
    }
  }
  return true;
}

/// The lamps of every viewed point and lighting, and an angle for each point.
bool has_lamps(const solver::ReducedViews& views) {
  const auto points = static_cast<std::size_t>(views.viewed);
  if (views.lamps.size() != points || views.angle_deg.size() != points) return false;
  const auto lights = static_cast<std::size_t>(views.room.bands.front().gamma.cols());
  for (const auto& of_point : views.lamps) {
    if (of_point.size() != lights) return false;
    for (const solver::LampLight& lamps : of_point) {
      if (lamps.light.values.size() != views.grid.count) return false;
    }
  }
  return true;
}

Json json_of(const solver::LampLight& lamps) {
  return {{"light", json_of(lamps.light)}, {"by_flux", lamps.by_flux}};
}

solver::LampLight lamps_of(const Json& json, const spectra::Grid& grid) {
  const auto values = json.at("light").get<std::vector<double>>();
  return {.light = {grid, Eigen::Map<const Eigen::ArrayXd>(values.data(),
                                                           static_cast<Index>(values.size()))},
          .by_flux = json.at("by_flux")};
}

Json json_of(const scenes::Outline& outline) {
  Json corners = Json::array();
  for (const Eigen::Vector3d& corner : outline) corners.push_back(list_of(corner));
  return corners;
}

Json json_of(const std::vector<scenes::Outline>& outlines) {
  Json all = Json::array();
  for (const scenes::Outline& outline : outlines) all.push_back(json_of(outline));
  return all;
}

Json shape_of(const scenes::Room& room) {
  Json shape;
  for (const scenes::ShellFace& f : room.shell) {
    shape["shell"].push_back({f.surface, json_of(f.outline), json_of(f.holes)});
  }
  for (const scenes::Opening& o : room.openings) {
    shape["openings"].push_back({o.face, json_of(o.outline), json_of(o.transmittance)});
    if (!o.glass) continue;
    shape["openings"].back().push_back(o.glass->panes());
    shape["openings"].back().push_back(list_of(o.glass->at_normal()));
  }
  for (const scenes::Panel& p : room.panels) {
    shape["panels"].push_back({p.face, json_of(p.outline)});
  }
  for (const scenes::Body& b : room.furniture) shape["furniture"].push_back(json_of(b.faces));
  return shape;
}

Json json_of(const scenes::Sky& sky) {
  const scenes::SkyPattern& p = sky.pattern;
  Json json{{"pattern", {p.a, p.b, p.c, p.d, p.e, p.shift, p.traditional}},
            {"to_sun", list_of(p.to_sun)},
            {"cd_m2", sky.cd_m2},
            {"scale", sky.scale},
            {"components", list_of(sky.components.reshaped())},
            {"by_direction", {sky.by_direction, sky.overcast}},
            {"beam", list_of(sky.beam)},
            {"ground", list_of(sky.ground)}};
  if (const auto& o = sky.obstruction) {
    json["obstruction"] = {o->angle_deg, o->distance_m.value_or(-1), o->top_m.value_or(-1),
                           o->reflectance};
  }
  return json;
}

Json light_of(const scenes::Room& room) {
  Json light;
  for (const scenes::Surface& s : room.surfaces) light["exitance"].push_back(json_of(s.exitance));
  for (const scenes::PointLight& p : room.point_lights) {
    light["points"].push_back({list_of(p.at_m), json_of(p.spectral_flux)});
  }
  for (const scenes::Sun& s : room.suns) {
    light["suns"].push_back({s.azimuth_deg, s.altitude_deg, json_of(s.normal_irradiance)});
  }
  for (const scenes::Sky& s : room.skies) light["skies"].push_back(json_of(s));
  for (const scenes::PlacedLuminaire& l : room.luminaires) {
    light["luminaires"].push_back({sha256_of_file(l.type->path), list_of(l.at_m),
                                   list_of(l.axes.reshaped()), json_of(l.spectral_flux)});
  }
  return light;
}

Json json_of(const solver::ReducedViews& views) {
  const solver::ReducedRoom& room = views.room;
  Json json{{"grid", {views.grid.first_nm, views.grid.step_nm, views.grid.count}},
            {"viewed", views.viewed},
            {"white_of_surfaces", views.white_of_surfaces},
            {"groups", room.groups},
            {"highest_reflectance", room.highest_reflectance},
            {"solves", room.solves},
            {"held_out_solves", room.held_out},
            {"largest_error", room.largest_error},
            {"converged", room.converged}};
  for (const Eigen::VectorXd& share : views.share) json["share"].push_back(list_of(share));
  json["angle_deg"] = views.angle_deg;
  for (const auto& of_point : views.lamps) {
    Json& lamps = json["lamps"].emplace_back(Json::array());
    for (const solver::LampLight& l : of_point) lamps.push_back(json_of(l));
  }
  for (const auto& t : room.transfers) {
    json["transfers"].push_back({{"k", json_of(t.k)}, {"phi", json_of(t.phi)}, {"group", t.group}});
  }
  for (const auto& b : room.bands) {
    json["bands"].push_back(
        {{"transfer", b.transfer}, {"gamma", json_of(b.gamma)}, {"constant", json_of(b.constant)}});
  }
  return json;
}

/// @throws std::exception  if something is missing or of another kind
solver::ReducedViews views_of(const Json& json) {
  solver::ReducedViews views{.grid = {.first_nm = json.at("grid").at(0),
                                      .step_nm = json.at("grid").at(1),
                                      .count = json.at("grid").at(2)},
                             .viewed = json.at("viewed"),
                             .white_of_surfaces = json.at("white_of_surfaces")};
  views.room.groups = json.at("groups");
  views.room.highest_reflectance = json.at("highest_reflectance");
  views.room.solves = json.at("solves");
  views.room.held_out = json.at("held_out_solves");
  views.room.largest_error = json.at("largest_error");
  views.room.converged = json.at("converged");
  for (const Json& share : json.value("share", Json::array())) {
    const auto values = share.get<std::vector<double>>();
    views.share.emplace_back(
        Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Index>(values.size())));
  }
  views.angle_deg = json.at("angle_deg").get<std::vector<double>>();
  for (const Json& of_point : json.at("lamps")) {
    auto& lamps = views.lamps.emplace_back();
    for (const Json& l : of_point) lamps.push_back(lamps_of(l, views.grid));
  }
  for (const Json& t : json.at("transfers")) {
    views.room.transfers.push_back({.k = matrix_of(t.at("k")),
                                    .phi = matrix_of(t.at("phi")),
                                    .group = t.at("group").get<std::vector<int>>()});
  }
  for (const Json& b : json.at("bands")) {
    views.room.bands.push_back({.transfer = b.at("transfer"),
                                .gamma = matrix_of(b.at("gamma")),
                                .constant = matrix_of(b.at("constant"))});
  }
  return views;
}

}  // namespace

std::string response_key(const scenes::Room& room, const RoomOptions& options) {
  Json all{{"version", ROOMHUE_VERSION},
           {"options", to_json(options)},
           {"patch_m", options.patch_m > 0 ? options.patch_m : room.patch_m},
           {"shape", shape_of(room)},
           {"light", light_of(room)},
           {"white", static_cast<int>(room.viewing.white)}};
  for (const scenes::Scenario& s : room.scenarios) {
    all["scenarios"].push_back(light_of(scenes::relit(room, s)));
  }
  for (int s = 0; s < static_cast<int>(room.surfaces.size()); ++s) {
    const int group = scenes::paint_group(room, s);
    all["surfaces"].push_back(
        group >= 0 ? Json(group) : json_of(room.surfaces[static_cast<std::size_t>(s)].reflectance));
  }
  for (std::size_t g = 0; g < room.paint.size(); ++g) {
    const solver::ViewedPoint at = solver::viewed_point(room, g);
    all["views"].push_back({list_of(at.eye_m), list_of(at.point_m), at.surface});
  }
  return sha256_of(all.dump());
}

OutputFile response_file(const std::filesystem::path& path, const std::string& key,
                         const ResponseOnMeshes& meshes) {
  Json json{{kFormat, kVersion}, {"key", key}};
  for (const solver::ReducedViews& views : meshes) json["meshes"].push_back(json_of(views));
  return {.path = path, .text = json.dump() + "\n"};
}

void require_free_for_response(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return;
  std::string start(64, '\0');
  std::ifstream(path).read(start.data(), static_cast<std::streamsize>(start.size()));
  if (start.find(kFormat) != start.npos) return;
  throw spectra::FileError(path.string() +
                           ": exists and is no room response; name another file with --response");
}

std::optional<ResponseOnMeshes> load_response(const std::filesystem::path& path,
                                              const std::string& key) {
  std::ifstream file(path);
  const Json json = Json::parse(file, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object()) return std::nullopt;
  try {
    if (json.at(kFormat) != kVersion || json.at("key") != key) return std::nullopt;
    ResponseOnMeshes meshes;
    for (const Json& views : json.at("meshes")) {
      meshes.push_back(views_of(views));
      if (!is_sound(meshes.back()) || !has_lamps(meshes.back())) return std::nullopt;
    }
    return meshes.empty() ? std::nullopt : std::optional(std::move(meshes));
  } catch (const std::exception&) {
    return std::nullopt;  // whoever damaged it, solving anew mends it
  }
}

}  // namespace apps
