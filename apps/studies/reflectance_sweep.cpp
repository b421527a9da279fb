#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <string>

#include "apps/studies/band_groups.h"
#include "apps/studies/convergence_runs.h"
#include "apps/studies/convergence_timing.h"
#include "apps/studies/solver_methods.h"

namespace apps {
namespace {

constexpr std::array kOneMinusRho{0.5, 0.1, 0.01, 0.001, 0.0001};
constexpr double kSweepError = 1e-6;
constexpr int kMostSweeps = 20000;

/// The light on all patches, as one point.
RoomAnswer patches_of(const solver::RoomSolution& solution) {
  return {.irradiance = {solution.radiosity.irradiance.col(0)}, .jab = {}, .paint_distance = {}};
}

/// The closed form of the area's mean irradiance against what was solved.
double mean_error(const solver::RoomSolution& solution, const Eigen::ArrayXd& area_m2,
                  double one_minus_rho) {
  const double flux = solution.energy.emitted[0];
  const double received =
      (area_m2 * solution.radiosity.irradiance.col(0).head(area_m2.size())).sum();
  return std::abs(received * one_minus_rho / flux - 1);
}

ConvergenceRun run_of(const SolverMethod& method, const PreparedRoom& grey, double one_minus_rho,
                      const RoomAnswer& exact) {
  const Timed<solver::RoomSolution> solved = timed(
      [&] {
        return method.solve(grey.room, grey.transport,
                            {.relative_error = kSweepError, .max_iterations = kMostSweeps});
      },
      1);
  const solver::BandReport& band = solved.value.radiosity.bands.front();
  const double off =
      mean_error(solved.value, grey.transport.exchange.area_m2.head(grey.transport.mesh.size()),
                 one_minus_rho);
  return {.factor = "reflectance",
          .method = method.name,
          .setting = fmt::format("{:g}", 1 - one_minus_rho),
          .patch_m = 0,
          .patches = grey.transport.mesh.size(),
          .bands = 1,
          .relative_error = kSweepError,
          .iterations = band.iterations,
          .converged = solved.value.radiosity.converged,
          .repeats = solved.repeats,
          .solve_s = solved.seconds,
          .errors = {.max_relative = off, .rms_relative = off},
          .own = errors_of(patches_of(solved.value), exact),
          .one_minus_rho = one_minus_rho,
          .quantity = "mean irradiance",
          .reference = "closed form: flux / (A (1 - rho))"};
}

}  // namespace

void sweep_reflectance(const PreparedRoom& coarse, ConvergenceLog& log) {
  if (!coarse.transport.exchange.isolated.empty()) {
    log.leave_out("the sweep of reflectances",
                  "some patches see nothing, and the closed form takes all of them");
    return;
  }
  PreparedRoom grey = coarse;
  std::map<std::string, double> expected;  // iterations, by method: they grow as 1 / (1 - rho)
  double last = kOneMinusRho.front();
  for (const double one_minus_rho : kOneMinusRho) {
    for (scenes::Surface& surface : grey.room.surfaces) {
      surface.reflectance.values.setConstant(1 - one_minus_rho);
    }
    const RoomAnswer exact = patches_of(solver::solve_room(
        grey.room, grey.transport, {.method = solver::Method::direct, .relative_error = 1e-12}));
    for (const SolverMethod& method : solver_methods()) {
      const std::string what =
          fmt::format("{} at reflectance {:g}", method.name, 1 - one_minus_rho);
      double& iterations = expected[method.name];
      iterations *= last / one_minus_rho;
      if (iterations > 1.5 * kMostSweeps) {
        log.leave_out(what, fmt::format("about {:.1g} sweeps would be needed", iterations));
      } else if (log.may_start(what)) {
        log.add(run_of(method, grey, one_minus_rho, exact));
        iterations = log.result().runs.back().iterations;
      }
    }
    last = one_minus_rho;
  }
}

}  // namespace apps
