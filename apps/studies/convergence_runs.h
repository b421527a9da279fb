#pragma once
#include "apps/run/room_run.h"
#include "apps/studies/band_groups.h"
#include "apps/studies/convergence_log.h"

namespace apps {

/// The experiment: one factor at a time from a baseline, which stays in run.transport.
/// @throws spectra::InputError, solver::TooLarge
[[nodiscard]] Convergence measure_convergence(RoomRun& run, const ConvergenceOptions& options);

/// All surfaces at one reflectance, from 0.5 to 0.9999, on a coarse mesh and in one band: there a
/// closed form knows the mean irradiance, flux / (A (1 - rho)).
void sweep_reflectance(const PreparedRoom& coarse, ConvergenceLog& log);

}  // namespace apps
