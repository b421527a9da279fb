#pragma once
#include <string>

#include "apps/studies/convergence_log.h"

namespace apps {

/// A row per run.
[[nodiscard]] std::string convergence_csv(const Convergence& convergence);

/// For run.json and stdout.
[[nodiscard]] Json describe(const Convergence& convergence);

/// In plain language: what to use for which error.
[[nodiscard]] std::string convergence_summary(const Convergence& convergence);

/// Work and precision, factor by factor and method by method.
[[nodiscard]] std::string work_precision_picture(const Convergence& convergence);

/// Iterations and error of each method against 1 - rho.
[[nodiscard]] std::string iterations_picture(const Convergence& convergence);

/// "patch_m 0.25, cg to 1e-06, 64 rays, 31 bands"
[[nodiscard]] std::string settings_of(const ConvergenceRun& run);

/// Runs are repeated and timed like this, in words.
[[nodiscard]] std::string timing_rule();

}  // namespace apps
