#pragma once
#include "solver/radiosity.h"

namespace solver {

/// Closure defect up to which F has norm 1, as the bounds assume.
inline constexpr double kClosed = 1e-9;

/// A checked system of bands that all carry light, and the certificate every method stops by.
struct RadiositySystem {
  const ExchangeAreas& exchange;
  Bands emission, direct;
  Reflector reflector;
  Eigen::ArrayXd contraction;  ///< norm of R F per band, proven or estimated

  [[nodiscard]] Eigen::Index patches() const { return emission.rows(); }

  [[nodiscard]] Eigen::Index bands() const { return emission.cols(); }
};

/// What one gather proves about radiosities B.
struct Certificate {
  Bands irradiance;     ///< H = F B + D
  Bands radiosity;      ///< B' = S + R H
  Bands change;         ///< B' - B
  Eigen::ArrayXd norm;  ///< bound on ||sqrt(A) (B - B_exact)||_2, per band
  Eigen::ArrayXd
      allowed;  ///< norm at which the band has converged: relative_error * ||sqrt(A) H||_2

  [[nodiscard]] bool converged() const { return (norm <= allowed).all(); }
};

[[nodiscard]] Certificate certify(const RadiositySystem& system, const Bands& radiosity,
                                  double relative_error);

/// The bound that a change B' - B, the residual of B, proves.
[[nodiscard]] Eigen::ArrayXd error_norms(const RadiositySystem& system, const Bands& change);

/// Each returns the certificate of its last radiosities and adds its sweeps to `iterations`.
struct MethodResult {
  Certificate certificate;
  Eigen::ArrayXi iterations;  ///< per band
};

[[nodiscard]] MethodResult lockstep_conjugate_gradients(const RadiositySystem& system,
                                                        const RadiosityOptions& options);
[[nodiscard]] MethodResult jacobi(const RadiositySystem& system, const RadiosityOptions& options);
[[nodiscard]] MethodResult gauss_seidel(const RadiositySystem& system,
                                        const RadiosityOptions& options);
[[nodiscard]] MethodResult progressive(const RadiositySystem& system,
                                       const RadiosityOptions& options);
[[nodiscard]] MethodResult direct(const RadiositySystem& system, const RadiosityOptions& options);
[[nodiscard]] MethodResult bicgstab(const RadiositySystem& system, const RadiosityOptions& options);

}  // namespace solver
