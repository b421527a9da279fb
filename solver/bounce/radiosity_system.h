#pragma once
#include <Eigen/Core>

#include "solver/bounce/reflector.h"
#include "solver/exchange/exchange_areas.h"

namespace solver {

/// Conjugate gradients, progressive and direct need numbers of 0 or more; Jacobi, Gauss-Seidel and
/// BiCGSTAB take any reflector.
enum class Method {
  automatic,  ///< conjugate gradients where they apply, else BiCGSTAB
  conjugate_gradients,
  jacobi,
  gauss_seidel,
  progressive,
  direct,
  bicgstab
};

[[nodiscard]] const char* to_string(Method method);

/// What `automatic` stands for, or the method itself.
[[nodiscard]] Method method_for(const Reflector& reflector, Method wished);

struct RadiosityOptions {
  Method method = Method::automatic;
  double relative_error =
      1e-6;                     ///< stop when a band's rms_error_bound <= this * its rms irradiance
  int max_iterations = 100000;  ///< sweeps over the matrix (progressive: shots / patches)
  bool skip = true;  ///< false: bands without light, and bands that repeat another, are solved too
  /// Progressive: its answer has the light that is still unshot too, as far as that can be told
  /// without form factors [Cohen1988].
  bool ambient = false;
  /// Progressive: a patch also shoots what it is so expected to get [Feda1992] [Gortler1994].
  bool overshoot = false;
};

/// Closure defect up to which F has the norm that the bounds assume.
inline constexpr double kClosed = 1e-9;

/// A checked system of bands that all carry light, and the certificate every method stops by.
struct RadiositySystem {
  const ExchangeAreas& exchange;
  Bands emission, direct;
  Reflector reflector;
  Eigen::ArrayXd contraction;  ///< norm of R F per band, proven or estimated

  [[nodiscard]] Eigen::Index rows() const { return emission.rows(); }

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

}  // namespace solver
