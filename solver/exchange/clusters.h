#pragma once
#include <Eigen/Core>
#include <vector>

#include "scenes/mesh/patch_mesh.h"
#include "solver/exchange/exchange_areas.h"

namespace solver {

/// Neighbouring patches of one surface in one cluster, some 64 clusters or a few more; empty if the
/// room has so many surfaces that clusters would not pay.
[[nodiscard]] std::vector<int> cluster_patches(const scenes::PatchMesh& mesh);

/// A_i F_ij summed over the pairs of two clusters, m^2.
[[nodiscard]] Eigen::MatrixXd exchange_between(const std::vector<int>& cluster,
                                               const ExchangeAreas& exchange);

}  // namespace solver
