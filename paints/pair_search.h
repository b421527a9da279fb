#pragma once
#include <vector>

#include "paints/search_space.h"

namespace paints {

struct PairSearch {
  std::vector<Candidate> nearest;  ///< of all bases and pairs, fitted; nearest first
  std::int64_t pairs = 0, fitted = 0;

  /// Appearances that triples share: of base i, and of the pair i < j at shares 1/4, 1/2, 3/4 of j.
  std::vector<Eigen::Vector3d> single;
  std::vector<std::array<Eigen::Vector3f, 3>> quarters;

  /// Where the pair stands in `quarters`.
  [[nodiscard]] std::size_t index(int first, int second) const;
};

/// Every base and every pair: 17 mixtures of each, then the best parts of the `most` that come
/// nearest, and of every other pair that the bound does not exclude from being the nearest of all.
/// @param most         0: no pairs at all
/// @param for_triples  fill `quarters`
[[nodiscard]] PairSearch search_pairs(const SearchSpace& space, std::size_t most, bool for_triples);

}  // namespace paints
