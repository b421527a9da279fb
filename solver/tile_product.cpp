#include "solver/tile_product.h"

#include <tbb/parallel_for.h>

#include <algorithm>

// Highway compiles this file once per instruction set and picks at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solver/tile_product.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace solver::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kEdge = 64;

/// Rows kept in registers at once, two vectors each: 16 sums of 32 registers, or 8 of 16.
constexpr std::size_t kRows = HWY_MAX_BYTES >= 64 ? 8 : 4;

/// y[0..kRows) += a[0..kRows) b over the 64 columns of a tile; a transposed tile has its strides
/// exchanged.
template <class D, typename T, std::size_t kVectors>
HWY_INLINE void add_rows(D d, const float* a, std::size_t row_stride, std::size_t column_stride,
                         const T* b, T* y, std::size_t columns) {
  const std::size_t lanes = hn::Lanes(d);
  hn::Vec<D> sum[kRows][kVectors];
  for (std::size_t r = 0; r < kRows; ++r) {
    for (std::size_t v = 0; v < kVectors; ++v)
      sum[r][v] = hn::LoadU(d, y + r * columns + v * lanes);
  }
  for (std::size_t k = 0; k < kEdge; ++k) {
    hn::Vec<D> bk[kVectors];
    for (std::size_t v = 0; v < kVectors; ++v) bk[v] = hn::LoadU(d, b + k * columns + v * lanes);
    for (std::size_t r = 0; r < kRows; ++r) {
      const auto ark = hn::Set(d, static_cast<T>(a[r * row_stride + k * column_stride]));
      for (std::size_t v = 0; v < kVectors; ++v) sum[r][v] = hn::MulAdd(ark, bk[v], sum[r][v]);
    }
  }
  for (std::size_t r = 0; r < kRows; ++r) {
    for (std::size_t v = 0; v < kVectors; ++v)
      hn::StoreU(sum[r][v], d, y + r * columns + v * lanes);
  }
}

template <typename T>
HWY_INLINE void add_tile(const float* tile, bool transposed, const T* b, T* y,
                         std::size_t columns) {
  const hn::CappedTag<T, kColumnPad> d;
  const std::size_t lanes = hn::Lanes(d);
  const std::size_t row_stride = transposed ? 1 : kEdge, column_stride = transposed ? kEdge : 1;
  for (std::size_t r = 0; r < kEdge; r += kRows) {
    const float* rows = tile + r * row_stride;
    std::size_t c = 0;
    for (; c + 2 * lanes <= columns; c += 2 * lanes) {
      add_rows<decltype(d), T, 2>(d, rows, row_stride, column_stride, b + c, y + r * columns + c,
                                  columns);
    }
    for (; c < columns; c += lanes) {
      add_rows<decltype(d), T, 1>(d, rows, row_stride, column_stride, b + c, y + r * columns + c,
                                  columns);
    }
  }
}

void add_tile_float(const float* tile, bool transposed, const float* b, float* y,
                    std::size_t columns) {
  add_tile(tile, transposed, b, y, columns);
}

void add_tile_double(const float* tile, bool transposed, const double* b, double* y,
                     std::size_t columns) {
  add_tile(tile, transposed, b, y, columns);
}

/// y += a v over a tile. Eight sums a row: as many as the longest vector holds, for equal bits.
void add_tile_vector(const float* tile, bool transposed, const double* v, double* y) {
  constexpr std::size_t kSums = 8;
  if (transposed) {
    for (std::size_t k = 0; k < kEdge; ++k) {
      for (std::size_t r = 0; r < kEdge; ++r)
        y[r] += static_cast<double>(tile[k * kEdge + r]) * v[k];
    }
    return;
  }
  for (std::size_t r = 0; r < kEdge; ++r) {
    double sum[kSums] = {};
    for (std::size_t k = 0; k < kEdge; k += kSums) {
      for (std::size_t l = 0; l < kSums; ++l) {
        sum[l] += static_cast<double>(tile[r * kEdge + k + l]) * v[k + l];
      }
    }
    y[r] += ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
  }
}

}  // namespace solver::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace solver {
namespace {

HWY_EXPORT(add_tile_float);
HWY_EXPORT(add_tile_double);
HWY_EXPORT(add_tile_vector);

constexpr std::size_t kEdge = 64;

/// add_tile(tile, transposed, rows of b, rows of y) over the tiles of each row, in their order.
template <typename T, typename AddTile>
void multiply_with(const AddTile& add_tile, const SymmetricTiles& matrix, const T* b, T* y,
                   std::size_t columns) {
  tbb::parallel_for(0, matrix.blocks, [&](int row) {
    const std::size_t block_size = kEdge * columns;
    T* y_rows = y + static_cast<std::size_t>(row) * block_size;
    std::fill_n(y_rows, block_size, T{0});
    for (int column = 0; column < matrix.blocks; ++column) {
      const std::int64_t at =
          matrix.offset[matrix.index(std::min(row, column), std::max(row, column))];
      if (at == SymmetricTiles::kAbsent) continue;
      add_tile(&matrix.values[static_cast<std::size_t>(at)], column < row,
               b + static_cast<std::size_t>(column) * block_size, y_rows);
    }
  });
}

}  // namespace

float SymmetricTiles::at(int i, int j) const {
  const int edge = static_cast<int>(kEdge), low = std::min(i, j), high = std::max(i, j);
  const std::int64_t tile = offset[index(low / edge, high / edge)];
  if (tile == kAbsent) return 0;
  return values[static_cast<std::size_t>(tile + low % edge * edge + high % edge)];
}

void multiply(const SymmetricTiles& matrix, const float* b, float* y, std::size_t columns) {
  auto* const add = HWY_DYNAMIC_DISPATCH(add_tile_float);
  const auto add_tile = [&](const float* tile, bool transposed, const float* from, float* to) {
    add(tile, transposed, from, to, columns);
  };
  multiply_with(add_tile, matrix, b, y, columns);
}

void multiply(const SymmetricTiles& matrix, const double* b, double* y, std::size_t columns) {
  auto* const add = HWY_DYNAMIC_DISPATCH(add_tile_double);
  const auto add_tile = [&](const float* tile, bool transposed, const double* from, double* to) {
    add(tile, transposed, from, to, columns);
  };
  multiply_with(add_tile, matrix, b, y, columns);
}

void multiply(const SymmetricTiles& matrix, const double* v, double* y) {
  multiply_with(HWY_DYNAMIC_DISPATCH(add_tile_vector), matrix, v, y, 1);
}

}  // namespace solver

#endif
