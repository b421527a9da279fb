#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "solver/exchange/huge_pages.h"

namespace solver {

/// Patches of one tile row or column; a multiple of every vector length.
inline constexpr int kTile = 64;

/// A symmetric matrix in float: tiles of kTile x kTile on and above the diagonal, row-major inside;
/// tiles that are all zero are not stored.
struct SymmetricTiles {
  static constexpr std::int64_t kAbsent = -1;

  int blocks = 0;                               ///< tiles along an edge
  std::vector<float, HugePages<float>> values;  ///< stored tiles, one after another
  std::vector<std::int64_t> offset;  ///< of tile (row, column), row <= column, in `values`; kAbsent

  [[nodiscard]] std::size_t index(int row, int column) const {
    const auto r = static_cast<std::size_t>(row), c = static_cast<std::size_t>(column);
    return r * (2 * static_cast<std::size_t>(blocks) - r + 1) / 2 + (c - r);
  }

  /// Entry (i, j) of the matrix.
  [[nodiscard]] float at(int i, int j) const;

  /// Also at (j, i); of a tile that is stored.
  void set(int i, int j, float value);
};

/// Columns of the dense operands are padded to a multiple of this.
inline constexpr std::size_t kColumnPad = 16;

/// y = matrix * b, dense operands row-major with 64 * blocks rows and `columns` (a multiple of
/// kColumnPad) columns. The order in which rows of y are summed depends on the number of blocks
/// alone, not on that of threads. In double the entries are widened exactly.
void multiply(const SymmetricTiles& matrix, const float* b, float* y, std::size_t columns);
void multiply(const SymmetricTiles& matrix, const double* b, double* y, std::size_t columns);

/// The same of a vector of 64 * blocks numbers.
void multiply(const SymmetricTiles& matrix, const double* v, double* y);

/// The rows of the dense operands that a tile connects, as the kernels take them.
template <typename T>
struct TileOperands {
  const T *b_row, *b_column;
  T *y_row, *y_column;  ///< the same for a tile on the diagonal
  std::size_t columns;
};

}  // namespace solver
