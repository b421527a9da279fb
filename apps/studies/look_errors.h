#pragma once
#include <vector>

#include "paints/ranking.h"

namespace apps {

/// What patches of a finite length leave of how a paint looks, each in its own unit; an estimate.
struct LookError {
  double distance = 0;                     ///< judged over the lightings
  double lightness = 0, a_c = 0, b_c = 0;  ///< in the first lighting
  double background_y = 0;                 ///< Y_b
  double adapting_luminance_cd_m2 = 0;     ///< L_A
  double white = 0;                        ///< largest of X, Y, Z of the white, of Y_w = 100
};

struct RankingErrors {
  std::vector<LookError> of_paint;  ///< in the order of the ranking; empty: nothing could be told
  /// For each paint the best-ranked one before it that it may in truth be nearer than, from 1;
  /// 0: its place is settled.
  std::vector<int> ties_with;
};

/// How a ranking reads on patches twice and four times as long, by solver::left_by_mesh.
/// @param longer  the lightings on these; if not both are there, nothing is told
[[nodiscard]] RankingErrors ranking_errors(const paints::Ranking& ranking,
                                           const paints::Target& target,
                                           const std::vector<std::vector<spectra::LitRoom>>& longer,
                                           const paints::RankingOptions& options);

}  // namespace apps
