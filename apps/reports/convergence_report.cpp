#include "apps/reports/convergence_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/reports/csv.h"
#include "apps/studies/convergence_timing.h"

namespace apps {
namespace {

template <typename Value>
Json to_json(const std::optional<Value>& value) {
  return value ? Json(*value) : Json();
}

/// What does not belong to a run, as the patch size to the sweep, has no cell.
std::optional<double> unless_zero(double value) {
  return value > 0 ? std::optional(value) : std::nullopt;
}

Json describe(const ConvergenceRun& run) {
  return {{"factor", run.factor},
          {"method", run.method},
          {"setting", run.setting},
          {"patches", run.patches},
          {"iterations", run.iterations},
          {"converged", run.converged},
          {"repeats", run.repeats},
          {"setup_s", run.setup_s},
          {"solve_s", run.solve_s},
          {"max_relative_error", to_json(run.errors.max_relative)},
          {"own_max_relative_error", to_json(run.own.max_relative)},
          {"distance_Jab", to_json(run.errors.distance_jab)},
          {"kendall_tau", to_json(run.errors.kendall_tau)},
          {"top10_overlap", to_json(run.errors.top_overlap)},
          {"reference", run.reference}};
}

}  // namespace

std::string convergence_csv(const Convergence& convergence) {
  CsvText csv(
      "factor,method,setting,patches,iterations,setup_s,solve_s,max_relative_error,"
      "rms_relative_error,distance_Jab,kendall_tau,top10_overlap,reference,patch_m,bands,rays,"
      "relative_error,converged,repeats,own_max_relative_error,own_rms_relative_error,quantity");
  for (const ConvergenceRun& run : convergence.runs) {
    const AnswerErrors &all = run.errors, &own = run.own;
    csv.cell(run.factor).cell(run.method).cell(run.setting).cell(run.patches);
    csv.cell(run.iterations).cell(run.setup_s).cell(run.solve_s);
    csv.cell(all.max_relative).cell(all.rms_relative).cell(all.distance_jab).cell(all.kendall_tau);
    csv.cell(all.top_overlap ? std::optional<double>(*all.top_overlap) : std::nullopt);
    csv.cell(run.reference).cell(unless_zero(run.patch_m)).cell(run.bands);
    csv.cell(unless_zero(run.rays))
        .cell(unless_zero(run.relative_error))
        .cell(run.converged ? "yes" : "no");
    csv.cell(run.repeats).cell(own.max_relative).cell(own.rms_relative).cell(run.quantity);
    csv.end_row();
  }
  return csv.take();
}

Json describe(const Convergence& convergence) {
  Json runs = Json::array(), left_out = Json::array();
  for (const ConvergenceRun& run : convergence.runs) runs.push_back(describe(run));
  for (const auto& [what, why, saved] : convergence.left_out) {
    left_out.push_back({{"what", what}, {"why", why}});
  }
  return {{"baseline", settings_of(convergence.runs.front())},
          {"reference", convergence.reference},
          {"timing", timing_rule()},
          {"left_out", left_out},
          {"runs", runs}};
}

std::string settings_of(const ConvergenceRun& run) {
  if (run.method == kAmbientTerm) return run.method;
  std::string text = fmt::format("patch_m {:.3g}, {}", run.patch_m, run.method);
  if (run.method != "direct") text += fmt::format(" to {:g}", run.relative_error);
  return text + fmt::format(", {} rays, {} bands", run.rays, run.bands);
}

std::string timing_rule() {
  return fmt::format(
      "Seconds are medians of {} repeats, or of fewer where one took {:g} s; the column repeats "
      "tells.",
      kTimingRepeats, kLongEnough_s);
}

}  // namespace apps
