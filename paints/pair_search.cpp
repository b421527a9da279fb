#include "paints/pair_search.h"

#include <algorithm>

#include "paints/piece_bound.h"

namespace paints {
namespace {

constexpr int kSteps = 16;  // from one base to the other; two steps are a piece
constexpr double kInfinity = 1e300;

/// A pair as it was sampled.
struct Sampled {
  BaseNumbers bases;
  double nearest = kInfinity, bound = kInfinity;  // of the samples; below any mixture
  int step = 0;                                   // of the nearest sample
};

Parts shares_at(int step) {
  const double second = static_cast<double>(step) / kSteps;
  return {1 - second, second, 0, 0};
}

using Line = std::array<Eigen::Vector3d, kSteps + 1>;

Line line_of(const SearchSpace& space, const PairSearch& found, const BaseNumbers& pair) {
  Line line;
  line.front() = found.single[static_cast<std::size_t>(pair.at[0])];
  line.back() = found.single[static_cast<std::size_t>(pair.at[1])];
  for (int step = 1; step < kSteps; ++step) {
    line[static_cast<std::size_t>(step)] = space.look(pair, shares_at(step));
  }
  return line;
}

Sampled sampled(const SearchSpace& space, const BaseNumbers& pair, const Line& line) {
  Sampled s{.bases = pair};
  for (std::size_t step = 0; step <= kSteps; ++step) {
    const double d = space.distance(line[step]);
    if (d < s.nearest) s.nearest = d, s.step = static_cast<int>(step);
  }
  for (std::size_t step = 0; step < kSteps; step += 2) {
    const std::array<Eigen::Vector3d, 2> ends{line[step] - space.wish(),
                                              line[step + 2] - space.wish()};
    const std::array<Eigen::Vector3d, 1> deviation{line[step + 1] - space.wish() -
                                                   (ends[0] + ends[1]) / 2};
    s.bound = std::min(s.bound, piece_bound(ends, deviation, deviation[0].norm()));
  }
  return s;
}

/// Fits pairs [from, to) of the list.
void fit(const SearchSpace& space, const std::vector<Sampled>& pairs, std::size_t from,
         std::size_t to, PairSearch& found) {
  std::vector<Candidate> fits(to - from);
  in_parallel(static_cast<int>(to - from), space.threads(), [&](int i) {
    const Sampled& s = pairs[from + static_cast<std::size_t>(i)];
    const int start = std::clamp(s.step, 1, kSteps - 1);  // at an end, a step inwards is free
    fits[static_cast<std::size_t>(i)] = space.fitted(s.bases, shares_at(start));
  });
  found.fitted += static_cast<std::int64_t>(fits.size());
  found.nearest.insert(found.nearest.end(), fits.begin(), fits.end());
}

}  // namespace

std::size_t PairSearch::index(int first, int second) const {
  const auto i = static_cast<std::size_t>(first), j = static_cast<std::size_t>(second);
  return i * single.size() - i * (i + 1) / 2 + j - i - 1;
}

namespace {

/// Pairs that are still of interest after some rows: the `most` nearest of their samples, and those
/// whose bound lies below the nearest mixture so far. So memory does not grow with all pairs.
class Shortlist {
 public:
  Shortlist(std::size_t most, double nearest) : most_(most), nearest_(nearest) {}

  void add(std::vector<Sampled> pairs) {
    for (const Sampled& s : pairs) nearest_ = std::min(nearest_, s.nearest);
    kept_.insert(kept_.end(), pairs.begin(), pairs.end());
    const auto first = static_cast<std::ptrdiff_t>(std::min(most_, kept_.size()));
    std::nth_element(kept_.begin(), kept_.begin() + first, kept_.end(), before);
    kept_.erase(std::remove_if(kept_.begin() + first, kept_.end(),
                               [&](const Sampled& s) { return s.bound >= nearest_; }),
                kept_.end());
  }

  [[nodiscard]] std::vector<Sampled> sorted() && {
    std::sort(kept_.begin(), kept_.end(), before);
    return std::move(kept_);
  }

 private:
  static bool before(const Sampled& p, const Sampled& q) {
    return std::tie(p.nearest, p.bases) < std::tie(q.nearest, q.bases);
  }

  std::size_t most_;
  double nearest_;
  std::vector<Sampled> kept_;
};

/// The pairs of base i with all later ones.
std::vector<Sampled> row_of(const SearchSpace& space, int i, PairSearch& found) {
  std::vector<Sampled> row;
  for (int j = i + 1; j < space.size(); ++j) {
    const BaseNumbers pair{.count = 2, .at = {i, j}};
    const Line line = line_of(space, found, pair);
    row.push_back(sampled(space, pair, line));
    if (found.quarters.empty()) continue;
    for (std::size_t q = 0; q < 3; ++q) {
      found.quarters[found.index(i, j)][q] = line[4 * (q + 1)].cast<float>();
    }
  }
  return row;
}

}  // namespace

PairSearch search_pairs(const SearchSpace& space, std::size_t most, bool for_triples) {
  PairSearch found;
  for (int i = 0; i < space.size(); ++i) {
    const BaseNumbers alone{.count = 1, .at = {i}};
    found.single.push_back(space.look(alone, Parts::Unit(0)));
    found.nearest.push_back(
        {.bases = alone, .parts = Parts::Unit(0), .distance = space.distance(found.single.back())});
  }
  keep_nearest(found.nearest, found.nearest.size());
  if (most == 0) return found;
  const std::size_t n = found.single.size();
  found.pairs = static_cast<std::int64_t>(n * (n - 1) / 2);
  if (for_triples) found.quarters.resize(n * (n - 1) / 2);
  Shortlist shortlist(most, found.nearest.empty() ? kInfinity : found.nearest.front().distance);
  constexpr int kRowsAtOnce = 64;
  for (int from = 0; from < space.size(); from += kRowsAtOnce) {
    const int count = std::min(kRowsAtOnce, space.size() - from);
    std::vector<std::vector<Sampled>> rows(static_cast<std::size_t>(count));
    in_parallel(count, space.threads(),
                [&](int k) { rows[static_cast<std::size_t>(k)] = row_of(space, from + k, found); });
    for (std::vector<Sampled>& row : rows) shortlist.add(std::move(row));
  }

  std::vector<Sampled> pairs = std::move(shortlist).sorted();
  const std::size_t first = std::min(most, pairs.size());
  fit(space, pairs, 0, first, found);
  keep_nearest(found.nearest, found.nearest.size());
  const double best = found.nearest.empty() ? kInfinity : found.nearest.front().distance;
  pairs.erase(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(first));
  std::erase_if(pairs, [&](const Sampled& s) { return s.bound >= best; });
  fit(space, pairs, 0, pairs.size(), found);
  keep_nearest(found.nearest, found.nearest.size());
  return found;
}

}  // namespace paints
