#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "apps/commands/commands.h"
#include "apps/reports/room_reports.h"
#include "apps/run/room_run.h"
#include "apps/system/terminal.h"
#include "solver/rooms/ambient_term.h"
#include "solver/rooms/mesh_study.h"

namespace apps {
namespace {

/// Of mesh and solver, in the strongest band.
std::string error_text(const solver::ReceiverLight& light) {
  if (!light.mesh_error) return "";
  return fmt::format("{:.3f} %", 100 * (*light.mesh_error + light.solver_error_bound));
}

std::string receiver_table(const scenes::Room& room, const SolutionColumns& columns,
                           const solver::RoomSolution& solution) {
  std::vector<std::vector<std::string>> rows{{"receiver", "illuminance", "error"}};
  for (std::size_t i = 0; i < room.receivers.size(); ++i) {
    const solver::ReceiverLight& light = solution.receivers[i];
    rows.push_back({room.receivers[i].name,
                    fmt::format("{:.1f} lx", illuminance_lx(columns, light)), error_text(light)});
  }
  return table("<>>", rows);
}

Json receiver_list(const scenes::Room& room, const SolutionColumns& columns,
                   const solver::RoomSolution& solution) {
  Json receivers = Json::array();
  for (std::size_t i = 0; i < room.receivers.size(); ++i) {
    receivers.push_back({{"receiver", room.receivers[i].name},
                         {"illuminance_lx", illuminance_lx(columns, solution.receivers[i])}});
  }
  return receivers;
}

/// Where too many patches were asked for to be solved: what they get of the light of those that
/// were. `gather` computes it.
template <typename Gather>
std::optional<solver::FineLight> gathered(RoomRun& run, const SolutionColumns& columns,
                                          const Gather& gather) {
  if (!(run.transport.plan.fine.patch_m > 0)) return {};
  solver::FineLight fine = gather();
  run.clock.stop("fine patches");
  run.record["fine_patches"] = describe(fine, columns);
  tell(
      "note: {} coarse patches were solved; their light was gathered to {} patches with a "
      "standard error of {:.2g} (RMS)\n",
      run.transport.plan.patches, fine.mesh.size(), fine.rms_standard_error);
  return fine;
}

/// How far the cheap answer is from the solution, at the receivers; relative to their strongest
/// bands.
Json describe_ambient_term(const scenes::Room& room, const solver::RoomSolution& solution) {
  const solver::Bands cheap = solver::extended_ambient_term(room, room.receivers);
  double largest = 0, squares = 0;
  for (std::size_t i = 0; i < room.receivers.size(); ++i) {
    const Eigen::ArrayXd& h = solution.receivers[i].irradiance;
    if (!(h.maxCoeff() > 0)) continue;
    const Eigen::ArrayXd error =
        (cheap.row(static_cast<Eigen::Index>(i)).transpose() - h) / h.maxCoeff();
    largest = std::max(largest, error.abs().maxCoeff());
    squares += error.square().mean();
  }
  const auto count = static_cast<double>(room.receivers.size());
  return {{"max_relative_error", largest}, {"rms_relative_error", std::sqrt(squares / count)}};
}

/// Writes the outputs of a solved room.
RunResult report(RoomRun& run, const SolutionColumns& columns, const solver::RoomSolution& solution,
                 bool converged, const std::optional<solver::FineLight>& fine,
                 const std::filesystem::path& out) {
  const auto& radiosity = solution.radiosity;
  const PatchLight patches =
      fine ? PatchLight{fine->mesh, fine->irradiance, fine->radiosity, &fine->standard_error}
           : PatchLight{run.transport.mesh, radiosity.irradiance, radiosity.radiosity};
  RunResult result = finish(
      run, converged,
      {{.path = out / "receivers.csv", .text = receivers_csv(run.room, columns, solution)},
       {.path = out / "patches.csv",
        .text = {},
        .pieces =
            [&](const TextSink& sink) { write_patches_csv(run.room, columns, patches, sink); }}},
      out);
  result.text = receiver_table(run.room, columns, solution);
  result.data = {{"status", result.record["status"]},
                 {"folder", out.string()},
                 {"receivers", receiver_list(run.room, columns, solution)}};
  return result;
}

/// Negative light and light that grows: what three numbers do that spectra cannot.
void warn(const solver::ColourSolution& solution) {
  const auto& [irradiance, radiosity, lowest] = solution.negative;
  if (irradiance + radiosity > 0) {
    tell(
        "note: negative components in the irradiance of {} patches and the radiosity of {}, "
        "down to {:.3g} of the brightest; they are kept\n",
        irradiance, radiosity, lowest);
  }
  const solver::RadiositySolution& light = solution.light.radiosity;
  const double growth =
      std::ranges::max(light.bands, {}, &solver::BandReport::contraction).contraction;
  if (growth >= 1) {
    tell(
        "light grows by {:.4g} from bounce to bounce in these three numbers: no answer; the "
        "outputs hold the first bounce\n",
        growth);
  } else if (!light.proven) {
    tell("note: error bounds are estimated from 60 bounces, not proven\n");
  }
}

RunResult run_solve_colour(const SolveCommand& command, const solver::ColourModel& model,
                           const Session& session) {
  const RoomOptions& options = command.options.room;
  Json described = to_json(options);
  described["colour"] = model.name;
  RoomRun run = open_room(command.room, "solve", described, session);
  prepare(run, options, command.out);
  const solver::ColourSolution solution =
      solver::solve_room_colour(run.room, run.transport, model, options.radiosity);
  run.clock.stop("solve");
  warn(solution);
  const SolutionColumns columns = columns_of(solution);
  run.record["colour"] = describe(model, solution, run.room);
  run.record["solution"] = describe(solution.light, run.room, columns);
  const auto fine = gathered(
      run, columns, [&] { return solver::fine_light(run.room, run.transport, model, solution); });
  return report(run, columns, solution.light, solution.light.radiosity.converged, fine,
                command.out);
}

Json tolerance_record(const solver::ToleranceSolution& chosen, double tolerance) {
  Json steps = Json::array();
  for (const auto& [patch_m, patches, error] : chosen.steps) {
    steps.push_back({{"patch_m", patch_m},
                     {"patches", patches},
                     {"mesh_error", error.mesh},
                     {"solver_error_bound", error.solver}});
  }
  return {{"asked", tolerance},
          {"reached", chosen.reached},
          {"relative_error", chosen.relative_error},
          {"rays", chosen.rays},
          {"meshes", steps}};
}

/// The room on the mesh that the tolerance asks for.
/// @return whether it was reached
bool solve_to_tolerance(RoomRun& run, const SolveOptions& options, const std::filesystem::path& out,
                        solver::RoomSolution& solution) {
  solver::ToleranceSolution chosen =
      solver::solve_to_tolerance(run.room, options.tolerance,
                                 transport_options(run, options.room, out), options.room.radiosity);
  run.transport = std::move(chosen.transport);
  run.clock.stop("tolerance");
  run.record["transport"] = describe(run.transport);
  run.record["tolerance"] = tolerance_record(chosen, options.tolerance);
  const auto& [patch_m, patches, error] = chosen.steps.back();
  tell("{} {:g}: patches of {:.3g} m, {} of them, error {:.2g}\n",
       chosen.reached ? "tolerance" : "not reached: tolerance", options.tolerance, patch_m, patches,
       error.sum());
  solution = std::move(chosen.solution);
  return chosen.reached;
}

/// The room on the mesh as given, and what that leaves.
bool solve_on_mesh(RoomRun& run, const SolveOptions& options, const std::filesystem::path& out,
                   solver::RoomSolution& solution) {
  prepare(run, options.room, out);
  const solver::RadiosityOptions& radiosity = options.room.radiosity;
  solution = solver::solve_room(run.room, run.transport, radiosity);
  run.clock.stop("solve");
  if (!solver::study_mesh(run.room, transport_options(run, options.room, out), radiosity,
                          run.transport.plan.patch_m, options.richardson, solution)) {
    tell("note: no error of the mesh, longer patches cut this room no other way\n");
  }
  run.clock.stop("mesh error");
  return solution.radiosity.converged;
}

}  // namespace

RunResult run_solve(const std::string& path, const SolveOptions& options,
                    const std::filesystem::path& out, const Session& session) {
  RoomRun run = open_room(path, "solve", to_json(options), session);
  solver::RoomSolution solution;
  const bool converged = options.tolerance > 0 ? solve_to_tolerance(run, options, out, solution)
                                               : solve_on_mesh(run, options, out, solution);
  run.record["solution"] = describe(solution, run.room);
  if (!run.room.receivers.empty()) {
    run.record["extended_ambient_term"] = describe_ambient_term(run.room, solution);
  }
  if (run.room.view || !run.room.paint.empty()) {
    run.record["viewing"] = Json::array();
    for (std::size_t v = 0; v < run.transport.viewed.size(); ++v) {
      run.record["viewing"].push_back(
          describe(view_of(run, solution, v), run.room, run.transport.viewed[v].at));
    }
  }
  const SolutionColumns columns = columns_of(run.room.grid);
  const auto fine =
      gathered(run, columns, [&] { return solver::fine_light(run.room, run.transport, solution); });
  return report(run, columns, solution, converged, fine, out);
}

Exit solve_room(const SolveCommand& command, const Session& session) {
  const RunResult result = command.colour
                               ? run_solve_colour(command, *command.colour, session)
                               : run_solve(command.room, command.options, command.out, session);
  return print_result(result, session);
}

}  // namespace apps
