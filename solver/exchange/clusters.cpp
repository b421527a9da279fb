#include "solver/exchange/clusters.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace solver {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using RowArray = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double kUsualClusters = 64;
constexpr std::size_t kMostClusters = 256;  ///< factoring them costs less than a sweep or two

/// X_ij d_j summed over the patches j of each cluster, for the rows i of a row of tiles.
Eigen::ArrayXXd row_sums(const std::vector<int>& cluster, Index clusters,
                         const ExchangeAreas& exchange, int row) {
  const SymmetricTiles& tiles = exchange.unscaled;
  Eigen::ArrayXXd sum = Eigen::ArrayXXd::Zero(kTile, clusters);
  for (int column = 0; column * kTile < exchange.patches(); ++column) {
    const std::int64_t at = tiles.offset[tiles.index(std::min(row, column), std::max(row, column))];
    if (at == SymmetricTiles::kAbsent) continue;
    const Eigen::Map<const Eigen::Array<float, kTile, kTile, Eigen::RowMajor>> tile(
        &tiles.values[static_cast<std::size_t>(at)]);
    const int first = column * kTile, size = std::min(kTile, exchange.patches() - first);
    for (int k = 0; k < size; ++k) {
      const double d = exchange.scaling[first + k];
      auto to = sum.col(cluster[static_cast<std::size_t>(first + k)]);
      if (column < row) {
        to += d * tile.row(k).transpose().cast<double>();
      } else {
        to += d * tile.col(k).cast<double>();
      }
    }
  }
  return sum;
}

}  // namespace

std::vector<int> cluster_patches(const scenes::PatchMesh& mesh) {
  std::map<int, Eigen::AlignedBox3d> extent;
  for (std::size_t i = 0; i < mesh.polygon.size(); ++i) {
    extent[mesh.surface[i]].extend(mesh.centre[i]);
  }
  const double area_m2 = std::accumulate(mesh.area_m2.begin(), mesh.area_m2.end(), 0.0);
  const double edge_m = std::sqrt(area_m2 / kUsualClusters);
  std::map<std::array<int, 4>, int> cells;
  std::vector<int> cluster;
  for (std::size_t i = 0; i < mesh.polygon.size(); ++i) {
    const Eigen::AlignedBox3d& box = extent[mesh.surface[i]];
    std::array<int, 4> cell{mesh.surface[i], 0, 0, 0};
    for (Index axis = 0; axis < 3; ++axis) {
      const double length_m = box.sizes()[axis], at_m = mesh.centre[i][axis] - box.min()[axis];
      const double count = std::floor(length_m / edge_m) + 1;
      const double index = length_m > 0 ? std::floor(at_m / length_m * count) : 0;
      cell[static_cast<std::size_t>(axis) + 1] = static_cast<int>(std::min(index, count - 1));
    }
    cluster.push_back(cells.emplace(cell, static_cast<int>(cells.size())).first->second);
  }
  if (cells.size() > kMostClusters) cluster.clear();
  return cluster;
}

MatrixXd exchange_between(const std::vector<int>& cluster, const ExchangeAreas& exchange) {
  if (cluster.empty()) return {};
  const Index n = exchange.patches();
  const Index clusters = *std::max_element(cluster.begin(), cluster.end()) + 1;
  RowArray sent(n, clusters);  // A_i F_ij, summed over the patches j of a cluster
  const auto blocks = static_cast<int>((n + kTile - 1) / kTile);  // that have means
  tbb::parallel_for(0, blocks, [&](int row) {
    const Index first = Index{row} * kTile, size = std::min<Index>(kTile, n - first);
    sent.middleRows(first, size) =
        row_sums(cluster, clusters, exchange, row).topRows(size).colwise() *
        exchange.scaling.segment(first, size);
  });
  MatrixXd sum = MatrixXd::Zero(clusters, clusters);
  for (Index i = 0; i < n; ++i)
    sum.row(cluster[static_cast<std::size_t>(i)]) += sent.row(i).matrix();
  return sum;
}

}  // namespace solver
