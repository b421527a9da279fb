#include "paints/scheme.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace paints {
namespace {

using spectra::Spectrum;
using Choice = std::vector<std::size_t>;  ///< a paint of each group, by its place in the atlas

struct Candidate {
  double distance = std::numeric_limits<double>::infinity();
  Choice choice;

  bool operator<(const Candidate& other) const {
    return distance != other.distance ? distance < other.distance : choice < other.choice;
  }
};

/// The best so far, nearest first.
class Best {
 public:
  explicit Best(std::size_t top) : top_(top) {}

  /// What a candidate must not exceed to be kept.
  [[nodiscard]] double threshold() const {
    return kept_.size() < top_ ? std::numeric_limits<double>::infinity() : kept_.back().distance;
  }

  void offer(const Candidate& candidate) {
    if (kept_.size() == top_ && !(candidate < kept_.back())) return;
    const auto at = std::ranges::lower_bound(kept_, candidate, std::less{});
    if (at != kept_.end() && at->choice == candidate.choice) return;
    kept_.insert(at, candidate);
    if (kept_.size() > top_) kept_.pop_back();
  }

  [[nodiscard]] const std::vector<Candidate>& kept() const { return kept_; }

 private:
  std::size_t top_;
  std::vector<Candidate> kept_;
};

class Search {
 public:
  Search(const std::vector<SchemeGroup>& groups, const SchemeRoom& room,
         const SchemeOptions& options)
      : groups_(groups), room_(room), options_(options), best_(options.top) {
    for (const SchemeGroup& g : groups) weights_ += g.weight;
  }

  SchemeRanking run();

 private:
  [[nodiscard]] std::int64_t paints(std::size_t group) const {
    return static_cast<std::int64_t>(groups_[group].atlas->paints.size());
  }

  [[nodiscard]] std::vector<Spectrum> spectra_of(const Choice& choice) const;
  void try_all(std::vector<std::size_t> free, Choice choice);
  void vary(std::size_t varying, Choice choice);
  [[nodiscard]] double distance_of(const Spectrum& paint,
                                   const std::vector<std::vector<spectra::LitRoom>>& views,
                                   double enough) const;
  void descend(std::size_t exchanged);
  [[nodiscard]] Scheme described(const Candidate& candidate) const;

  const std::vector<SchemeGroup>& groups_;
  const SchemeRoom& room_;
  const SchemeOptions& options_;
  Best best_;
  double weights_ = 0;
};

std::vector<Spectrum> Search::spectra_of(const Choice& choice) const {
  std::vector<Spectrum> paints;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    paints.push_back(groups_[g].atlas->paints[choice[g]].reflectance);
  }
  return paints;
}

/// Every paint for each of the `free` groups; the largest atlas runs innermost.
void Search::try_all(std::vector<std::size_t> free, Choice choice) {
  const auto largest = std::ranges::max_element(
      free, [&](std::size_t a, std::size_t b) { return paints(a) < paints(b); });
  const std::size_t varying = *largest;
  free.erase(largest);
  const auto turn = [&](const auto& self, std::size_t at) -> void {
    if (at == free.size()) return vary(varying, choice);
    for (choice[free[at]] = 0; choice[free[at]] < static_cast<std::size_t>(paints(free[at]));
         ++choice[free[at]]) {
      self(self, at + 1);
    }
  };
  turn(turn, 0);
}

void Search::vary(std::size_t varying, Choice choice) {
  const auto views = room_(static_cast<int>(varying), spectra_of(choice));
  const std::vector<Paint>& paints = groups_[varying].atlas->paints;
  for (choice[varying] = 0; choice[varying] < paints.size(); ++choice[varying]) {
    const double distance =
        distance_of(paints[choice[varying]].reflectance, views, best_.threshold());
    if (distance <= best_.threshold()) best_.offer({distance, choice});
  }
}

/// Infinite as soon as it is known to be more than `enough`, or where the model leaves a wall
/// undefined.
double Search::distance_of(const Spectrum& paint,
                           const std::vector<std::vector<spectra::LitRoom>>& views,
                           double enough) const {
  double sum = 0;
  std::vector<double> distances;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    distances.clear();
    for (const spectra::LitRoom& lit : views[g]) {
      const SeenPaint seen =
          look(paint, groups_[g].target, lit, options_.distance, options_.viewing);
      if (!seen.correlates.status.all_defined()) return std::numeric_limits<double>::infinity();
      distances.push_back(seen.distance);
    }
    sum += groups_[g].weight * judged(options_.judgement, distances, views[g]);
    if (sum > enough * weights_) return std::numeric_limits<double>::infinity();
  }
  return sum / weights_;
}

/// Exchanges so many groups' paints at once until no exchange brings the best scheme nearer.
void Search::descend(std::size_t exchanged) {
  const std::size_t n = groups_.size();
  try_all({0}, Choice(n, 0));
  Choice start;
  do {
    start = best_.kept().front().choice;
    for (unsigned mask = 0; mask < (1U << n); ++mask) {
      std::vector<std::size_t> free;
      for (std::size_t g = 0; g < n; ++g) {
        if ((mask >> g & 1U) != 0) free.push_back(g);
      }
      if (free.size() == exchanged) try_all(free, best_.kept().front().choice);
    }
  } while (best_.kept().front().choice != start);
}

Scheme Search::described(const Candidate& candidate) const {
  Scheme scheme{.distance = candidate.distance};
  const std::vector<Spectrum> paints = spectra_of(candidate.choice);
  const auto views = room_(0, paints);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    scheme.paints.push_back(&groups_[g].atlas->paints[candidate.choice[g]]);
    scheme.seen.push_back(
        look(paints[0], groups_[g].target, views[g], options_.distance, options_.viewing));
  }
  return scheme;
}

SchemeRanking Search::run() {
  SchemeRanking ranking{.combinations = 1};
  std::vector<std::size_t> all, sizes;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    all.push_back(g);
    sizes.push_back(groups_[g].atlas->paints.size());
    ranking.combinations *= paints(g);
  }
  ranking.exhaustive = ranking.combinations <= options_.most_combinations;
  if (ranking.exhaustive) {
    try_all(all, Choice(groups_.size(), 0));
  } else {
    std::ranges::sort(sizes, std::greater{});
    const bool two = groups_.size() > 2 &&
                     static_cast<std::int64_t>(sizes[0] * sizes[1]) <= options_.most_combinations;
    ranking.differing = two ? 2 : 1;
    descend(static_cast<std::size_t>(ranking.differing));
  }
  for (const Candidate& c : best_.kept()) {
    if (std::isfinite(c.distance)) ranking.schemes.push_back(described(c));
  }
  return ranking;
}

}  // namespace

SchemeRanking rank_schemes(const std::vector<SchemeGroup>& groups, const SchemeRoom& room,
                           const SchemeOptions& options) {
  if (groups.empty()) throw std::invalid_argument("no group of surfaces is painted");
  for (const SchemeGroup& g : groups) {
    if (g.atlas == nullptr || g.atlas->paints.empty()) {
      throw std::invalid_argument("an atlas has no paint");
    }
    if (!(g.weight > 0 && std::isfinite(g.weight))) {
      throw std::invalid_argument(fmt::format("weight {}; want a positive number", g.weight));
    }
  }
  return Search(groups, room, options).run();
}

}  // namespace paints
