#include <algorithm>
#include <array>
#include <chrono>
#include <stdexcept>

#include "apps/commands/commands.h"
#include "apps/reports/colour_reports.h"
#include "apps/reports/compare_report.h"
#include "apps/studies/surface_views.h"
#include "apps/system/terminal.h"

namespace apps {
namespace {

constexpr std::size_t kRepeats = 3;

/// A point of every surface that sends light on without being a lamp. What furniture hides is left
/// out, with a note.
std::vector<solver::ViewedPoint> views_of_surfaces(RoomRun& run) {
  std::vector<solver::ViewedPoint> views;
  if (run.room.view) (void)viewed_point(run);  // a bad view is a fault, not a surface left out
  for (int s = 0; s < static_cast<int>(run.room.surfaces.size()); ++s) {
    const scenes::Surface& surface = run.room.surfaces[static_cast<std::size_t>(s)];
    const bool lamp = (surface.exitance.values > 0).any();
    if (lamp || !(surface.reflectance.values > 0).any()) continue;
    try {
      views.push_back(view_on(run, s));
    } catch (const spectra::InputError&) {
      report_notes({surface.name + " cannot be looked at and is left out"});
    }
  }
  if (views.empty()) {
    throw room_fault(run, "/surfaces", "has no surface whose colour could be compared",
                     "give one a reflectance above 0");
  }
  return views;
}

MethodVerdict timed(const ColourMethod& method, const ComparedRoom& compared) {
  MethodVerdict verdict{.name = method.name, .what = method.what, .colours = {}, .surfaces = {}};
  std::array<double, kRepeats> seconds{};
  for (double& s : seconds) {
    const auto start = std::chrono::steady_clock::now();
    verdict.colours = method.solve(compared);
    s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  std::ranges::sort(seconds);
  verdict.seconds = seconds[kRepeats / 2];
  return verdict;
}

/// How the spectral answer looks: the eye of every surface.
std::vector<Eye> eyes_of(RoomRun& run, const std::vector<solver::ViewedPoint>& views,
                         const solver::RadiosityOptions& options) {
  const solver::RoomSolution solution = solver::solve_room(run.room, run.transport, options);
  run.record["solution"] = describe(solution, run.room);
  run.record["viewing"] = Json::array();
  std::vector<Eye> eyes;
  for (std::size_t k = 0; k < views.size(); ++k) {
    const appearance::RoomView view = view_of(run, solution, k);
    run.record["viewing"].push_back(describe(view, run.room, views[k]));
    try {
      eyes.push_back(eye_of(view));
    } catch (const std::domain_error& error) {
      throw room_fault(run, "/lights", error.what(), "give light that the eye can adapt to");
    }
  }
  return eyes;
}

}  // namespace

Exit compare_room(const RoomCommand& command, const Session& session) {
  const std::filesystem::path out = command.out;
  RoomRun run = open_room(command.room, "compare", to_json(command.options), session);
  const std::vector<solver::ViewedPoint> views = views_of_surfaces(run);
  prepare(run, command.options, out, views);
  const std::vector<Eye> eyes = eyes_of(run, views, command.options.radiosity);
  run.clock.stop("view");

  Comparison comparison{.room = run.room.name, .patches = run.transport.mesh.size()};
  ComparedRoom compared{run.room, run.transport, {}, command.options.radiosity};
  for (const solver::ViewedPoint& at : views) {
    compared.surfaces.push_back(at.surface);
    comparison.surfaces.push_back(surface_name(run, at));
  }
  std::vector<ColourMethod> methods = judged_methods();
  methods.insert(methods.begin(), spectral_method());
  Progress progress("methods", static_cast<int>(methods.size()));
  for (const ColourMethod& method : methods) {
    MethodVerdict verdict = timed(method, compared);
    const auto& truth = comparison.methods.empty() ? verdict : comparison.methods.front();
    for (std::size_t k = 0; k < views.size(); ++k) {
      verdict.surfaces.push_back(judge(verdict.colours.sent[k], truth.colours.sent[k], eyes[k]));
    }
    comparison.methods.push_back(std::move(verdict));
    progress.step();
  }
  run.clock.stop("methods");

  run.record["repeats"] = kRepeats;
  run.record["methods"] = method_list(comparison);
  RunResult result = finish(run, comparison.methods.front().colours.converged,
                            {{.path = out / "compare.csv", .text = compare_csv(comparison)},
                             {.path = out / "methods.csv", .text = methods_csv(comparison)},
                             {.path = out / "summary.md", .text = summary(comparison)}},
                            out);
  result.text = method_table(comparison);
  result.data = {{"status", result.record["status"]},
                 {"folder", out.string()},
                 {"methods", result.record["methods"]}};
  return print_result(result, session);
}

}  // namespace apps
