// The product of the exchange matrix with a block of columns, beside other ways to compute it and
// what the machine could do at most. One thread, processor time; each product is measured in turn
// with the peak, and medians are reported: `of_peak` is the median of the ratios. Every benchmark
// fails if its product is wrong.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/exchange/tile_product.h"
#include "solver/rooms/transport.h"
#include "tests/bench/fma_peak.h"
#ifdef WITH_OPENBLAS
#include <cblas.h>
#endif

namespace {

using Eigen::Index;
template <typename T>
using Dense = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A full symmetric matrix of positive numbers, dense and in tiles.
struct Matrix {
  Dense<float> dense;
  solver::SymmetricTiles tiles;
};

template <typename T>
void fill(Dense<T>& values) {  // by a linear congruence
  std::uint32_t state = 1;
  for (Index k = 0; k < values.size(); ++k) {
    state = state * 1664525U + 1013904223U;
    values.data()[k] = static_cast<T>(state >> 8U) * static_cast<T>(0x1p-24);
  }
}

/// The last one asked for is kept.
const Matrix& matrix(Index n) {
  constexpr Index kEdge = 64;
  static Matrix m;
  if (m.dense.rows() == n) return m;
  m = {.dense = Dense<float>(n, n), .tiles = {.blocks = static_cast<int>(n / kEdge)}};
  fill(m.dense);
  m.dense.triangularView<Eigen::StrictlyLower>() = m.dense.transpose();
  for (Index row = 0; row < n; row += kEdge) {
    for (Index column = row; column < n; column += kEdge) {
      const Dense<float> tile = m.dense.block(row, column, kEdge, kEdge);
      m.tiles.offset.push_back(static_cast<std::int64_t>(m.tiles.values.size()));
      m.tiles.values.insert(m.tiles.values.end(), tile.data(), tile.data() + tile.size());
    }
  }
  return m;
}

double median(std::vector<double>& values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// Some rows against sums in double; rounding of sums of positive terms stays far below this.
template <typename T>
bool is_product(const Dense<float>& a, const Dense<T>& b, const Dense<T>& y) {
  const double tolerance = static_cast<double>(a.rows()) * Eigen::NumTraits<T>::epsilon();
  for (const Index i : {Index{0}, a.rows() / 2 + 5, a.rows() - 1}) {
    const Eigen::RowVectorXd exact = a.row(i).template cast<double>() * b.template cast<double>();
    const Eigen::RowVectorXd found = y.row(i).template cast<double>();
    if (!((found - exact).array().abs() <= tolerance * exact.array()).all()) return false;
  }
  return true;
}

/// @param multiply  y = matrix * b
template <typename T, typename Multiply>
void measure(benchmark::State& state, const Multiply& multiply) {
  const Matrix& m = matrix(state.range(0));
  Dense<T> b(m.dense.rows(), state.range(1)), y(b.rows(), b.cols());
  fill(b);
  const double flops = 2.0 * static_cast<double>(m.dense.size() * b.cols());
  std::vector<double> speed, share;
  for (auto _ : state) {
    const double start = bench::processor_s();
    multiply(m, b, y);
    const double took = bench::processor_s() - start;
    state.SetIterationTime(took);
    speed.push_back(flops / took);
    share.push_back(speed.back() / bench::fma_peak<T>());
  }
  if (!is_product(m.dense, b, y)) state.SkipWithError("wrong product");
  state.counters["FLOP/s"] = median(speed);
  state.counters["of_peak"] = median(share);
}

template <typename T>
void BM_Peak(benchmark::State& state) {
  std::vector<double> peak;
  for (auto _ : state) {
    const double start = bench::processor_s();
    peak.push_back(bench::fma_peak<T>());
    state.SetIterationTime(bench::processor_s() - start);
  }
  state.counters["FLOP/s"] = median(peak);
}

template <typename T>
void BM_Product(benchmark::State& state) {
  measure<T>(state, [](const Matrix& m, const Dense<T>& b, Dense<T>& y) {
    solver::multiply(m.tiles, b.data(), y.data(), static_cast<std::size_t>(b.cols()));
  });
}

void BM_EigenDense(benchmark::State& state) {
  measure<float>(state, [](const Matrix& m, const Dense<float>& b, Dense<float>& y) {
    y.noalias() = m.dense * b;
  });
}

void BM_EigenSymmetric(benchmark::State& state) {
  measure<float>(state, [](const Matrix& m, const Dense<float>& b, Dense<float>& y) {
    y.noalias() = m.dense.selfadjointView<Eigen::Upper>() * b;
  });
}

void sizes(benchmark::internal::Benchmark* bench) {
  bench->ArgNames({"patches", "bands"})->UseManualTime()->Unit(benchmark::kMillisecond);
  for (const int n : {512, 2048, 8192}) {
    for (const int columns : {32, 16, 48}) bench->Args({n, columns});
  }
}

BENCHMARK_TEMPLATE(BM_Peak, float)->UseManualTime();
BENCHMARK_TEMPLATE(BM_Peak, double)->UseManualTime();
BENCHMARK_TEMPLATE(BM_Product, float)->Apply(sizes);
BENCHMARK_TEMPLATE(BM_Product, double)->Apply(sizes);
BENCHMARK(BM_EigenDense)->Apply(sizes);
BENCHMARK(BM_EigenSymmetric)->Apply(sizes);

#ifdef WITH_OPENBLAS
void BM_BlasGemm(benchmark::State& state) {
  measure<float>(state, [](const Matrix& m, const Dense<float>& b, Dense<float>& y) {
    const auto n = static_cast<int>(b.rows()), columns = static_cast<int>(b.cols());
    cblas_sgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, n, columns, n, 1, m.dense.data(), n,
                b.data(), columns, 0, y.data(), columns);
  });
}

void BM_BlasSymm(benchmark::State& state) {
  measure<float>(state, [](const Matrix& m, const Dense<float>& b, Dense<float>& y) {
    const auto n = static_cast<int>(b.rows()), columns = static_cast<int>(b.cols());
    cblas_ssymm(CblasRowMajor, CblasLeft, CblasUpper, n, columns, 1, m.dense.data(), n, b.data(),
                columns, 0, y.data(), columns);
  });
}

BENCHMARK(BM_BlasGemm)->Apply(sizes);
BENCHMARK(BM_BlasSymm)->Apply(sizes);
#endif

/// Names what is compared, above the table.
const bool told = [] {
  solver::set_threads(1);
  benchmark::AddCustomContext("instruction set", bench::instruction_set());
#ifdef WITH_OPENBLAS
  openblas_set_num_threads(1);
  benchmark::AddCustomContext("BLAS", openblas_get_config());
#else
  benchmark::AddCustomContext("BLAS", "left out: CMake did not find OpenBLAS");
#endif
  return true;
}();

}  // namespace
