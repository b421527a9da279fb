#pragma once
#include <cstdint>
#include <vector>

#include "appearance/ciecam02.h"
#include "appearance/spectra/viewed_light.h"
#include "appearance/viewing_conditions.h"
#include "paints/mixing.h"
#include "paints/ranking.h"

namespace paints {

struct Recipe {
  std::vector<int> bases;  ///< into the set, rising
  Eigen::VectorXd parts;   ///< of each, sum 1
  double distance = 0;     ///< Euclidean in J, a_C, b_C
  spectra::Spectrum reflectance;
  appearance::Correlates correlates;  ///< in the room
  appearance::RoomView view;
};

struct RecipeOptions {
  int bases = 3;           ///< at most so many in a recipe, 1 to 4
  int units = 0;           ///< parts in whole units, so many in total; 0: any parts
  std::size_t count = 20;  ///< recipes wanted
  spectra::ViewingChoices viewing;
  int threads = 1;
};

/// What was tried and what is guaranteed (paints/README.md says on which assumption).
struct RecipeSearch {
  std::int64_t pairs = 0, triples = 0;  ///< all there are among what was searched globally
  std::int64_t triples_examined = 0;    ///< the others were excluded by corners and edges
  std::int64_t pieces_cut = 0, unresolved = 0;
  bool global_triples = false;  ///< no triple is nearer by more than `tolerance` than the first
  double tolerance = 0.01;      ///< in J, a_C, b_C
};

struct Recipes {
  std::vector<Recipe> recipes;  ///< nearest first, one for each set of bases
  RecipeSearch search;
};

/// The mixtures that look nearest to the target in the room, which is asked some thousand times
/// and from one thread. Every base and pair is tried; every triple that a bound does not exclude,
/// unless the atlas has more than 700 bases; a fourth base is added where it brings the best
/// triples nearer. All are refined with the room itself and exact slopes, then brought to whole
/// units. The same answer for any number of threads.
/// @throws std::invalid_argument  unless 1 <= bases <= 4, units >= 0, threads >= 1, the target is
///                                finite and the set has a base
/// @throws std::domain_error      if the room leaves the viewer without light
[[nodiscard]] Recipes find_recipes(const BaseSet& set, const Target& target,
                                   const spectra::RoomResponseSlope& room,
                                   const RecipeOptions& options = {});

}  // namespace paints
