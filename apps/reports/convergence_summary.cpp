#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "apps/reports/convergence_report.h"

namespace apps {
namespace {

using Runs = std::vector<const ConvergenceRun*>;

double total_s(const ConvergenceRun& run) { return run.setup_s + run.solve_s; }

std::string percent(double share) { return fmt::format("{:.2g} %", 100 * share); }

Runs chosen(const Convergence& convergence, const auto& belongs) {
  Runs runs;
  for (const ConvergenceRun& run : convergence.runs) {
    if (belongs(run)) runs.push_back(&run);
  }
  return runs;
}

/// Whole answers, judged by the reference.
bool is_whole(const ConvergenceRun& run) {
  return run.factor != "bands" && run.factor != "reflectance" && run.converged &&
         run.errors.max_relative;
}

std::string costs(const ConvergenceRun& run) {
  return fmt::format("{}: {:.2g} s, of which {:.2g} s set-up, {} patches; largest error {}",
                     settings_of(run), total_s(run), run.setup_s, run.patches,
                     percent(*run.errors.max_relative));
}

std::string advice(const Convergence& convergence) {
  const Runs runs = chosen(convergence, is_whole);
  std::string text;
  for (const double level : {0.1, 0.03, 0.01, 0.003, 0.001, 0.0003, 0.0001}) {
    const ConvergenceRun *best = nullptr, *nearest = nullptr;
    for (const ConvergenceRun* run : runs) {
      const double error = *run->errors.max_relative;
      if (error <= level && (best == nullptr || total_s(*run) < total_s(*best))) best = run;
      if (nearest == nullptr || error < *nearest->errors.max_relative) nearest = run;
    }
    if (best != nullptr) {
      text += fmt::format("  For {} use {}.\n", percent(level), costs(*best));
    } else if (nearest != nullptr) {
      return text + fmt::format("  For {} nothing that was tried is enough. Nearest: {}.\n",
                                percent(level), costs(*nearest));
    }
  }
  return text;
}

/// What the baseline's error is made of.
std::string shares(const Convergence& convergence) {
  const ConvergenceRun& baseline = convergence.runs.front();
  std::string text;
  if (baseline.errors.max_relative) {
    text +=
        fmt::format("  All together: largest {}, RMS {}.\n", percent(*baseline.errors.max_relative),
                    percent(*baseline.errors.rms_relative));
  }
  if (baseline.own.max_relative) {
    text +=
        fmt::format("  The solver's tolerance alone: {}.\n", percent(*baseline.own.max_relative));
  }
  for (const ConvergenceRun& run : convergence.runs) {
    const bool as_baseline = (run.factor == "rays" && run.rays == baseline.rays) ||
                             (run.factor == "bands" && run.bands == baseline.bands);
    if (!as_baseline || !run.own.max_relative) continue;
    text += fmt::format("  {} {} alone, against {}: {} in {}.\n", run.setting, run.factor,
                        run.factor == "rays" ? "most rays" : run.reference,
                        percent(*run.own.max_relative), run.quantity);
  }
  if (const auto& jab = baseline.errors.distance_jab) {
    text += fmt::format("  The viewed wall: {:.2g} off in J, a_C, b_C.\n", *jab);
  }
  if (baseline.errors.kendall_tau && baseline.errors.top_overlap) {
    text += fmt::format("  The ranking: Kendall's tau {:.4f}, {} of the best {} the same.\n",
                        *baseline.errors.kendall_tau, *baseline.errors.top_overlap, kTopPaints);
  }
  return text;
}

/// The loosest tolerance of each method whose own error is small enough.
std::string methods(const Convergence& convergence) {
  std::string text;
  for (const double level : {1e-3, 1e-6}) {
    Runs best;
    for (const ConvergenceRun& run : convergence.runs) {
      if (run.factor != "method" || !run.own.max_relative || *run.own.max_relative > level)
        continue;
      const auto same = std::ranges::find(best, run.method, &ConvergenceRun::method);
      if (same == best.end()) {
        best.push_back(&run);
      } else if (run.solve_s < (*same)->solve_s) {
        *same = &run;
      }
    }
    std::ranges::stable_sort(best, {}, &ConvergenceRun::solve_s);
    text += fmt::format("  To {} of the exact answer on this mesh:", percent(level));
    for (const ConvergenceRun* run : best) {
      text += fmt::format("{} {}{} {:.2g} s", run == best.front() ? "" : ",", run->method,
                          run->setting.empty() ? "" : fmt::format(" (to {})", run->setting),
                          run->solve_s);
    }
    text += best.empty() ? " none.\n" : ".\n";
  }
  for (const ConvergenceRun& run : convergence.runs) {
    if (run.method != kAmbientTerm || !run.errors.max_relative) continue;
    text += fmt::format("  The {}, without mesh and rays: {:.2g} s; off by {}, RMS {}.\n",
                        run.method, run.solve_s, percent(*run.errors.max_relative),
                        percent(*run.errors.rms_relative));
  }
  return text;
}

std::string bands(const Convergence& convergence) {
  std::string text;
  for (const ConvergenceRun* run :
       chosen(convergence, [](const ConvergenceRun& r) { return r.factor == "bands"; })) {
    if (!run->errors.max_relative) continue;
    text += fmt::format("  {} bands: {:.2g} s to solve; off by {} in X, Y, Z", run->bands,
                        run->solve_s, percent(*run->errors.max_relative));
    if (run->errors.distance_jab) {
      text += fmt::format(", by {:.2g} in J, a_C, b_C", *run->errors.distance_jab);
    }
    if (run->errors.kendall_tau) {
      text += fmt::format("; ranking: tau {:.4f}, {} of {}", *run->errors.kendall_tau,
                          *run->errors.top_overlap, kTopPaints);
    }
    text += fmt::format(" (against {}).\n", run->reference);
  }
  return text;
}

/// Iterations from the darkest to the brightest room.
std::string reflectances(const Convergence& convergence) {
  std::string text;
  const Runs sweep =
      chosen(convergence, [](const ConvergenceRun& run) { return run.factor == "reflectance"; });
  std::vector<std::string> names;
  for (const ConvergenceRun* run : sweep) {
    if (std::ranges::find(names, run->method) != names.end()) continue;
    names.push_back(run->method);
    text += fmt::format("  {}:", run->method);
    for (const ConvergenceRun* same : sweep) {
      if (same->method != run->method) continue;
      text += fmt::format(" {}{} at {};", same->iterations, same->converged ? "" : " (not done)",
                          same->setting);
    }
    text.back() = '\n';
  }
  return text;
}

std::string section(const std::string& title, const std::string& text) {
  return text.empty() ? "" : fmt::format("\n{}\n{}", title, text);
}

}  // namespace

std::string convergence_summary(const Convergence& convergence) {
  std::string left_out;
  for (const auto& [what, why, saved] : convergence.left_out) {
    left_out += fmt::format("  {}: {}.\n", what, why);
  }
  return fmt::format(
             "Error against run time: {}\n\nBaseline: {}.\nReference: {}.\n{}\nErrors are relative "
             "errors of the irradiance per band at the receivers and viewed points, the largest "
             "unless said otherwise.\n",
             convergence.room, settings_of(convergence.runs.front()), convergence.reference,
             timing_rule()) +
         section("What to use", advice(convergence)) +
         section("What the error of the baseline is made of", shares(convergence)) +
         section("Methods, time to solve", methods(convergence)) +
         section("Bands", bands(convergence)) +
         section(
             "Iterations to a proven 1e-6 with all surfaces at one reflectance, one band, "
             "coarse mesh",
             reflectances(convergence)) +
         section("Left out", left_out);
}

}  // namespace apps
