#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "paints/ranking.h"

namespace paints {

/// Surfaces that are painted alike, what they may be painted with, and how they shall look.
struct SchemeGroup {
  const Atlas* atlas = nullptr;
  Target target;
  double weight = 1;  ///< of its distance among the groups
};

/// The room when all paints but one are given: for each group that is looked at, its lightings.
/// @param paints  of each group; that of `varying` is not read
using SchemeRoom = std::function<std::vector<std::vector<spectra::LitRoom>>(
    int varying, const std::vector<spectra::Spectrum>& paints)>;

struct SchemeOptions {
  Distance distance = Distance::jab;
  spectra::ViewingChoices viewing;
  spectra::Judgement judgement = spectra::Judgement::mean;
  std::size_t top = 20;                         ///< schemes that are kept
  std::int64_t most_combinations = 20'000'000;  ///< tried exhaustively
};

struct Scheme {
  std::vector<const Paint*> paints;  ///< of each group, into its atlas
  double distance = 0;               ///< weighted mean over the groups, judged over lightings
  std::vector<std::vector<SeenPaint>> seen;  ///< group, then lighting
};

struct SchemeRanking {
  std::vector<Scheme> schemes;    ///< nearest first, ties by the atlases' order
  std::int64_t combinations = 0;  ///< of all paints
  bool exhaustive = false;
  int differing = 0;  ///< else: no scheme that differs from the best in so many paints is nearer
};

/// Combinations of one paint per group by the weighted mean of their distances. Exhaustive up to
/// `most_combinations`; beyond, a descent in which as many groups as that allows are exchanged at
/// once, from the best paint of the first group beside the first paints of the others.
/// A combination is left out if the model leaves one of its walls undefined.
/// @throws std::invalid_argument  if there are no groups, an atlas is empty or a weight is not
/// positive
[[nodiscard]] SchemeRanking rank_schemes(const std::vector<SchemeGroup>& groups,
                                         const SchemeRoom& room, const SchemeOptions& options = {});

}  // namespace paints
