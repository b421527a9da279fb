#pragma once
#include <cstdint>
#include <vector>

#include "paints/pair_search.h"

namespace paints {

struct TripleSearch {
  std::vector<Candidate> nearer;  ///< fitted, those that were nearer than `best`
  std::int64_t triples = 0;       ///< all there are
  std::int64_t examined = 0;      ///< not excluded by their corners and edges alone
  std::int64_t cuts = 0;          ///< pieces of triangles cut in four
  std::int64_t unresolved = 0;    ///< pieces too small to cut that were not excluded
};

/// Every triple of bases: its triangle of mixtures is cut in pieces until the bound excludes each
/// of them from being nearer by more than `tolerance` than the best so far, beginning with `best`.
/// The same answer for any number of threads.
[[nodiscard]] TripleSearch search_triples(const SearchSpace& space, const PairSearch& pairs,
                                          double best, double tolerance);

}  // namespace paints
