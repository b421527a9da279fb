#include "apps/run/run_record.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "appearance/spectra/photometry.h"
#include "apps/system/sha256.h"
#include "apps/system/terminal.h"
#include "paints/files/paint_reader.h"

namespace apps {
namespace {

namespace fs = std::filesystem;

Json to_json(const Eigen::ArrayXd& values) {
  return std::vector<double>(values.data(), values.data() + values.size());
}

Json to_json(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json to_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json to_json(const spectra::RelativeXyz& xyz) { return {xyz.x, xyz.y, xyz.z}; }

/// Calls `found` with every string under a key that names a file.
template <typename Found>
void visit_file_names(const nlohmann::json& value, const Found& found) {
  for (const auto& [key, member] : value.items()) {
    const bool names_file = value.is_object() && (key == "file" || key == "atlas" || key == "epw");
    if (names_file && member.is_string()) found(member.template get<std::string>());
    if (member.is_structured()) visit_file_names(member, found);
  }
}

Json describe(const solver::EnergyBalance& energy, const SolutionColumns& columns) {
  return {{"emitted_" + columns.flux_unit, to_json(energy.emitted)},
          {"absorbed_" + columns.flux_unit, to_json(energy.absorbed)},
          {"relative_defect", energy.relative_defect}};
}

}  // namespace

Json hash_inputs(const fs::path& path, const std::string& atlas) {
  Json hashes = Json::array();
  std::set<fs::path> seen;
  const auto add = [&](const fs::path& file) {
    if (!seen.insert(file.lexically_normal()).second) return;
    hashes.push_back({{"path", file.string()}, {"sha256", sha256_of_file(file)}});
  };
  add(path);
  std::ifstream file(path);
  visit_file_names(nlohmann::json::parse(file), [&](const std::string& name) {
    const fs::path named = paints::paint_source((path.parent_path() / name).string()).path;
    if (fs::is_regular_file(named)) add(named);  // else the name of a compiled-in atlas
  });
  const fs::path file_of_atlas = paints::paint_source(atlas).path;
  if (fs::is_regular_file(file_of_atlas)) add(file_of_atlas);
  return hashes;
}

Json run_identity(const std::string& subcommand, const fs::path& input, const Json& options) {
  const Json atlas = options.value("atlas", Json());
  return {{"roomhue", ROOMHUE_VERSION},
          {"subcommand", subcommand},
          {"options", options},
          {"inputs", hash_inputs(input, atlas.is_string() ? atlas.get<std::string>() : "")}};
}

Json begin_record(const Json& identity, const Session& session) {
  Json record = identity;
  record["command"] = session.command_line;
  return record;
}

Json describe(const spectra::Grid& grid) {
  return {{"first_nm", grid.first_nm}, {"step_nm", grid.step_nm}, {"count", grid.count}};
}

Json describe(const scenes::Room& room) {
  Json reconstructed = Json::array();
  for (const scenes::Surface& surface : room.surfaces) {
    if (surface.reconstructed) reconstructed.push_back(surface.name);
  }
  Json json{{"name", room.name}, {"notes", room.notes}, {"reconstructed_surfaces", reconstructed}};
  for (const scenes::Sky& sky : room.skies) {
    json["skies"].push_back(
        {{"name", sky.name},
         {"to_sun", to_json(sky.pattern.to_sun)},
         {"horizontal_lx", sky.cd_m2 * scenes::horizontal_integral(sky.pattern)},
         {"zenith_cd_m2",
          sky.cd_m2 * scenes::relative_luminance(sky.pattern, Eigen::Vector3d::UnitZ())},
         {"ground_cd_m2", spectra::luminous({room.grid, sky.ground})}});
  }
  return json;
}

Json describe(const solver::Plan& plan) {
  Json left_out = Json::array();
  for (const auto& [what, why, saved_seconds] : plan.left_out) {
    left_out.push_back({{"what", what}, {"why", why}, {"saved_seconds", saved_seconds}});
  }
  Json json = {{"patches", plan.patches},
               {"patch_m", plan.patch_m},
               {"pairs", plan.pairs},
               {"occludable_pairs", plan.occludable_pairs},
               {"bands", plan.bands},
               {"solved_bands", plan.solved_bands},
               {"memory_bytes", plan.memory_bytes},
               {"expected_seconds", plan.expected_seconds},
               {"left_out", left_out}};
  if (plan.fine.patch_m > 0) {
    json["fine"] = {{"patches", plan.fine.patches}, {"patch_m", plan.fine.patch_m}};
  }
  return json;
}

Json describe(const solver::FineLight& fine, const SolutionColumns& columns) {
  return {{"patches", fine.mesh.size()},
          {"rays_per_patch", fine.rays_per_patch},
          {"lost_rays", fine.lost_rays},
          {"standard_error",
           {{"rms", fine.rms_standard_error}, {"largest", fine.largest_standard_error}}},
          {"energy_balance", describe(fine.energy, columns)}};
}

Json describe(const solver::RoomTransport& transport) {
  double point_defect = 0;  // what receivers see of all patches, against 1
  for (const solver::ReceiverRow& row : transport.receivers) {
    point_defect = std::max(point_defect, row.gather.closure_defect);
  }
  return {{"plan", describe(transport.plan)},
          {"closure_defect", transport.closure_defect},
          {"reciprocity_defect", transport.reciprocity_defect},
          {"largest_scaling", transport.largest_scaling},
          {"largest_self_view", transport.exchange.largest_self_view},
          {"light", transport.exchange.modes > 1 ? "linear" : "constant"},
          {"largest_slope_defect", transport.exchange.largest_slope_defect},
          {"patches_without_slopes", transport.exchange.without_slopes},
          {"direct_light_scaling", transport.lightings.front().direct_scaling},
          {"point_closure_defect", point_defect}};
}

Json describe(const solver::RoomSolution& solution, const scenes::Room& room) {
  return describe(solution, room, columns_of(room.grid));
}

Json describe(const solver::RoomSolution& solution, const scenes::Room& room,
              const SolutionColumns& columns) {
  Json bands = Json::array();
  for (std::size_t k = 0; k < solution.radiosity.bands.size(); ++k) {
    const solver::BandReport& band = solution.radiosity.bands[k];
    bands.push_back(columns.labels[k]);
    bands.back().update({{"iterations", band.iterations},
                         {"rms_error_bound", band.rms_error_bound},
                         {"max_error_bound", band.max_error_bound},
                         {"contraction", band.contraction},
                         {"converged", band.converged}});
  }
  Json receivers = Json::array();
  for (std::size_t i = 0; i < solution.receivers.size(); ++i) {
    receivers.push_back({{"name", room.receivers[i].name},
                         {"solver_error_bound", solution.receivers[i].solver_error_bound},
                         {"mesh_error", to_json(solution.receivers[i].mesh_error)}});
  }
  return {{"converged", solution.radiosity.converged},
          {"method", solver::to_string(solution.radiosity.method)},
          {"error_bounds", solution.radiosity.proven ? "proven" : "estimated"},
          {"bands", bands},
          {"receivers", receivers},
          {"energy_balance", describe(solution.energy, columns)}};
}

Json describe(const solver::ColourModel& model, const solver::ColourSolution& solution,
              const scenes::Room& room) {
  Json reflections;
  for (std::size_t s = 0; s < room.surfaces.size(); ++s) {
    const Eigen::Matrix3d& r = solution.reflections[s];
    reflections[room.surfaces[s].name] = {to_json(Eigen::Vector3d(r.row(0))),
                                          to_json(Eigen::Vector3d(r.row(1))),
                                          to_json(Eigen::Vector3d(r.row(2)))};
  }
  return {{"model", model.name},
          {"space", model.space.name},
          {"approximation", model.approximation},
          {"unit", "lm m^-2"},
          {"xyz_from_rgb",
           {to_json(Eigen::Vector3d(solution.xyz_from_rgb.row(0))),
            to_json(Eigen::Vector3d(solution.xyz_from_rgb.row(1))),
            to_json(Eigen::Vector3d(solution.xyz_from_rgb.row(2)))}},
          {"reflections", reflections},
          {"negative",
           {{"patches_of_irradiance", solution.negative.irradiance},
            {"patches_of_radiosity", solution.negative.radiosity},
            {"lowest_relative_to_brightest", solution.negative.lowest}}}};
}

Json describe(const appearance::RoomView& view, const scenes::Room& room,
              const solver::ViewedPoint& at) {
  const auto& [white, adapting_luminance_cd_m2, background_y, surround] = view.conditions;
  Json json{{"surface", room.surfaces[static_cast<std::size_t>(at.surface)].name},
            {"eye_m", to_json(at.eye_m)},
            {"point_m", to_json(at.point_m)},
            {"illuminance_lx", view.illuminance_lx},
            {"white", appearance::to_string(room.viewing.white)},
            {"white_XYZ", to_json(white)},
            {"white_luminance_cd_m2", view.white_luminance_cd_m2},
            {"L_A_cd_m2", adapting_luminance_cd_m2},
            {"background", appearance::to_string(room.viewing.background)},
            {"Y_b", background_y},
            {"surround", appearance::to_string(view.surround)},
            {"surround_ratio", view.surround_ratio},
            {"F", surround.f},
            {"c", surround.c},
            {"N_c", surround.n_c}};
  if (room.viewing.white_share != 1) {
    json["white_share"] = room.viewing.white_share;
    json["white_lamps"] = view.lamps_by_flux
                              ? "no lamp sees the viewed point: all light that enters the room"
                              : "at the viewed point, before any bounce";
  }
  if (room.viewing.size_effect) {
    json["size_effect"] = {{"angle_deg", view.angle_deg},
                           {"lightness", view.size.lightness},
                           {"chroma", view.size.chroma},
                           {"caution", appearance::kSizeEffectCaution}};
  }
  return json;
}

std::int64_t peak_memory_bytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss * std::int64_t{1024};  // Linux counts in KiB
}

OutputFile run_json(const fs::path& folder, const Json& record) {
  return {.path = folder / "run.json", .text = record.dump(2) + "\n"};
}

void report_notes(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) tell("note: {}\n", note);
}

void report_written(const std::vector<OutputFile>& files) {
  for (const OutputFile& file : files) tell("wrote {}\n", file.path.string());
}

}  // namespace apps
