#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "solver/exchange/tile_product.h"

namespace solver {

/// Exchange areas of a closed room, A_i F_ij = d_i X_ij d_j: X symmetric in float, d in double so
/// that every row sums to A_i. Symmetric scaling keeps reciprocity and is applied after X was
/// rounded.
struct ExchangeAreas {
  SymmetricTiles unscaled;  ///< X, m^2
  Eigen::ArrayXd scaling;   ///< d; 0 for patches that see nothing
  Eigen::ArrayXd area_m2;   ///< A
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

  [[nodiscard]] int patches() const { return static_cast<int>(area_m2.size()); }

  /// F_ij
  [[nodiscard]] double form_factor(int i, int j) const;
};

}  // namespace solver
