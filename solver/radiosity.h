#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "solver/exchange.h"

namespace solver {

/// One row per patch, one column per band. In a spectral solve a band is one wavelength and the
/// unit is W m^-2 nm^-1; the solver itself never asks.
using Bands = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

enum class Method { conjugate_gradients, jacobi, gauss_seidel, progressive, direct };

[[nodiscard]] const char* to_string(Method method);

struct RadiosityOptions {
  Method method = Method::conjugate_gradients;
  double relative_error =
      1e-6;                     ///< stop when a band's rms_error_bound <= this * its rms irradiance
  int max_iterations = 100000;  ///< sweeps over the matrix (progressive: shots / patches)
};

/// Per band. The bounds hold whatever the method and whether or not it converged, up to rounding in
/// double.
struct BandReport {
  int iterations = 0;          ///< sweeps over the matrix; 0 in a band without light
  double rms_error_bound = 0;  ///< on the area-weighted RMS over patches of H - H_exact
  double max_error_bound = 0;  ///< on max |H - H_exact| over patches
  /// On ||sqrt(A) (B - B_exact)||_2: times sqrt(sum_j F_pj^2 / A_j) it bounds what a receiver p
  /// gathers wrongly.
  double norm_error_bound = 0;
  bool converged = true;
};

struct RadiositySolution {
  Bands radiosity;   ///< B = S + rho H, leaving each patch
  Bands irradiance;  ///< H = F B + D, arriving at each patch
  std::vector<BandReport> bands;
  bool converged = false;  ///< all bands, in a room that closes
};

/// Solves H = F B + D, B = S + rho H for Lambertian patches in all bands at once [Goral1984]. S and
/// D (patch x band) are what a patch emits and its direct irradiance from sources that are no
/// patches.
///
/// Error bounds: let B be the last radiosities, H = F B + D gathered from them in double, B' = S +
/// rho H. In the norm ||x|| = ||sqrt(A) x||_2 the operators F and rho F have norms 1 and rho_max (F
/// is similar to a symmetric matrix whose rows sum to 1), and (1 - rho F)(B - B_exact) = B - B',
/// hence ||B - B_exact|| <= ||B - B'|| / (1 - rho_max).
/// @throws std::invalid_argument  if sizes differ, a value is not finite or negative, or rho is not
/// in [0, 1)
[[nodiscard]] RadiositySolution solve_radiosity(const ExchangeAreas& exchange,
                                                const Bands& emission, const Bands& direct,
                                                const Bands& reflectance,
                                                const RadiosityOptions& options = {});

/// F v in double, patch x band.
[[nodiscard]] Bands gather(const ExchangeAreas& exchange, const Bands& v);

}  // namespace solver
