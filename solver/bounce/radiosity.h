#pragma once
#include <Eigen/Core>
#include <vector>

#include "solver/bounce/radiosity_system.h"

namespace solver {

/// Per band. The bounds hold whatever the method and whether or not it converged, up to rounding in
/// double; unless RadiositySolution::proven they are estimates.
struct BandReport {
  int iterations = 0;          ///< sweeps over the matrix; 0 in a band without light
  double rms_error_bound = 0;  ///< on the area-weighted RMS over patches of H - H_exact
  double max_error_bound = 0;  ///< on max |H - H_exact| over patches
  /// On ||sqrt(A) (B - B_exact)||_2: times sqrt(sum_j F_pj^2 / A_j) it bounds what a receiver p
  /// gathers wrongly.
  double norm_error_bound = 0;
  double contraction = 0;  ///< what a bounce leaves of light: the norm of R F, or its estimate
  bool converged = true;
};

struct RadiositySolution {
  Bands radiosity;   ///< B = S + rho H, leaving each patch
  Bands irradiance;  ///< H = F B + D, arriving at each patch
  std::vector<BandReport> bands;
  Method method = Method::automatic;  ///< that was used
  bool proven = true;                 ///< bounds are proven, not estimated
  bool converged = false;             ///< all bands, in a room that closes
};

/// Solves H = F B + D, B = S + rho H for Lambertian patches in all bands at once [Goral1984]. S and
/// D (patch x band) are what a patch emits and its direct irradiance from sources that are no
/// patches; with linear light a row each per function of a patch (ExchangeAreas), means first.
///
/// Error bounds: let B be the last radiosities, H = F B + D gathered from them in double, B' = S +
/// rho H. In the norm ||x|| = ||sqrt(A) x||_2 the operators F and rho F have norms 1 and rho_max (F
/// is similar to a symmetric matrix whose rows sum to 1), and (1 - rho F)(B - B_exact) = B - B',
/// hence ||B - B_exact|| <= ||B - B'|| / (1 - rho_max). With linear light F has negative entries;
/// that its norm is 1 is then estimated (compute_exchange), so bounds are not proven.
/// @throws std::invalid_argument  if sizes differ, a value is not finite or negative, or rho is not
/// in [0, 1), or the method does not suit reflector or options
[[nodiscard]] RadiositySolution solve_radiosity(const ExchangeAreas& exchange,
                                                const Bands& emission, const Bands& direct,
                                                const Bands& reflectance,
                                                const RadiosityOptions& options = {});

/// The same for any reflector; light and reflectance may be negative, as three numbers for a
/// spectrum sometimes are. Bands that a matrix couples are one system: they converge together,
/// relative to the light in all of them.
///
/// Error bounds: as above with the reflector's norm and contraction in place of rho_max. Where the
/// contraction is not below 1, light may grow from bounce to bounce. Then its growth is estimated
/// by following 60 bounces. Below 1 it takes the place of the contraction, and bounds are no longer
/// proven; from 1 on there is no answer: the solution is the first bounce, never converged, its
/// bounds infinite.
/// @throws std::invalid_argument  if sizes differ, a value is not finite, or the method does not
/// suit
[[nodiscard]] RadiositySolution solve_radiosity(const ExchangeAreas& exchange,
                                                const Bands& emission, const Bands& direct,
                                                const Reflector& reflector,
                                                const RadiosityOptions& options = {});

}  // namespace solver
