#include "solver/exchange/exchange.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include "solver/exchange/closure.h"
#include "solver/exchange/clusters.h"
#include "solver/exchange/facing_table.h"
#include "solver/exchange/slopes.h"
#include "solver/factors/far_field.h"
#include "solver/factors/pair_factor.h"
#include "solver/factors/rectangle_pairs.h"

namespace solver {
namespace {

static_assert(kTile == kFarPatches);  // a row of a tile is what the far field takes at once
constexpr std::size_t kTileSize = std::size_t{kTile} * kTile;

/// Pairs of aligned rectangles that are near, gathered over a tile so that vectors are full.
class NearPairs {
 public:
  /// @param to  gets A_i F_ij, m^2, at the latest from evaluate()
  void add(const RectanglePair& pair, double smaller_area_m2, float* to) {
    Queue& queue = pair.planes == Planes::parallel ? parallel_ : perpendicular_;
    queue.wanted[queue.batch.size()] = {smaller_area_m2, to};
    queue.batch.add(pair);
    if (queue.batch.size() == RectangleBatch::kCapacity) evaluate(queue);
  }

  void evaluate() {
    evaluate(parallel_);
    evaluate(perpendicular_);
  }

 private:
  struct Wanted {
    double most_m2;
    float* to;
  };

  struct Queue {
    RectangleBatch batch;
    std::array<Wanted, RectangleBatch::kCapacity> wanted;
  };

  static void evaluate(Queue& queue) {
    const std::size_t size = queue.batch.size();
    const RectangleBatch::Values& values = queue.batch.evaluate();
    for (std::size_t k = 0; k < size; ++k) {
      const Wanted& wanted = queue.wanted[k];
      *wanted.to = static_cast<float>(std::clamp(values[k], 0.0, wanted.most_m2));
    }
  }

  Queue parallel_{RectangleBatch(Planes::parallel), {}};
  Queue perpendicular_{RectangleBatch(Planes::perpendicular), {}};
};

/// Fills one tile of X at a time.
class Assembly {
 public:
  Assembly(const scenes::PatchMesh& mesh, const Visibility& visibility,
           const ExchangeOptions& options)
      : facets_(facets_of(mesh)),
        facing_(mesh),
        far_(facets_),
        visibility_(visibility),
        options_(options) {
    for (const Facet& f : facets_) rectangles_.push_back(rectangle_of(f));
  }

  struct Counts {
    std::int64_t facing = 0, tested = 0;
  };

  [[nodiscard]] const FacingTable& facing() const { return facing_; }

  [[nodiscard]] const std::vector<Facet>& facets() const { return facets_; }

  /// Of two blocks of patches.
  [[nodiscard]] bool any_facing(int row, int column) const {
    if (!options_.skip) return true;
    for (std::size_t i = begin(row); i < end(row); ++i) {
      for (std::size_t j = begin(column); j < end(column); ++j) {
        if (facing_.relation(i, j) != FacingTable::Pair::none) return true;
      }
    }
    return false;
  }

  /// @param partial  gets the pairs that something hides in part
  Counts fill(int row, int column, float* tile, std::vector<PartialPair>& partial) const {
    Counts counts;
    NearPairs near;
    const auto for_each_row = [&](const auto& visit) {
      for (std::size_t i = begin(row); i < end(row); ++i) {
        visit(i, row == column ? i + 1 : begin(column), tile + (i - begin(row)) * kTile);
      }
    };
    for_each_row([&](std::size_t i, std::size_t first, float* line) {
      unoccluded(i, first, column, line, near, counts);
    });
    near.evaluate();
    for_each_row([&](std::size_t i, std::size_t first, float* line) {
      hide(i, first, column, line, counts, partial);
      if (row != column) return;
      for (std::size_t j = first; j < end(column); ++j) {
        tile[(j - begin(row)) * kTile + (i - begin(row))] = line[j - begin(column)];
      }
    });
    return counts;
  }

 private:
  static std::size_t begin(int block) { return static_cast<std::size_t>(block) * kTile; }

  [[nodiscard]] std::size_t end(int block) const {
    return std::min(begin(block) + kTile, facets_.size());
  }

  /// A_i F_ij of patch i with the patches from `first` to the end of the tile; those of `near` come
  /// later.
  void unoccluded(std::size_t i, std::size_t first, int column, float* line, NearPairs& near,
                  Counts& counts) const {
    std::array<int, kTile> order{};
    FarRow row;
    far_.start(i, begin(column), row);
    const bool has_rule_i = far_.has_rule(i);
    const std::size_t last = end(column);
    for (std::size_t j = first; j < last; ++j) {
      const FacingTable::Pair pair = facing_.relation(i, j);
      if (pair == FacingTable::Pair::none && options_.skip) continue;
      const std::size_t k = j - begin(column);
      if (pair == FacingTable::Pair::none) {
        line[k] = static_cast<float>(exchange_area(facets_[i], facets_[j]));
        continue;
      }
      ++counts.facing;
      const int far = far_field_order(row.distance_over_size[k]);
      if (far > 0 && pair == FacingTable::Pair::facing && has_rule_i && far_.has_rule(j)) {
        order[k] = far;
        continue;
      }
      if (const auto closed = far == 0 ? closed_form(i, j) : std::nullopt) {
        near.add(*closed, std::min(facets_[i].area_m2, facets_[j].area_m2), &line[k]);
      } else {
        line[k] = static_cast<float>(exchange_area(facets_[i], facets_[j]));
      }
    }
    far_.exchange(row, order, line);
  }

  /// Of a pair that is near.
  [[nodiscard]] std::optional<RectanglePair> closed_form(std::size_t i, std::size_t j) const {
    if (!rectangles_[i] || !rectangles_[j] ||
        !closed_form_suits(facets_[i].area_m2, facets_[j].area_m2)) {
      return {};
    }
    return aligned(*rectangles_[i], *rectangles_[j]);
  }

  void hide(std::size_t i, std::size_t first, int column, float* line, Counts& counts,
            std::vector<PartialPair>& partial) const {
    if (visibility_.unobstructed()) return;
    for (std::size_t j = first; j < end(column); ++j) {
      float& value = line[j - begin(column)];
      const int pi = static_cast<int>(i), pj = static_cast<int>(j);
      if (value == 0 || !visibility_.may_block(pi, pj)) continue;
      ++counts.tested;
      const bool lamp = !options_.lamp.empty() && (options_.lamp[i] || options_.lamp[j]);
      const int rays = lamp ? options_.lamp_rays : options_.rays;
      const std::uint64_t seed = static_cast<std::uint64_t>(i) << 32U | j;
      const double share = visibility_
                               .between(facets_[i], visibility_.separation(pi), facets_[j],
                                        visibility_.separation(pj), seed, rays)
                               .share;
      if (share > 0 && share < 1) partial.push_back({i, j, share, rays});
      value *= static_cast<float>(share);
    }
  }

  std::vector<Facet> facets_;
  std::vector<std::optional<AxedRectangle>> rectangles_;
  FacingTable facing_;
  FarField far_;
  const Visibility& visibility_;
  const ExchangeOptions& options_;
};

int blocks_for(std::size_t patches) { return static_cast<int>((patches + kTile - 1) / kTile); }

/// Room for every tile that `present` names.
template <typename Present>
SymmetricTiles allocate(int blocks, Present present) {
  SymmetricTiles tiles{.blocks = blocks};
  std::int64_t size = 0;
  for (int row = 0; row < blocks; ++row) {
    for (int column = row; column < blocks; ++column) {
      const bool stored = present(row, column);
      tiles.offset.push_back(stored ? size : SymmetricTiles::kAbsent);
      if (stored) size += static_cast<std::int64_t>(kTileSize);
    }
  }
  tiles.values.resize(static_cast<std::size_t>(size));
  return tiles;
}

/// Tiles of a matrix with one row per patch and mode; blocks of patches, 64 each, straddle them.
SymmetricTiles allocate(const Assembly& assembly, int modes) {
  const auto patches = static_cast<int>(assembly.facets().size());
  if (modes == 1) {
    return allocate(blocks_for(assembly.facets().size()),
                    [&](int row, int column) { return assembly.any_facing(row, column); });
  }
  const int blocks = blocks_for(assembly.facets().size());
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> facing(blocks, blocks);
  for (int i = 0; i < blocks; ++i) {
    for (int j = i; j < blocks; ++j) facing(i, j) = facing(j, i) = assembly.any_facing(i, j);
  }
  const int rows = modes * patches;
  const auto blocks_of = [&](int tile) {  // of patches, of which the tile has rows
    std::vector<int> all;
    for (int row = tile * kTile; row < std::min((tile + 1) * kTile, rows); ++row) {
      const int block = row % patches / kTile;
      if (all.empty() || all.back() != block) all.push_back(block);
    }
    return all;
  };
  return allocate(blocks_for(static_cast<std::size_t>(rows)), [&](int row, int column) {
    for (const int i : blocks_of(row)) {
      for (const int j : blocks_of(column)) {
        if (facing(i, j) || i == j) return true;  // slopes exchange with their own mean
      }
    }
    return false;
  });
}

/// Light on these patches counts as constant.
void drop_slopes(ExchangeAreas& x, const std::vector<Eigen::Index>& patches) {
  const Eigen::Index n = x.patches();
  for (const Eigen::Index p : patches) {
    for (int a = 1; a < x.modes; ++a) {
      x.scaling[a * n + p] = 0;
      x.slope_self_m2[(a - 1) * n + p] = 0;
    }
  }
  x.without_slopes += static_cast<int>(patches.size());
}

/// Patches that get most of their light from one other: deep in a slot, where the moments of the
/// two are less exact than light that goes to and fro so often asks for.
std::vector<Eigen::Index> patches_in_slots(const ExchangeAreas& x) {
  constexpr double kMost = 0.75;
  std::vector<char> in_slot(static_cast<std::size_t>(x.patches()), 0);
  tbb::parallel_for(0, x.patches(), [&](int i) {
    for (int j = 0; j < x.patches(); ++j) {
      if (x.form_factor(i, j) > kMost) in_slot[static_cast<std::size_t>(i)] = 1;
    }
  });
  std::vector<Eigen::Index> patches;
  for (std::size_t i = 0; i < in_slot.size(); ++i) {
    if (in_slot[i] != 0) patches.push_back(static_cast<Eigen::Index>(i));
  }
  return patches;
}

struct Strongest {
  double norm = 0;
  Eigen::VectorXd pattern;  ///< sqrt(A) x, of norm 1
};

/// The norm of F in ||sqrt(A) x||, by the power method beside the light that is even everywhere,
/// whose factor is 1.
Strongest strongest_pattern(const ExchangeAreas& x) {
  constexpr int kSteps = 40;
  constexpr double kGoldenRatio = 0.6180339887498949;
  const Eigen::ArrayXd root = x.area_m2.sqrt();
  Eigen::VectorXd even = Eigen::VectorXd::Zero(x.rows());
  even.head(x.patches()) = root.head(x.patches()).matrix().normalized();
  double seed = 0;
  Strongest s;
  s.pattern = Eigen::VectorXd::NullaryExpr(x.rows(), [&](Eigen::Index) {
    seed = std::fmod(seed + kGoldenRatio, 1);
    return seed - 0.5;
  });
  for (int step = 0; step < kSteps; ++step) {
    s.pattern -= even.dot(s.pattern) * even;
    s.pattern.normalize();
    const Bands moved = gather(x, (s.pattern.array() / root).matrix());
    s.pattern = (moved.col(0) * root).matrix();
    s.norm = s.pattern.norm();
  }
  s.pattern /= std::max(s.norm, 1e-300);
  return s;
}

/// Where moments are too inaccurate for F to shorten light, light becomes constant: on the patches
/// whose slopes make most of the pattern that grows, until none grows.
void contract(ExchangeAreas& x) {
  constexpr double kNoise = 1e-6, kShare = 0.1;
  constexpr int kMostTries = 20;
  drop_slopes(x, patches_in_slots(x));
  const Eigen::Index n = x.patches();
  for (int t = 0;; ++t) {
    const Strongest strongest = strongest_pattern(x);
    if (strongest.norm <= 1 + kNoise) return;
    const Eigen::ArrayXd square = strongest.pattern.array().square();
    const Eigen::ArrayXd of_slopes = square.segment(n, n) + square.tail(n);
    const double most = t < kMostTries ? kShare * of_slopes.maxCoeff() : -1;
    std::vector<Eigen::Index> patches;
    for (Eigen::Index p = 0; p < n; ++p) {
      if (x.scaling[n + p] > 0 && of_slopes[p] > most) patches.push_back(p);
    }
    if (patches.empty()) return;
    drop_slopes(x, patches);
  }
}

}  // namespace

std::vector<Facet> facets_of(const scenes::PatchMesh& mesh) {
  std::vector<Facet> facets;
  facets.reserve(mesh.polygon.size());
  for (const auto& polygon : mesh.polygon) facets.push_back(make_facet(polygon));
  return facets;
}

ExchangeAreas compute_exchange(const scenes::PatchMesh& mesh, const Visibility& visibility,
                               const ExchangeOptions& options) {
  const Assembly assembly(mesh, visibility, options);
  const int blocks = blocks_for(mesh.polygon.size());
  ExchangeAreas exchange;
  exchange.modes = options.slopes != nullptr ? SlopeBasis::kModes : 1;
  exchange.area_m2 = Eigen::Map<const Eigen::ArrayXd>(mesh.area_m2.data(), mesh.size())
                         .replicate(exchange.modes, 1);
  exchange.unscaled = allocate(assembly, exchange.modes);

  std::atomic<std::int64_t> facing{0}, tested{0};
  std::vector<std::vector<PartialPair>> partial(static_cast<std::size_t>(blocks) *
                                                static_cast<std::size_t>(blocks));
  const auto for_each_tile = [&](const auto& visit) {
    tbb::parallel_for(0, blocks * blocks, [&](int index) {
      const int row = index / blocks, column = index % blocks;
      if (column < row) return;
      const std::int64_t at = exchange.unscaled.offset[exchange.unscaled.index(row, column)];
      if (at != SymmetricTiles::kAbsent) {
        visit(row, column, &exchange.unscaled.values[static_cast<std::size_t>(at)],
              partial[static_cast<std::size_t>(index)]);
      }
    });
  };
  for_each_tile([&](int row, int column, float* tile, std::vector<PartialPair>& pairs) {
    const Assembly::Counts counts = assembly.fill(row, column, tile, pairs);
    facing += counts.facing;
    tested += counts.tested;
  });
  exchange.facing_pairs = facing;
  exchange.tested_pairs = tested;
  for (const auto& pairs : partial) {
    exchange.partial_pairs += static_cast<std::int64_t>(pairs.size());
  }
  if (options.slopes != nullptr) {
    const SlopeAssembly slopes(assembly.facets(), *options.slopes, assembly.facing(), visibility);
    for_each_tile([&](int row, int column, const float*, const std::vector<PartialPair>& pairs) {
      slopes.fill(row, column, pairs, exchange.unscaled);
    });
  }
  close(exchange);
  if (exchange.modes > 1) contract(exchange);
  exchange.cluster = cluster_patches(mesh);
  exchange.cluster_exchange_m2 = exchange_between(exchange.cluster, exchange);
  return exchange;
}

ExchangeAreas close_exchange(const Eigen::MatrixXd& exchange_area_m2,
                             const Eigen::ArrayXd& area_m2) {
  const Eigen::MatrixXd& x = exchange_area_m2;
  if (x.rows() != x.cols() || x.rows() != area_m2.size() || x.rows() == 0 ||
      !(x.array() >= 0).all() || !(area_m2 > 0).all() || x != x.transpose()) {
    throw std::invalid_argument(fmt::format(
        "exchange areas {} x {} for {} areas: want a square, symmetric, non-negative matrix and "
        "positive areas",
        x.rows(), x.cols(), area_m2.size()));
  }
  ExchangeAreas exchange;
  exchange.area_m2 = area_m2;
  exchange.unscaled =
      allocate(blocks_for(static_cast<std::size_t>(x.rows())), [](int, int) { return true; });
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    for (Eigen::Index j = i / kTile * kTile; j < x.cols(); ++j) {
      const std::size_t tile =
          exchange.unscaled.index(static_cast<int>(i / kTile), static_cast<int>(j / kTile));
      exchange.unscaled.values[static_cast<std::size_t>(exchange.unscaled.offset[tile] +
                                                        i % kTile * kTile + j % kTile)] =
          static_cast<float>(x(i, j));
    }
  }
  close(exchange);
  return exchange;
}

}  // namespace solver
