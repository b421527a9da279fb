#include "solver/exchange.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>

#include "solver/closure.h"
#include "solver/coarse_room.h"
#include "solver/far_field.h"
#include "solver/pair_factor.h"

namespace solver {
namespace {

constexpr double kOnPlane_m = 1e-12;
constexpr std::size_t kTileSize = std::size_t{kTile} * kTile;

/// For every plane of the mesh, how far each patch reaches in front of it: says which pairs can
/// face each other.
class FacingTable {
 public:
  explicit FacingTable(const scenes::PatchMesh& mesh)
      : patches_(mesh.polygon.size()), plane_of_(mesh.plane) {
    const int planes = *std::max_element(plane_of_.begin(), plane_of_.end()) + 1;
    std::vector<Plane> plane(static_cast<std::size_t>(planes));
    for (std::size_t i = 0; i < patches_; ++i) {
      plane[at(i)] = {mesh.normal[i], mesh.normal[i].dot(mesh.centre[i])};
    }
    heights_.resize(plane.size() * patches_);
    for (std::size_t p = 0; p < plane.size(); ++p) {
      for (std::size_t j = 0; j < patches_; ++j) {
        Range& range = heights_[p * patches_ + j];
        for (const Eigen::Vector3d& v : mesh.polygon[j]) {
          const double h = plane[p].height_m(v);
          range.lowest_m = std::min(range.lowest_m, h);
          range.highest_m = std::max(range.highest_m, h);
        }
      }
    }
  }

  enum class Pair { none, straddling, facing };

  [[nodiscard]] Pair relation(std::size_t i, std::size_t j) const {
    const Range &j_over_i = heights_[at(i) * patches_ + j],
                &i_over_j = heights_[at(j) * patches_ + i];
    if (std::min(j_over_i.highest_m, i_over_j.highest_m) <= kOnPlane_m) return Pair::none;
    return std::min(j_over_i.lowest_m, i_over_j.lowest_m) >= -kOnPlane_m ? Pair::facing
                                                                         : Pair::straddling;
  }

 private:
  struct Range {
    double lowest_m = 1e300, highest_m = -1e300;
  };

  [[nodiscard]] std::size_t at(std::size_t i) const {
    return static_cast<std::size_t>(plane_of_[i]);
  }

  std::size_t patches_;
  std::vector<int> plane_of_;
  std::vector<Range> heights_;
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
        options_(options) {}

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
    std::array<float, kTile> x{};
    for (std::size_t i = begin(row); i < end(row); ++i) {
      x.fill(0);
      const std::size_t first = row == column ? i + 1 : begin(column);
      unoccluded(i, first, column, x, counts);
      hide(i, first, column, x, counts);
      float* line = tile + (i - begin(row)) * kTile;
      for (std::size_t j = first; j < end(column); ++j) {
        line[j - begin(column)] = x[j - begin(column)];
        if (row == column) tile[(j - begin(row)) * kTile + (i - begin(row))] = x[j - begin(column)];
      }
    }
    return counts;
  }

 private:
  static std::size_t begin(int block) { return static_cast<std::size_t>(block) * kTile; }

  [[nodiscard]] std::size_t end(int block) const {
    return std::min(begin(block) + kTile, facets_.size());
  }

  void unoccluded(std::size_t i, std::size_t first, int column, std::array<float, kTile>& x,
                  Counts& counts) const {
    std::array<int, kTile> order{};
    for (std::size_t j = first; j < end(column); ++j) {
      const FacingTable::Pair pair = facing_.relation(i, j);
      if (pair != FacingTable::Pair::none) {
        ++counts.facing;
      } else if (options_.skip) {
        continue;
      }
      const Facet &fi = facets_[i], &fj = facets_[j];
      const double ratio = (fi.centre - fj.centre).norm() / std::max(fi.size_m, fj.size_m);
      const std::size_t k = j - begin(column);
      if (pair == FacingTable::Pair::facing && far_.has_rule(i) && far_.has_rule(j)) {
        order[k] = far_field_order(ratio);
      }
      if (order[k] == 0) x[k] = static_cast<float>(exchange_area(fi, fj));
    }
    far_.exchange(i, begin(column), order, x);
  }

  void hide(std::size_t i, std::size_t first, int column, std::array<float, kTile>& x,
            Counts& counts) const {
    if (visibility_.unobstructed()) return;
    for (std::size_t j = first; j < end(column); ++j) {
      float& value = x[j - begin(column)];
      if (value == 0 || !visibility_.may_block(static_cast<int>(i), static_cast<int>(j))) continue;
      ++counts.tested;
      const bool lamp = !options_.lamp.empty() && (options_.lamp[i] || options_.lamp[j]);
      const std::uint64_t seed = static_cast<std::uint64_t>(i) << 32U | j;
      const double share =
          visibility_
              .between(facets_[i], facets_[j], seed, lamp ? options_.lamp_rays : options_.rays)
              .share;
      if (share > 0 && share < 1) ++counts.partial;
      value *= static_cast<float>(share);
    }
  }

  std::vector<Facet> facets_;
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

double ExchangeAreas::form_factor(int i, int j) const {
  return scaling[i] * unscaled.at(i, j) * scaling[j] / area_m2[i];
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
