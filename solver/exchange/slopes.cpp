#include "solver/exchange/slopes.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace solver {

using Eigen::Matrix3d;

Matrix3d SlopeAssembly::hidden(const PartialPair& pair) const {
  const std::uint64_t seed = static_cast<std::uint64_t>(pair.i) << 32U | pair.j;
  return visibility_.hidden_moments(
      facets_[pair.i], slopes_.bases()[pair.i], visibility_.separation(static_cast<int>(pair.i)),
      facets_[pair.j], slopes_.bases()[pair.j], visibility_.separation(static_cast<int>(pair.j)),
      seed, pair.rays);
}

/// The exchange area is believed: moments are those of a rule times what the area is of the rule's.
void SlopeAssembly::fill(int row, int column, const std::vector<PartialPair>& partial,
                         SymmetricTiles& tiles) const {
  constexpr std::size_t kBlock = kFarPatches;
  const std::size_t n = facets_.size(), first_j = static_cast<std::size_t>(column) * kBlock;
  const std::size_t first_i = static_cast<std::size_t>(row) * kBlock;
  const std::size_t last_i = std::min(first_i + kBlock, n), last_j = std::min(first_j + kBlock, n);
  auto next_partial = partial.begin();
  FarRow far_row;
  FarField::Moments far_moments;
  for (std::size_t i = first_i; i < last_i; ++i) {
    far_.start(i, first_j, far_row);
    std::array<int, kBlock> order{};
    std::array<float, kBlock> exchange_area_m2{};
    for (std::size_t j = std::max(first_j, row == column ? i + 1 : 0); j < last_j; ++j) {
      const std::size_t k = j - first_j;
      exchange_area_m2[k] = tiles.at(static_cast<int>(i), static_cast<int>(j));
      if (exchange_area_m2[k] > 0 && facing_.relation(i, j) == FacingTable::Pair::facing &&
          far_.has_rule(i) && far_.has_rule(j)) {
        order[k] = slope_order(far_row.distance_over_size[k]);
      }
    }
    far_.moments(far_row, order, far_moments);
    for (std::size_t k = 0; k < kBlock; ++k) {
      if (!(exchange_area_m2[k] > 0)) continue;
      const std::size_t j = first_j + k;
      Matrix3d m;
      if (order[k] > 0) {
        for (std::size_t e = 0; e < 9; ++e) {
          m(static_cast<Eigen::Index>(e / 3), static_cast<Eigen::Index>(e % 3)) = far_moments[e][k];
        }
      } else {
        m = slopes_.near(i, j);
      }
      double whole_m2 = static_cast<double>(exchange_area_m2[k]);
      const bool in_part =
          next_partial != partial.end() && next_partial->i == i && next_partial->j == j;
      if (in_part) whole_m2 /= next_partial->share;
      m *= m(0, 0) > 0 ? whole_m2 / m(0, 0) : 0;
      if (in_part) m -= whole_m2 * hidden(*next_partial++);
      for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t b = a == 0 ? 1 : 0; b < 3; ++b) {
          tiles.set(
              static_cast<int>(a * n + i), static_cast<int>(b * n + j),
              static_cast<float>(m(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b))));
        }
      }
    }
  }
}

}  // namespace solver
