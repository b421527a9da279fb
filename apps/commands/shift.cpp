#include <fmt/format.h>

#include <fstream>

#include "apps/commands/commands.h"
#include "apps/pictures/model_spread_picture.h"
#include "apps/reports/colour_reports.h"
#include "apps/reports/model_spread_report.h"
#include "apps/studies/model_spread.h"
#include "apps/studies/paint_wish.h"
#include "apps/studies/painted_room.h"
#include "apps/studies/surface_views.h"

namespace apps {
namespace {

/// What the room file calls the paint of a surface; the surface's own name where it names none.
std::string paint_of(const Json& room_file, const scenes::Surface& surface) {
  const Json& surfaces = room_file["surfaces"];
  const std::string key = surfaces.contains(surface.name) ? surface.name : "walls";
  const Json reflectance = surfaces.value(key, Json());
  return reflectance.is_object() ? reflectance.value("paint", surface.name) : surface.name;
}

/// The swatch of a painted surface, held as its group's target is: "here" is before the surface.
appearance::SwatchCondition swatch_for(const RoomRun& run, int surface,
                                       const spectra::ViewingChoices& viewing,
                                       const spectra::ViewedLight& here) {
  const int group = scenes::paint_group(run.room, surface);
  const auto& target = run.room.paint[static_cast<std::size_t>(group)].target;
  return target ? swatch_of(run, *target, viewing, here) : appearance::standard_swatch();
}

/// Each surface under every choice of the model, and how far it is from its own swatch.
ModelSpread spread_of(const RoomRun& run, const solver::RoomSolution& solution,
                      const std::vector<Shift>& shifts) {
  ModelSpread spread;
  for (std::size_t k = 0; k < shifts.size(); ++k) {
    const spectra::ViewedLight light =
        seeing(run, [&] { return solver::viewed_light(run.room, run.transport, solution, k); });
    const int surface = run.transport.viewed[k].at.surface;
    const spectra::Spectrum& reflectance = solution.reflectances[static_cast<std::size_t>(surface)];
    spread.choices = model_choices(run.room.viewing, [&](const auto& viewing) {
      const appearance::Correlates swatch =
          seen_on_swatch(reflectance, swatch_for(run, surface, viewing, light)).correlates;
      return swatch.status.all_defined() ? paints::target_of(swatch) : paints::Target{};
    });
    spread.rows.push_back(spread_row(
        run, shifts[k].surface, reflectance,
        {{.name = "", .weight = 1, .view = [&](const auto&) { return light; }}}, spread.choices));
  }
  return spread;
}

}  // namespace

Exit shift_room(const RoomCommand& command, const Session& session) {
  const std::filesystem::path out = command.out;
  RoomRun run = open_room(command.room, "shift", to_json(command.options), session);
  if (run.room.paint.empty()) {
    throw room_fault(run, "/paint", "is missing, and shift needs it",
                     "name the surfaces, e.g. { \"surfaces\": [\"walls\"] }");
  }
  std::vector<solver::ViewedPoint> views;
  for (const scenes::PaintTask& group : run.room.paint) {
    for (const int surface : group.surfaces) views.push_back(view_on(run, surface));
  }
  prepare(run, command.options, out, views);
  const solver::RoomSolution solution =
      solver::solve_room(run.room, run.transport, command.options.radiosity);
  run.clock.stop("solve");
  run.record["solution"] = describe(solution, run.room);

  std::ifstream file(command.room);
  const Json room_file = Json::parse(file);
  std::vector<Shift> shifts;
  run.record["viewing"] = Json::array();
  for (std::size_t k = 0; k < views.size(); ++k) {
    const auto& surface = run.room.surfaces[static_cast<std::size_t>(views[k].surface)];
    const appearance::RoomView view = view_of(run, solution, k);
    run.record["viewing"].push_back(describe(view, run.room, views[k]));
    tell_white(run, view);
    const appearance::SwatchCondition swatch = swatch_for(
        run, views[k].surface, run.room.viewing,
        seeing(run, [&] { return solver::viewed_light(run.room, run.transport, solution, k); }));
    shifts.push_back({.paint = paint_of(room_file, surface),
                      .surface = surface.name,
                      .reconstructed = surface.reconstructed,
                      .swatch = seen_on_swatch(surface.reflectance, swatch),
                      .room = seen_in_room(view)});
  }
  run.clock.stop("view");
  const ModelSpread spread = spread_of(run, solution, shifts);
  run.record["model_spread"] = describe(spread);

  std::vector<OutputFile> files = model_spread_files(out, run.room.name, spread);
  files.insert(files.begin(), {.path = out / "shift.csv", .text = shift_csv(shifts)});
  RunResult result = finish(run, solution.radiosity.converged, std::move(files), out);
  result.text =
      shift_table(shifts) + model_spread_text(spread, "\"" + shifts.front().surface + "\"");
  result.data = {{"status", result.record["status"]},
                 {"folder", out.string()},
                 {"shifts", shift_list(shifts)},
                 {"model_spread", run.record["model_spread"]}};
  return print_result(result, session);
}

}  // namespace apps
