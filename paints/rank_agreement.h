#pragma once
#include <cstddef>
#include <vector>

namespace paints {

/// Kendall's tau-b of two scores of the same things [Kendall1945]: pairs that both order alike less
/// those that they order contrarily, over the geometric mean of the pairs that each of them does
/// not tie. 1: the same order, -1: the reverse.
/// @throws std::invalid_argument  if sizes differ, a score is NaN, or one of the two ties all pairs
[[nodiscard]] double kendall_tau(const std::vector<double>& a, const std::vector<double>& b);

/// How many of the `top` lowest scores the two have in common, whatever their order there; of equal
/// scores the earlier comes first.
/// @throws std::invalid_argument  if sizes differ, a score is NaN, or there are fewer than `top`
[[nodiscard]] int top_overlap(const std::vector<double>& a, const std::vector<double>& b,
                              std::size_t top);

}  // namespace paints
