#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "scenes/mesh/patch_mesh.h"
#include "solver/exchange/exchange_areas.h"
#include "solver/factors/facet.h"
#include "solver/factors/slope_moments.h"
#include "solver/obstacles/visibility.h"

namespace solver {

struct ExchangeOptions {
  std::vector<bool> lamp;  ///< patches that shine get `lamp_rays`; empty: none
  int rays = 64;           ///< for a pair of which the first 16 rays disagree
  int lamp_rays = 256;
  bool skip = true;  ///< false: pairs that turn their backs are computed too, to 0
  /// Of the mesh's facets: light is linear on a patch. None: it is constant.
  const SlopeMoments* slopes = nullptr;
};

/// With slopes F has negative entries, so that its norm 1 in ||sqrt(A) x||_2 does not follow from
/// its rows. It is estimated, and light is made constant on patches deep in slots and where a
/// pattern of light would grow from bounce to bounce.
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
