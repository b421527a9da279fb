#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "solver/bands.h"
#include "solver/exchange/tile_product.h"

namespace solver {

/// Exchange areas of a closed room, A_i F_ij = d_i X_ij d_j: X symmetric in float, d in double so
/// that every row sums to A_i. Symmetric scaling keeps reciprocity and is applied after X was
/// rounded.
///
/// Where light is linear on a patch, row a n + i stands for the function psi_a of patch i of n:
/// psi_0 = 1, so the first n rows are the patches' means; psi_1 and psi_2 are their slopes
/// (factors/slope_basis.h), and entries are <psi_a, K psi_b>. As <psi_a, psi_b> = A_i or 0, the
/// matrix F = A^-1 X is the same operator in these functions, and everything that solves with it
/// stays what it is. Light that is constant, and so arrives constant, closes the slopes' rows:
/// sum_j <psi_a, K 1_j> = 0. What is left of that is taken up by an exchange of each slope with the
/// mean of its own patch, symmetrically.
struct ExchangeAreas {
  SymmetricTiles unscaled;          ///< X, m^2
  Eigen::ArrayXd scaling;           ///< d, per row; 0 for patches that see nothing
  Eigen::ArrayXd area_m2;           ///< A, per row
  int modes = 1;                    ///< functions on a patch: 1, or 3 with slopes
  Eigen::ArrayXd slope_self_m2;     ///< per slope row: its exchange with its patch's mean; not in X
  double largest_slope_defect = 0;  ///< max |slope_self_m2 / A|: how much that had to mend
  int without_slopes = 0;  ///< patches on which light is constant all the same: see exchange.h
  Eigen::ArrayXd
      gather_norm;  ///< sqrt(sum_j F_ij^2 / A_j), 1/m: see error bounds in bounce/radiosity.h
  double closure_defect = 0;      ///< max_i |sum_j F_ij - 1| over patches that see something
  double reciprocity_defect = 0;  ///< max |A_i F_ij - A_j F_ji| / A_i over what is stored twice
  double largest_scaling = 0;     ///< max |d_i - 1|: how much closure had to mend
  double largest_self_view = 0;   ///< F_ii given to patches in gaps that scaling cannot close
  std::vector<int> isolated;      ///< patches that see nothing
  std::vector<int> cluster;       ///< of each patch, see clusters.h; empty: none
  Eigen::MatrixXd cluster_exchange_m2;  ///< A_i F_ij summed over the pairs of two clusters
  std::int64_t facing_pairs = 0;        ///< that exchange light if nothing is between
  std::int64_t tested_pairs = 0;        ///< of those, pairs for which rays were needed
  std::int64_t partial_pairs = 0;       ///< of those, partly hidden

  [[nodiscard]] int rows() const { return static_cast<int>(area_m2.size()); }

  [[nodiscard]] int patches() const { return rows() / modes; }

  [[nodiscard]] double total_area_m2() const { return area_m2.head(patches()).sum(); }

  /// F_ij of two rows
  [[nodiscard]] double form_factor(int i, int j) const;
};

/// F v in double, row x band.
[[nodiscard]] Bands gather(const ExchangeAreas& exchange, const Bands& v);

}  // namespace solver
