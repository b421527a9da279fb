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
#include "solver/factors/far_field.h"
#include "solver/factors/pair_factor.h"
#include "solver/factors/rectangle_pairs.h"

namespace solver {
namespace {

static_assert(kTile == kFarPatches);  // a row of a tile is what the far field takes at once
constexpr double kOnPlane_m = 1e-12;
constexpr std::size_t kTileSize = std::size_t{kTile} * kTile;

/// Which patches can face each other. For every plane of the mesh it holds how far each patch
/// reaches in front of it; where all patches of two planes are to each other alike, it looks no
/// further.
class FacingTable {
 public:
  enum class Pair : std::uint8_t { none, straddling, facing, mixed };

  explicit FacingTable(const scenes::PatchMesh& mesh)
      : patches_(mesh.polygon.size()), plane_of_(mesh.plane.begin(), mesh.plane.end()) {
    planes_ = *std::max_element(plane_of_.begin(), plane_of_.end()) + 1;
    std::vector<Plane> plane(planes_);
    for (std::size_t i = 0; i < patches_; ++i) {
      plane[plane_of_[i]] = {mesh.normal[i], mesh.normal[i].dot(mesh.centre[i])};
    }
    heights_.resize(planes_ * patches_);
    std::vector<Range> all(planes_ * planes_);
    for (std::size_t p = 0; p < planes_; ++p) {
      for (std::size_t j = 0; j < patches_; ++j) {
        Range& range = heights_[p * patches_ + j];
        for (const Eigen::Vector3d& v : mesh.polygon[j]) range.extend(plane[p].height_m(v));
        Range& of_plane = all[p * planes_ + plane_of_[j]];
        of_plane.extend(range.lowest_m);
        of_plane.extend(range.highest_m);
      }
    }
    for (std::size_t p = 0; p < planes_; ++p) {
      for (std::size_t q = 0; q < planes_; ++q) {
        const Pair pair = relation(all[p * planes_ + q], all[q * planes_ + p]);
        of_planes_.push_back(pair == Pair::straddling ? Pair::mixed : pair);
      }
    }
  }

  [[nodiscard]] Pair relation(std::size_t i, std::size_t j) const {
    const Pair pair = of_planes_[plane_of_[i] * planes_ + plane_of_[j]];
    return pair != Pair::mixed ? pair
                               : relation(heights_[plane_of_[i] * patches_ + j],
                                          heights_[plane_of_[j] * patches_ + i]);
  }

 private:
  struct Range {
    double lowest_m = 1e300, highest_m = -1e300;

    void extend(double height_m) {
      lowest_m = std::min(lowest_m, height_m);
      highest_m = std::max(highest_m, height_m);
    }
  };

  static Pair relation(const Range& j_over_i, const Range& i_over_j) {
    if (std::min(j_over_i.highest_m, i_over_j.highest_m) <= kOnPlane_m) return Pair::none;
    return std::min(j_over_i.lowest_m, i_over_j.lowest_m) >= -kOnPlane_m ? Pair::facing
                                                                         : Pair::straddling;
  }

  std::size_t patches_, planes_ = 0;
  std::vector<std::size_t> plane_of_;
  std::vector<Range> heights_;   ///< [plane][patch]
  std::vector<Pair> of_planes_;  ///< [plane][plane]
};

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
    std::int64_t facing = 0, tested = 0, partial = 0;
  };

  [[nodiscard]] bool any_facing(int row, int column) const {
    if (!options_.skip) return true;
    for (std::size_t i = begin(row); i < end(row); ++i) {
      for (std::size_t j = begin(column); j < end(column); ++j) {
        if (facing_.relation(i, j) != FacingTable::Pair::none) return true;
      }
    }
    return false;
  }

  Counts fill(int row, int column, float* tile) const {
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
      hide(i, first, column, line, counts);
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

  void hide(std::size_t i, std::size_t first, int column, float* line, Counts& counts) const {
    if (visibility_.unobstructed()) return;
    for (std::size_t j = first; j < end(column); ++j) {
      float& value = line[j - begin(column)];
      const int pi = static_cast<int>(i), pj = static_cast<int>(j);
      if (value == 0 || !visibility_.may_block(pi, pj)) continue;
      ++counts.tested;
      const bool lamp = !options_.lamp.empty() && (options_.lamp[i] || options_.lamp[j]);
      const std::uint64_t seed = static_cast<std::uint64_t>(i) << 32U | j;
      const double share =
          visibility_
              .between(facets_[i], visibility_.separation(pi), facets_[j],
                       visibility_.separation(pj), seed, lamp ? options_.lamp_rays : options_.rays)
              .share;
      if (share > 0 && share < 1) ++counts.partial;
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
  exchange.area_m2 = Eigen::Map<const Eigen::ArrayXd>(mesh.area_m2.data(), mesh.size());
  exchange.unscaled =
      allocate(blocks, [&](int row, int column) { return assembly.any_facing(row, column); });

  std::atomic<std::int64_t> facing{0}, tested{0}, partial{0};
  tbb::parallel_for(0, blocks * blocks, [&](int index) {
    const int row = index / blocks, column = index % blocks;
    if (column < row) return;
    const std::int64_t at = exchange.unscaled.offset[exchange.unscaled.index(row, column)];
    if (at == SymmetricTiles::kAbsent) return;
    const Assembly::Counts counts =
        assembly.fill(row, column, &exchange.unscaled.values[static_cast<std::size_t>(at)]);
    facing += counts.facing;
    tested += counts.tested;
    partial += counts.partial;
  });
  exchange.facing_pairs = facing;
  exchange.tested_pairs = tested;
  exchange.partial_pairs = partial;
  close(exchange);
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
