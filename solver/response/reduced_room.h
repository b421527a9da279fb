#pragma once
#include <Eigen/Core>
#include <vector>

#include "solver/exchange/exchange.h"
#include "solver/response/painted_patches.h"

namespace solver {

struct ReductionOptions {
  double highest_reflectance = 0.999;  ///< of a paint
  double relative_error = 1e-6;        ///< of every output, aimed at and then measured
  double solver_error = 1e-12;         ///< of the solves that the basis is made of
  int most_solves = 30;                ///< of all bands, for each group and each independent light
};

/// A room seen through its outputs y, as a function of the paints' reflectances rho alone. In each
/// band
///   c = gamma + K R c,   y = y0 + Phi R c,   R = diag(rho of each basis vector's group):
/// a Galerkin projection of the irradiance of the painted patches, H = g + K R H, where K carries
/// light from painted patch to painted patch, over all others. The basis holds each group's part of
/// solved irradiances; it is orthonormal by area, so that K is symmetric.
struct ReducedRoom {
  /// Bands with the same fixed reflectances share their K.
  struct Transfer {
    Eigen::MatrixXd k;       ///< n x n
    Eigen::MatrixXd phi;     ///< outputs x n
    std::vector<int> group;  ///< of each basis vector
  };

  struct Band {
    int transfer = 0;          ///< into `transfers`
    Eigen::MatrixXd gamma;     ///< n x lights
    Eigen::MatrixXd constant;  ///< y0, outputs x lights
  };

  std::vector<Transfer> transfers;
  std::vector<Band> bands;
  int groups = 1;
  double solves = 0;               ///< spent on the basis, in units of one solve of all bands
  double largest_error = 0;        ///< max over held-out solves of |y - y_solved| / |y_solved|
  int held_out = 0;                ///< solves of all bands that it was measured by
  double highest_reflectance = 0;  ///< up to which it was built
  bool converged = false;          ///< largest_error is within what was asked for

  /// Outputs x lights in one band. @param reflectance  of each group
  [[nodiscard]] Eigen::MatrixXd outputs(int band, const Eigen::VectorXd& reflectance) const;
};

/// Reduces by solves at the reflectances where the residual of what is known so far is largest, all
/// bands in step, until held-out solves agree. Bands whose light is a combination of the light of
/// others with the same fixed reflectances need no solve of their own.
/// @throws std::invalid_argument  if sizes differ or no patch is painted
[[nodiscard]] ReducedRoom reduce_room(const ExchangeAreas& exchange,
                                      const std::vector<SourceLight>& lights,
                                      const PaintedPatches& painted,
                                      const std::vector<OutputRow>& outputs,
                                      const ReductionOptions& options = {});

}  // namespace solver
