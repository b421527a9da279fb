#include "tests/bench/fma_peak.h"

#include <benchmark/benchmark.h>

#include <cstddef>
#include <ctime>

// Highway compiles this file once per instruction set and picks at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/bench/fma_peak.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace bench::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A latency of 4 on two ports needs 8; 12 leave slack, and fit into 16 registers.
constexpr std::size_t kSums = 12;
constexpr int kSteps = 100000;

template <typename T>
double peak() {
  const hn::ScalableTag<T> d;
  const auto factor = hn::Set(d, static_cast<T>(0.5));
  hn::Vec<decltype(d)> sum[kSums];
  for (std::size_t s = 0; s < kSums; ++s) sum[s] = hn::Iota(d, static_cast<T>(s));
  const double start = processor_s();
  for (int step = 0; step < kSteps; ++step) {
    for (std::size_t s = 0; s < kSums; ++s) sum[s] = hn::MulAdd(sum[s], factor, factor);
  }
  for (std::size_t s = 1; s < kSums; ++s) sum[0] = hn::Add(sum[0], sum[s]);
  T total = hn::GetLane(hn::SumOfLanes(d, sum[0]));
  benchmark::DoNotOptimize(total);
  const double flops = 2.0 * kSteps * kSums * static_cast<double>(hn::Lanes(d));
  return flops / (processor_s() - start);
}

double peak_float() { return peak<float>(); }

double peak_double() { return peak<double>(); }

const char* name() { return hwy::TargetName(HWY_TARGET); }

}  // namespace bench::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace bench {

HWY_EXPORT(peak_float);
HWY_EXPORT(peak_double);
HWY_EXPORT(name);

double processor_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <>
double fma_peak<float>() {
  return HWY_DYNAMIC_DISPATCH(peak_float)();
}

template <>
double fma_peak<double>() {
  return HWY_DYNAMIC_DISPATCH(peak_double)();
}

const char* instruction_set() { return HWY_DYNAMIC_DISPATCH(name)(); }

}  // namespace bench

#endif
