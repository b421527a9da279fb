#include <fmt/format.h>

#include "apps/commands.h"
#include "apps/room_reports.h"
#include "apps/room_run.h"
#include "apps/terminal.h"

namespace apps {
namespace {

std::string receiver_table(const scenes::Room& room, const solver::RoomSolution& solution) {
  std::vector<std::vector<std::string>> rows{{"receiver", "illuminance"}};
  for (std::size_t i = 0; i < room.receivers.size(); ++i) {
    rows.push_back({room.receivers[i].name,
                    fmt::format("{:.1f} lx", illuminance_lx(room, solution.receivers[i]))});
  }
  return table("<>", rows);
}

Json receiver_list(const scenes::Room& room, const solver::RoomSolution& solution) {
  Json receivers = Json::array();
  for (std::size_t i = 0; i < room.receivers.size(); ++i) {
    receivers.push_back({{"receiver", room.receivers[i].name},
                         {"illuminance_lx", illuminance_lx(room, solution.receivers[i])}});
  }
  return receivers;
}

}  // namespace

RunResult run_solve(const std::string& path, const RoomOptions& options,
                    const std::filesystem::path& out, const Session& session) {
  RoomRun run = open_room(path, "solve", to_json(options), session);
  prepare(run, options, out);
  const solver::RoomSolution solution =
      solver::solve_room(run.room, run.transport, options.radiosity);
  run.clock.stop("solve");
  run.record["solution"] = describe(solution, run.room);
  if (run.room.view || !run.room.paint.empty()) {
    run.record["viewing"] = Json::array();
    for (std::size_t v = 0; v < run.transport.viewed.size(); ++v) {
      run.record["viewing"].push_back(
          describe(view_of(run, solution, v), run.room, run.transport.viewed[v].at));
    }
  }

  const auto& radiosity = solution.radiosity;
  RunResult result = finish(
      run, radiosity.converged,
      {{.path = out / "receivers.csv", .text = receivers_csv(run.room, solution)},
       {.path = out / "patches.csv", .text = patches_csv(run.room, run.transport.mesh, radiosity)}},
      out);
  result.text = receiver_table(run.room, solution);
  result.data = {{"status", result.record["status"]},
                 {"folder", out.string()},
                 {"receivers", receiver_list(run.room, solution)}};
  return result;
}

Exit solve_room(const RoomCommand& command, const Session& session) {
  return print_result(run_solve(command.room, command.options, command.out, session), session);
}

}  // namespace apps
