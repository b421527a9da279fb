#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "scenes/mesh/patch_mesh.h"
#include "solver/exchange/exchange_areas.h"
#include "solver/factors/facet.h"
#include "solver/obstacles/visibility.h"

namespace solver {

struct ExchangeOptions {
  std::vector<bool> lamp;  ///< patches that shine get `lamp_rays`; empty: none
  int rays = 64;           ///< for a pair of which the first 16 rays disagree
  int lamp_rays = 256;
  bool skip = true;  ///< false: pairs that turn their backs are computed too, to 0
};

[[nodiscard]] ExchangeAreas compute_exchange(const scenes::PatchMesh& mesh,
                                             const Visibility& visibility,
                                             const ExchangeOptions& options = {});

/// From a symmetric matrix of exchange areas, m^2: rounded to float, then closed.
/// @throws std::invalid_argument  if it is not square, symmetric and non-negative, or an area is
/// not positive
[[nodiscard]] ExchangeAreas close_exchange(const Eigen::MatrixXd& exchange_area_m2,
                                           const Eigen::ArrayXd& area_m2);

[[nodiscard]] std::vector<Facet> facets_of(const scenes::PatchMesh& mesh);

}  // namespace solver
