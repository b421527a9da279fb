#pragma once
#include <cstddef>
#include <vector>

#include "solver/exchange/exchange_areas.h"
#include "solver/exchange/facing_table.h"
#include "solver/factors/far_field.h"
#include "solver/factors/slope_moments.h"
#include "solver/obstacles/visibility.h"

namespace solver {

/// Two patches between which something hides a part of the light.
struct PartialPair {
  std::size_t i = 0, j = 0;
  double share = 1;  ///< of A_i F_ij that gets past, as it was multiplied by
  int rays = 0;      ///< it was found with at most
};

/// Fills the moments of 64 x 64 pairs, blocks `row` and `column` of patches, of a matrix whose
/// means are there: entry (a n + i, b n + j) gets <psi_a, K psi_b>, n patches.
class SlopeAssembly {
 public:
  SlopeAssembly(const std::vector<Facet>& facets, const SlopeMoments& slopes,
                const FacingTable& facing, const Visibility& visibility)
      : facets_(facets),
        slopes_(slopes),
        facing_(facing),
        visibility_(visibility),
        far_(facets, slopes.bases()) {}

  /// @param partial  the pairs of these blocks that something hides in part, by i, then j
  void fill(int row, int column, const std::vector<PartialPair>& partial,
            SymmetricTiles& tiles) const;

 private:
  [[nodiscard]] Eigen::Matrix3d hidden(const PartialPair& pair) const;

  const std::vector<Facet>& facets_;
  const SlopeMoments& slopes_;
  const FacingTable& facing_;
  const Visibility& visibility_;
  FarField far_;
};

}  // namespace solver
