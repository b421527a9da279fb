#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "solver/exchange.h"

namespace solver {

/// One row per patch, one column per band. In a spectral solve a band is one wavelength and the
/// unit is W m^-2 nm^-1; the solver itself never asks.
using Bands = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

enum class Method { conjugate_gradients, jacobi, gauss_seidel, progressive, direct };

[[nodiscard]] const char* to_string(Method method);

struct RadiosityOptions {
  Method method = Method::conjugate_gradients;
  double relative_error = 1e-6;  ///< stop when a band's rms_error_bound <= this * rms irradiance
  int max_iterations = 100000;   ///< sweeps over the matrix (progressive: shots / patches)
};

/// Per band. The bounds hold whatever the method and whether or not it converged, up to rounding.
struct BandReport {
  int iterations = 0;
  double rms_error_bound = 0;  ///< on the area-weighted RMS of H - H_exact
  double max_error_bound = 0;  ///< on max |H - H_exact| over patches
  bool converged = false;
};

struct RadiositySolution {
  Bands radiosity;   ///< B = S + rho H, leaving each patch
  Bands irradiance;  ///< H = F B + D, arriving at each patch
  std::vector<BandReport> bands;
  /// On ||sqrt(A) (B' - B_exact)||, B' being what was gathered: times a receiver's own gather norm
  /// it bounds that receiver's error.
  Eigen::ArrayXd norm_error_bound;
  bool converged = false;
};

/// Solves H = F B + D, B = S + rho H for Lambertian patches in all bands at once [Goral1984]. F
/// comes from the closed exchange areas, S and D (patch x band) are what a patch emits and its
/// direct irradiance from sources that are no patches.
/// @throws std::invalid_argument  if sizes differ, a value is not finite or negative, or rho is not
/// in [0, 1)
[[nodiscard]] RadiositySolution solve_radiosity(const ExchangeAreas& exchange,
                                                const Bands& emission, const Bands& direct,
                                                const Bands& reflectance,
                                                const RadiosityOptions& options = {});

}  // namespace solver
