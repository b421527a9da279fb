#pragma once
#include <vector>

#include "solver/rooms/room_light.h"

namespace solver {

/// What patches of length h leave of a quantity y: |y_h - y_2h| or |y_2h - y_4h| / g, the larger,
/// over g - 1. It covers an error that falls by g from patches twice as long: g is 2 for constant
/// light, where in the box of solver/README.md it falls faster, as h^1.3 to h^2, and 3 for linear
/// light, where it falls as h^2 to h^4 away from edges. An estimate, no bound.
/// @param step    y_h - y_2h
/// @param before  y_2h - y_4h
[[nodiscard]] double left_by_mesh(double step, double before, Light light);

/// Solves the room twice more, on patches two and four times as long, and tells every receiver and
/// viewed point of `solution` what its mesh leaves. Costs a fifteenth of a large solve.
/// @param transport    as for `solution`
/// @param patch_m      of the patches that were solved
/// @param extrapolate  move the irradiance of points by (E_h - E_2h) / 3, towards patches of no
///                     size (Richardson, order 2); the error stays what it was without
/// @return false if longer patches cut the room no other way: then nothing is told
bool study_mesh(const scenes::Room& room, const TransportOptions& transport,
                const RadiosityOptions& radiosity, double patch_m, bool extrapolate,
                RoomSolution& solution);

/// Largest relative errors of a solve, over receivers and viewed points.
struct PointErrors {
  double mesh = 0, solver = 0;

  [[nodiscard]] double sum() const { return mesh + solver; }
};

struct ToleranceStep {
  double patch_m = 0;
  int patches = 0;
  PointErrors error;
};

struct ToleranceSolution {
  RoomTransport transport;
  RoomSolution solution;
  std::vector<ToleranceStep> steps;  ///< the meshes that were tried, the last is the solution's
  double relative_error = 0;         ///< chosen for the solver
  int rays = 0;                      ///< chosen for a pair of patches that something hides in part
  bool reached = false;
};

/// Chooses solver tolerance, rays and patch size so that the errors of every receiver and viewed
/// point add up to at most `tolerance`, relative to its strongest band. Patches shrink as the
/// error that is left asks for, until they do not fit.
/// @param transport  patch_m is chosen here, and more rays where tolerance is below 2e-3; what rays
/// leave
///     shows in the mesh's error, as every mesh has its own
/// @throws std::invalid_argument  unless 0 < tolerance < 1
/// @throws TooLarge  if not even the first mesh fits
[[nodiscard]] ToleranceSolution solve_to_tolerance(const scenes::Room& room, double tolerance,
                                                   TransportOptions transport,
                                                   RadiosityOptions radiosity);

}  // namespace solver
