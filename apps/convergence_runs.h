#pragma once
#include "apps/band_groups.h"
#include "apps/convergence_log.h"
#include "apps/room_run.h"

namespace apps {

/// The experiment: one factor at a time from a baseline, which stays in run.transport.
/// @throws spectra::InputError, solver::TooLarge
[[nodiscard]] Convergence measure_convergence(RoomRun& run, const ConvergenceOptions& options);

/// All surfaces at one reflectance, from 0.5 to 0.9999, on a coarse mesh and in one band: there a
/// closed form knows the mean irradiance, flux / (A (1 - rho)).
void sweep_reflectance(const PreparedRoom& coarse, ConvergenceLog& log);

}  // namespace apps
