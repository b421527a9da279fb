#include "solver/exchange/tile_product.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <random>

#include "solver/rooms/transport.h"

namespace solver {
namespace {

constexpr int kEdge = 64;
template <typename T>
using Dense = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Symmetric numbers from 0 to 1, and the same in tiles. @param absent  whether a tile is zero
template <typename Absent>
SymmetricTiles random_tiles(int blocks, Absent absent) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0, 1);
  SymmetricTiles tiles{.blocks = blocks};
  for (int row = 0; row < blocks; ++row) {
    for (int column = row; column < blocks; ++column) {
      tiles.offset.push_back(absent(row, column) ? SymmetricTiles::kAbsent
                                                 : static_cast<std::int64_t>(tiles.values.size()));
      if (absent(row, column)) continue;
      Dense<float> tile = Dense<float>::NullaryExpr(kEdge, kEdge, [&] { return uniform(random); });
      if (row == column) tile = (tile + tile.transpose()).eval();
      tiles.values.insert(tiles.values.end(), tile.data(), tile.data() + tile.size());
    }
  }
  return tiles;
}

template <typename T>
Dense<T> random_columns(int rows, int columns) {
  std::mt19937 random(2);
  std::uniform_real_distribution<T> uniform(0, 1);
  return Dense<T>::NullaryExpr(rows, columns, [&] { return uniform(random); });
}

template <typename T>
Dense<T> product(const SymmetricTiles& tiles, const Dense<T>& b) {
  Dense<T> y = Dense<T>::Constant(b.rows(), b.cols(), -1);  // must not be read
  multiply(tiles, b.data(), y.data(), static_cast<std::size_t>(b.cols()));
  return y;
}

/// Groups of one block, of several, uneven; columns of one vector and more.
class TileProduct : public testing::TestWithParam<std::pair<int, int>> {};

INSTANTIATE_TEST_SUITE_P(BlocksAndColumns, TileProduct,
                         testing::Values(std::pair{1, 16}, std::pair{2, 32}, std::pair{7, 48},
                                         std::pair{8, 32}, std::pair{11, 64}, std::pair{17, 16}));

TEST_P(TileProduct, IsThatOfTheDenseMatrix) {
  const auto [blocks, columns] = GetParam();
  const int n = blocks * kEdge;
  const SymmetricTiles tiles =
      random_tiles(blocks, [](int row, int column) { return (row + 2 * column) % 5 == 1; });
  const Dense<double> a = Dense<double>::NullaryExpr(n, n, [&](Eigen::Index i, Eigen::Index j) {
    return tiles.at(static_cast<int>(i), static_cast<int>(j));
  });
  const Dense<double> b = random_columns<double>(n, columns), exact = a * b;
  // Rounding grows with the number of terms, all of them positive.
  const double in_double = n * 1e-16, in_float = n * 6e-8;
  EXPECT_TRUE(((product(tiles, b) - exact).array().abs() <= in_double * exact.array()).all());
  const Dense<float> narrow = b.cast<float>();
  EXPECT_TRUE(
      ((product(tiles, narrow).cast<double>() - exact).array().abs() <= in_float * exact.array())
          .all());
  const Eigen::VectorXd v = b.col(0);
  Eigen::VectorXd y(n);
  multiply(tiles, v.data(), y.data());
  EXPECT_TRUE(((y - exact.col(0)).array().abs() <= in_double * exact.col(0).array()).all());
}

TEST(TileProduct, HasTheSameBitsForAnyNumberOfThreads) {
  constexpr int kBlocks = 13;
  const SymmetricTiles tiles = random_tiles(kBlocks, [](int, int) { return false; });
  const auto floats = random_columns<float>(kBlocks * kEdge, 32);
  const auto doubles = random_columns<double>(kBlocks * kEdge, 32);
  const auto with_threads = [&](int threads, const auto& b) {
    set_threads(threads);
    const auto y = product(tiles, b);
    set_threads(2);
    return y;
  };
  for (const int threads : {2, 5}) {
    EXPECT_EQ(with_threads(1, floats), with_threads(threads, floats));
    EXPECT_EQ(with_threads(1, doubles), with_threads(threads, doubles));
  }
}

}  // namespace
}  // namespace solver
