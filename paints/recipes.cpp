#include "paints/recipes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "appearance/jab_slope.h"
#include "paints/recipe_fit.h"
#include "paints/search_space.h"
#include "paints/triple_search.h"

namespace paints {
namespace {

constexpr int kMostForTriples = 700;         // bases: 57 million triples
constexpr std::size_t kFittedPairs = 2000;   // at least
constexpr std::size_t kExtendedPairs = 100;  // by every third base
constexpr std::size_t kExtendedTriples = 50;
constexpr std::size_t kRefined = 300;  // with the room itself, at least
constexpr double kSame = 1e-6;         // nearer than this, fewer bases come first

void require_sound(const BaseSet& set, const Target& target, const RecipeOptions& options) {
  const auto& [bases, units, count, viewing, threads] = options;
  if (!(bases >= 1 && bases <= kMostBases && units >= 0 && threads >= 1 && !set.bases.empty())) {
    throw std::invalid_argument(
        fmt::format("mixing at most {} of {} bases in {} units on {} threads", bases,
                    set.bases.size(), units, threads));
  }
  if (!std::isfinite(target.lightness + target.a_c + target.b_c)) {
    throw std::invalid_argument("the target is not finite");
  }
}

/// The room itself, asked for mixtures.
class Exact {
 public:
  Exact(const BaseSet& set, const spectra::RoomResponseSlope& room,
        const spectra::ViewingChoices& viewing)
      : set_(set), room_(room), viewing_(viewing) {}

  [[nodiscard]] JabOfParts slope(const BaseNumbers& bases, const Parts& parts) const {
    const Mixture mixed = mix(bases, parts);
    const appearance::JabSlope seen = appearance::jab_slope(room_(mixed.reflectance), viewing_);
    JabOfParts of_parts{.jab = seen.jab, .by_parts = {}};
    if (!seen.status.all_defined()) of_parts.jab.setConstant(std::nan(""));
    of_parts.by_parts.setZero();
    of_parts.by_parts.leftCols(bases.count) = seen.by_reflectance * mixed.by_parts;
    return of_parts;
  }

  [[nodiscard]] Recipe recipe(const BaseNumbers& bases, const Parts& parts,
                              const Eigen::Vector3d& wish) const {
    Recipe recipe{.bases = {bases.at.begin(), bases.at.begin() + bases.count},
                  .parts = parts.head(bases.count),
                  .reflectance = mix(bases, parts).reflectance};
    recipe.view = appearance::view_of_room(room_(recipe.reflectance).light, viewing_);
    recipe.correlates = appearance::seen(recipe.view);
    const appearance::Correlates& k = recipe.correlates;
    recipe.distance = (Eigen::Vector3d(k.lightness, k.a_c, k.b_c) - wish).norm();
    return recipe;
  }

 private:
  [[nodiscard]] Mixture mix(const BaseNumbers& bases, const Parts& parts) const {
    return mixture(set_, {bases.at.begin(), bases.at.begin() + bases.count},
                   parts.head(bases.count));
  }

  const BaseSet& set_;
  const spectra::RoomResponseSlope& room_;
  spectra::ViewingChoices viewing_;
};

std::vector<Candidate> of_count(const std::vector<Candidate>& candidates, int count,
                                std::size_t most) {
  std::vector<Candidate> chosen;
  for (const Candidate& c : candidates) {
    if (c.bases.count == count && chosen.size() < most) chosen.push_back(c);
  }
  return chosen;
}

void add(std::vector<Candidate>& candidates, const std::vector<Candidate>& more) {
  candidates.insert(candidates.end(), more.begin(), more.end());
  keep_nearest(candidates, candidates.size());
}

/// Adds what a further base makes of the `most` nearest candidates of `count` bases.
void extend(const SearchSpace& space, int count, std::size_t most,
            std::vector<Candidate>& candidates) {
  const std::vector<Candidate> from = of_count(candidates, count, most);
  std::vector<std::vector<Candidate>> found(from.size());
  in_parallel(static_cast<int>(from.size()), space.threads(), [&](int i) {
    const auto place = static_cast<std::size_t>(i);
    found[place] = space.extended(from[place]);
  });
  std::vector<Candidate> all;
  for (const auto& f : found) all.insert(all.end(), f.begin(), f.end());
  add(candidates, all);
}

std::vector<Candidate> search(const SearchSpace& space, int bases, RecipeSearch& report) {
  PairSearch pairs = search_pairs(space, bases > 1 ? kFittedPairs : 0,
                                  bases > 2 && space.size() <= kMostForTriples);
  std::vector<Candidate> candidates = std::move(pairs.nearest);
  std::erase_if(candidates, [&](const Candidate& c) { return c.bases.count > bases; });
  report.pairs = pairs.pairs;
  if (bases < 3) return candidates;

  extend(space, 2, kExtendedPairs, candidates);
  // Nothing is nearer than the wish itself, so there may be nothing left to search for.
  report.global_triples = candidates.front().distance <= report.tolerance;
  if (!report.global_triples && space.size() <= kMostForTriples) {
    const TripleSearch triples =
        search_triples(space, pairs, candidates.front().distance, report.tolerance);
    add(candidates, triples.nearer);
    report.triples = triples.triples;
    report.triples_examined = triples.examined;
    report.pieces_cut = triples.cuts;
    report.unresolved = triples.unresolved;
    report.global_triples = triples.unresolved == 0;
  }
  if (bases > 3) extend(space, 3, kExtendedTriples, candidates);
  return candidates;
}

/// Where a recipe stands: by distance, then by the number of bases.
auto standing(const Recipe& recipe) {
  return std::tuple(recipe.distance < kSame ? 0 : recipe.distance, recipe.bases.size(),
                    recipe.bases);
}

Recipe refined(const Exact& exact, const SearchSpace& space, const Candidate& candidate,
               int units) {
  const BaseNumbers& bases = candidate.bases;
  const auto slope = [&](const Parts& parts) { return exact.slope(bases, parts); };
  Fit fit = fit_parts(slope, space.wish(), candidate.parts, space.strengths(bases));
  if (units > 0) {
    const auto look = [&](const Parts& parts) { return exact.slope(bases, parts).jab; };
    fit = fit_units(look, space.wish(), fit.parts, bases.count, units);
  }
  const Candidate kept = in_order(bases, fit);
  return exact.recipe(kept.bases, kept.parts, space.wish());
}

}  // namespace

Recipes find_recipes(const BaseSet& set, const Target& target,
                     const spectra::RoomResponseSlope& room, const RecipeOptions& options) {
  require_sound(set, target, options);
  const ViewedTable table(set, room, options.viewing);
  const SearchSpace space(set, table, {target.lightness, target.a_c, target.b_c}, options.threads);
  Recipes found;
  std::vector<Candidate> candidates = search(space, options.bases, found.search);
  candidates.resize(std::min(candidates.size(), std::max(kRefined, 3 * options.count)));

  // The white of near-white surfaces jumps where a paint becomes one: the table cannot follow.
  if (options.viewing.white != spectra::ReferenceWhite::ideal) found.search.global_triples = false;

  const Exact exact(set, room, options.viewing);
  for (const Candidate& candidate : candidates) {
    Recipe recipe = refined(exact, space, candidate, options.units);
    if (recipe.correlates.status.all_defined()) found.recipes.push_back(std::move(recipe));
  }
  std::sort(found.recipes.begin(), found.recipes.end(),
            [](const Recipe& p, const Recipe& q) { return standing(p) < standing(q); });
  std::vector<std::vector<int>> seen;
  std::erase_if(found.recipes, [&](const Recipe& recipe) {
    if (seen.size() >= options.count ||
        std::find(seen.begin(), seen.end(), recipe.bases) != seen.end()) {
      return true;
    }
    seen.push_back(recipe.bases);
    return false;
  });
  return found;
}

}  // namespace paints
