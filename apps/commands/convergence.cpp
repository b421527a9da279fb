#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/commands/commands.h"
#include "apps/reports/convergence_report.h"
#include "apps/studies/convergence_runs.h"

namespace apps {

Exit measure_room(const ConvergenceCommand& command, const Session& session) {
  const std::filesystem::path out = command.out;
  const ConvergenceOptions& options = command.options;
  RoomRun run = open_room(command.room, "convergence",
                          {{"patch_m", options.patch_m > 0 ? Json(options.patch_m) : Json()},
                           {"seconds", options.seconds}},
                          session);
  require_writable(out);
  const Convergence convergence = measure_convergence(run, options);
  run.record["convergence"] = describe(convergence);
  const std::string summary = convergence_summary(convergence);
  RunResult result =
      finish(run, convergence.runs.front().converged,
             {{.path = out / "convergence.csv", .text = convergence_csv(convergence)},
              {.path = out / "convergence.svg", .text = work_precision_picture(convergence)},
              {.path = out / "iterations.svg", .text = iterations_picture(convergence)},
              {.path = out / "summary.txt", .text = summary}},
             out);
  result.text = summary;
  result.data = {{"status", result.record["status"]},
                 {"folder", out.string()},
                 {"convergence", result.record["convergence"]}};
  return print_result(result, session);
}

}  // namespace apps
