#pragma once
#include <Eigen/Core>
#include <vector>

#include "solver/bounce/radiosity_system.h"

namespace solver {

/// The room with clusters for patches: small enough for a direct solve in every band, and it knows
/// the light that fades most slowly, which is even over large parts of a room.
///
/// With p_c = sqrt(rho A) on the patches of cluster c, scaled to norm 1, and M = I - r G r as in
/// lockstep_cg.cpp, M_c = P^T M P is the same operator over clusters: I - q X_c q, q = sqrt(mean
/// rho / area). (Exactly so where rho is constant in a cluster; else close to it, and still
/// symmetric with eigenvalues from 1 - rho_max up.)
class CoarseRoom {
 public:
  explicit CoarseRoom(const RadiositySystem& system);

  /// No clusters, or light that fades fast enough without.
  [[nodiscard]] bool empty() const { return inverse_.empty(); }

  [[nodiscard]] const std::vector<int>& cluster() const { return exchange_.cluster; }

  [[nodiscard]] Eigen::Index clusters() const { return exchange_.cluster_exchange_m2.rows(); }

  /// P: of each patch's mean in its own cluster, per band.
  [[nodiscard]] const Bands& weights() const { return weights_; }

  /// M_c^-1 of a band.
  [[nodiscard]] const Eigen::MatrixXd& inverse(Eigen::Index band) const {
    return inverse_[static_cast<std::size_t>(band)];
  }

  /// All later bounces of radiosities that the patches have just sent: irradiance, constant in a
  /// cluster; row x band.
  [[nodiscard]] Bands irradiance(const Bands& sent) const;

 private:
  const ExchangeAreas& exchange_;
  Eigen::ArrayXd area_m2_;  ///< of the clusters
  Bands q_;                 ///< cluster x band
  Bands weights_;
  std::vector<Eigen::MatrixXd> inverse_;
};

}  // namespace solver
