#include <fmt/format.h>

#include <fstream>

#include "apps/commands/commands.h"
#include "apps/reports/colour_reports.h"
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
    shifts.push_back({.paint = paint_of(room_file, surface),
                      .surface = surface.name,
                      .reconstructed = surface.reconstructed,
                      .swatch = seen_on_swatch(surface.reflectance),
                      .room = seen_in_room(view)});
  }
  run.clock.stop("view");

  RunResult result = finish(run, solution.radiosity.converged,
                            {{.path = out / "shift.csv", .text = shift_csv(shifts)}}, out);
  result.text = shift_table(shifts);
  result.data = {{"status", result.record["status"]},
                 {"folder", out.string()},
                 {"shifts", shift_list(shifts)}};
  return print_result(result, session);
}

}  // namespace apps
