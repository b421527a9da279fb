#include "paints/triple_search.h"

#include <algorithm>
#include <cmath>

#include "paints/piece_bound.h"

namespace paints {
namespace {

using Eigen::Vector3d;

constexpr int kMostCuts = 14;  // of an edge in halves

/// A mixture of the triple.
struct Point {
  Parts shares;
  Vector3d jab;
};

/// A piece of the triangle; middle i lies between corners i and i + 1.
struct Piece {
  std::array<Point, 3> corner, middle;

  /// How far the middles of the edges lie from the middles of their ends.
  [[nodiscard]] std::array<Vector3d, 3> deviations() const {
    std::array<Vector3d, 3> all;
    for (std::size_t i = 0; i < 3; ++i) {
      all[i] = middle[i].jab - (corner[i].jab + corner[(i + 1) % 3].jab) / 2;
    }
    return all;
  }
};

/// The triples of one first base; what it finds does not depend on the others.
struct Block {
  double best = 0, tolerance = 0;
  TripleSearch found;
};

double longest(const std::array<Vector3d, 3>& vectors) {
  return std::sqrt(
      std::max({vectors[0].squaredNorm(), vectors[1].squaredNorm(), vectors[2].squaredNorm()}));
}

class TripleSearcher {
 public:
  TripleSearcher(const SearchSpace& space, const PairSearch& pairs, const BaseNumbers& triple,
                 Block& block)
      : space_(space), pairs_(pairs), triple_(triple), block_(block) {}

  void run() {
    const Piece whole{.corner = {base(0), base(1), base(2)},
                      .middle = {edge(0, 1, 2), edge(1, 2, 2), edge(2, 0, 2)}};
    ++block_.found.triples;
    const std::array<Vector3d, 3> deviations = whole.deviations();
    const double bulge = longest(deviations);
    if (excluded(whole, deviations, bulge)) return;
    ++block_.found.examined;
    cut(whole,
        {edge(0, 1, 1), edge(0, 1, 3), edge(1, 2, 1), edge(1, 2, 3), edge(2, 0, 1), edge(2, 0, 3)},
        bulge, 1);
    if (improved_) add_fit();
  }

 private:
  Point base(int i) const {
    const auto number = static_cast<std::size_t>(triple_.at[static_cast<std::size_t>(i)]);
    return {Parts::Unit(i), pairs_.single[number]};
  }

  /// On the edge from one corner to another, after so many quarters.
  Point edge(int from, int to, int quarters) const {
    Parts shares = Parts::Zero();
    shares[from] = 1 - quarters / 4.0;
    shares[to] = quarters / 4.0;
    const bool forward = from < to;
    const int first = triple_.at[static_cast<std::size_t>(std::min(from, to))];
    const int second = triple_.at[static_cast<std::size_t>(std::max(from, to))];
    const auto place = static_cast<std::size_t>((forward ? quarters : 4 - quarters) - 1);
    return {shares, pairs_.quarters[pairs_.index(first, second)][place].cast<double>()};
  }

  Point between(const Point& p, const Point& q) {
    Point middle{.shares = (p.shares + q.shares) / 2, .jab = {}};
    middle.jab = space_.look(triple_, middle.shares);
    const double d = space_.distance(middle.jab);
    if (d < block_.best) block_.best = d, nearest_ = middle, improved_ = true;
    return middle;
  }

  bool excluded(const Piece& piece, const std::array<Vector3d, 3>& deviations, double bulge) const {
    std::array<Vector3d, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = piece.corner[i].jab - space_.wish();
    return piece_bound(corners, deviations, bulge) >= block_.best - block_.tolerance;
  }

  /// @param halves  the middles of the six half edges, two per edge
  void cut(const Piece& piece, const std::array<Point, 6>& halves, double bulge, int depth) {
    if (depth > kMostCuts) {
      ++block_.found.unresolved;
      return;
    }
    ++block_.found.cuts;
    const auto& [c, m] = piece;
    const std::array<Point, 3> inner{between(m[0], m[1]), between(m[1], m[2]), between(m[2], m[0])};
    search({.corner = {c[0], m[0], m[2]}, .middle = {halves[0], inner[2], halves[5]}}, bulge,
           depth);
    search({.corner = {m[0], c[1], m[1]}, .middle = {halves[1], halves[2], inner[0]}}, bulge,
           depth);
    search({.corner = {m[2], m[1], c[2]}, .middle = {inner[1], halves[3], halves[4]}}, bulge,
           depth);
    search({.corner = {m[0], m[1], m[2]}, .middle = inner}, bulge, depth);
  }

  /// @param whole_bulge  of the piece that it was cut from: a quarter of it remains where the
  ///                     appearance is smooth, even if by chance the middles show less
  void search(const Piece& piece, double whole_bulge, int depth) {
    const std::array<Vector3d, 3> deviations = piece.deviations();
    const double bulge = std::max(longest(deviations), whole_bulge / 4);
    if (excluded(piece, deviations, bulge)) return;
    std::array<Point, 6> halves;
    for (std::size_t i = 0; i < 3; ++i) {
      halves[2 * i] = between(piece.corner[i], piece.middle[i]);
      halves[2 * i + 1] = between(piece.middle[i], piece.corner[(i + 1) % 3]);
    }
    cut(piece, halves, bulge, depth + 1);
  }

  void add_fit() {
    block_.found.nearer.push_back(space_.fitted(triple_, nearest_.shares));
    block_.best = std::min(block_.best, block_.found.nearer.back().distance);
  }

  const SearchSpace& space_;
  const PairSearch& pairs_;
  BaseNumbers triple_;
  Block& block_;
  Point nearest_;
  bool improved_ = false;
};

}  // namespace

TripleSearch search_triples(const SearchSpace& space, const PairSearch& pairs, double best,
                            double tolerance) {
  const int n = space.size();
  std::vector<Block> blocks(static_cast<std::size_t>(n), {.best = best, .tolerance = tolerance});
  in_parallel(n, space.threads(), [&](int i) {
    Block& block = blocks[static_cast<std::size_t>(i)];
    for (int j = i + 1; j < n; ++j) {
      for (int k = j + 1; k < n; ++k) {
        TripleSearcher(space, pairs, {.count = 3, .at = {i, j, k}}, block).run();
      }
    }
  });
  TripleSearch all;
  for (const Block& block : blocks) {
    const TripleSearch& found = block.found;
    all.nearer.insert(all.nearer.end(), found.nearer.begin(), found.nearer.end());
    all.triples += found.triples;
    all.examined += found.examined;
    all.cuts += found.cuts;
    all.unresolved += found.unresolved;
  }
  return all;
}

}  // namespace paints
