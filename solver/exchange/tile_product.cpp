#include "solver/exchange/tile_product.h"

#include <tbb/parallel_for.h>

#include <algorithm>

// Highway compiles this file once per instruction set and picks at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solver/exchange/tile_product.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace solver::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kEdge = kTile;

/// Rows kept in registers at once, two vectors each: 16 sums of 32 registers, or 8 of 16.
constexpr std::size_t kRows = HWY_MAX_BYTES >= 64 ? 8 : 4;

/// A tile, or its transpose with the strides exchanged.
template <typename T>
struct TileView {
  const T* values;
  std::size_t row_stride, column_stride;
  const float* ahead;  ///< half a tile that will be wanted soon
};

/// y[row..row + kCount) += a b over the 64 columns of the tile, kVectors vectors of each row.
template <std::size_t kCount, std::size_t kVectors, class D, typename T>
HWY_INLINE void add_rows(D d, const TileView<T>& a, std::size_t row, const T* b, T* y,
                         std::size_t columns) {
  constexpr std::size_t kUnrolled = 4;
  const std::size_t lanes = hn::Lanes(d);
  const T* column = a.values + row * a.row_stride;
  y += row * columns;
  hn::Vec<D> sum[kCount][kVectors];
  for (std::size_t r = 0; r < kCount; ++r) {
    for (std::size_t v = 0; v < kVectors; ++v)
      sum[r][v] = hn::LoadU(d, y + r * columns + v * lanes);
  }
  for (std::size_t k = 0; k < kEdge; k += kUnrolled) {
    hwy::Prefetch(a.ahead + (row * kEdge + k * kCount) / 2);
    for (std::size_t u = 0; u < kUnrolled; ++u) {
      hn::Vec<D> bk[kVectors];
      for (std::size_t v = 0; v < kVectors; ++v) bk[v] = hn::LoadU(d, b + v * lanes);
      for (std::size_t r = 0; r < kCount; ++r) {
        const auto ark = hn::Set(d, column[r * a.row_stride]);
        for (std::size_t v = 0; v < kVectors; ++v) sum[r][v] = hn::MulAdd(ark, bk[v], sum[r][v]);
      }
      column += a.column_stride;
      b += columns;
    }
  }
  for (std::size_t r = 0; r < kCount; ++r) {
    for (std::size_t v = 0; v < kVectors; ++v)
      hn::StoreU(sum[r][v], d, y + r * columns + v * lanes);
  }
}

/// y += a b
template <typename T>
HWY_INLINE void add_tile(const TileView<T>& a, const T* b, T* y, std::size_t columns) {
  const hn::CappedTag<T, kColumnPad> d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t c = 0;
  for (; c + 2 * lanes <= columns; c += 2 * lanes) {
    for (std::size_t r = 0; r < kEdge; r += kRows)
      add_rows<kRows, 2>(d, a, r, b + c, y + c, columns);
  }
  for (; c < columns; c += lanes) {
    for (std::size_t r = 0; r < kEdge; r += 2 * kRows)
      add_rows<2 * kRows, 1>(d, a, r, b + c, y + c, columns);
  }
}

/// y_row += tile b_column, and y_column += tile^T b_row unless the tile is on the diagonal.
template <typename T>
HWY_INLINE void add_both(const T* tile, const float* next, const TileOperands<T>& at) {
  add_tile(TileView<T>{tile, kEdge, 1, next}, at.b_column, at.y_row, at.columns);
  if (at.y_column == at.y_row) return;
  add_tile(TileView<T>{tile, 1, kEdge, next + kEdge * kEdge / 2}, at.b_row, at.y_column,
           at.columns);
}

void add_tile_float(const float* tile, const float* next, const TileOperands<float>& at) {
  add_both(tile, next, at);
}

void add_tile_double(const float* tile, const float* next, const TileOperands<double>& at) {
  const hn::CappedTag<double, kColumnPad> d;
  const hn::Rebind<float, decltype(d)> narrow;
  HWY_ALIGN double wide[kEdge * kEdge];
  for (std::size_t k = 0; k < kEdge * kEdge; k += hn::Lanes(d)) {
    hn::Store(hn::PromoteTo(d, hn::LoadU(narrow, tile + k)), d, wide + k);
  }
  add_both(wide, next, at);
}

/// The same with one column. Eight sums a row: as many as the longest vector holds, for equal
/// bits.
void add_tile_vector(const float* tile, const float* /*next*/, const TileOperands<double>& at) {
  constexpr std::size_t kSums = 8;
  const bool diagonal = at.y_column == at.y_row;
  for (std::size_t r = 0; r < kEdge; ++r) {
    const float* row = tile + r * kEdge;
    double sum[kSums] = {};
    for (std::size_t k = 0; k < kEdge; k += kSums) {
      for (std::size_t l = 0; l < kSums; ++l)
        sum[l] += static_cast<double>(row[k + l]) * at.b_column[k + l];
    }
    at.y_row[r] +=
        ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
    if (diagonal) continue;
    const double br = at.b_row[r];
    for (std::size_t k = 0; k < kEdge; ++k) at.y_column[k] += static_cast<double>(row[k]) * br;
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

constexpr std::size_t kEdge = kTile;

/// y = matrix * b: every tile is read once, and serves its rows and, transposed, its columns.
template <typename T, typename AddTile>
class Product {
 public:
  /// @param add_tile  one of the above
  Product(AddTile add_tile, const SymmetricTiles& matrix, const T* b, T* y, std::size_t columns)
      : add_tile_(add_tile),
        matrix_(matrix),
        b_(b),
        y_(y),
        columns_(columns),
        groups_(std::clamp(matrix.blocks / 4, std::min(matrix.blocks, 8), 32)) {}

  /// Rows of tiles are shared out to groups. In round k, groups g and k - g (modulo their number)
  /// are multiplied: every group is in one pair, so no two jobs write to the same rows, and rows
  /// are summed in the same order by any number of threads.
  void compute() const {
    std::fill_n(y_, static_cast<std::size_t>(matrix_.blocks) * kEdge * columns_, T{0});
    for (int round = 0; round < groups_; ++round) {
      tbb::parallel_for(0, groups_, [&](int g) {
        const int h = (round - g + groups_) % groups_;
        if (g <= h) add_pair(g, h);
      });
    }
  }

 private:
  [[nodiscard]] int begin(int group) const {
    return static_cast<int>(std::int64_t{matrix_.blocks} * group / groups_);
  }

  /// Fetches each tile during the one before: where groups have 4 rows and more, that is most.
  void add_pair(int g, int h) const {
    const float* tile = nullptr;
    TileOperands<T> at{};
    for (int row = begin(g); row < begin(g + 1); ++row) {
      for (int column = std::max(row, begin(h)); column < begin(h + 1); ++column) {
        const std::int64_t offset = matrix_.offset[matrix_.index(row, column)];
        if (offset == SymmetricTiles::kAbsent) continue;
        const float* next = matrix_.values.data() + offset;
        if (tile != nullptr) add_tile_(tile, next, at);
        tile = next;
        at = operands(row, column);
      }
    }
    if (tile != nullptr) add_tile_(tile, tile, at);
  }

  [[nodiscard]] TileOperands<T> operands(int row, int column) const {
    const std::size_t r = static_cast<std::size_t>(row) * kEdge * columns_;
    const std::size_t c = static_cast<std::size_t>(column) * kEdge * columns_;
    return {b_ + r, b_ + c, y_ + r, y_ + c, columns_};
  }

  AddTile add_tile_;
  const SymmetricTiles& matrix_;
  const T* b_;
  T* y_;
  std::size_t columns_;
  int groups_;
};

}  // namespace

float SymmetricTiles::at(int i, int j) const {
  const int edge = static_cast<int>(kEdge), low = std::min(i, j), high = std::max(i, j);
  const std::int64_t tile = offset[index(low / edge, high / edge)];
  if (tile == kAbsent) return 0;
  return values[static_cast<std::size_t>(tile + low % edge * edge + high % edge)];
}

void SymmetricTiles::set(int i, int j, float value) {
  const int edge = static_cast<int>(kEdge), low = std::min(i, j), high = std::max(i, j);
  const std::int64_t tile = offset[index(low / edge, high / edge)];
  values[static_cast<std::size_t>(tile + low % edge * edge + high % edge)] = value;
  if (low / edge == high / edge) {
    values[static_cast<std::size_t>(tile + high % edge * edge + low % edge)] = value;
  }
}

void multiply(const SymmetricTiles& matrix, const float* b, float* y, std::size_t columns) {
  Product(HWY_DYNAMIC_DISPATCH(add_tile_float), matrix, b, y, columns).compute();
}

void multiply(const SymmetricTiles& matrix, const double* b, double* y, std::size_t columns) {
  Product(HWY_DYNAMIC_DISPATCH(add_tile_double), matrix, b, y, columns).compute();
}

void multiply(const SymmetricTiles& matrix, const double* v, double* y) {
  Product(HWY_DYNAMIC_DISPATCH(add_tile_vector), matrix, v, y, 1).compute();
}

}  // namespace solver

#endif
