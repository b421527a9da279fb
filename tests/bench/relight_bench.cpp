// Relighting without files: pixels per second of a picture of 4096 x 2048, beside copying it. Fails
// if the answer is wrong.
#include <Imath/half.h>
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstring>
#include <thread>
#include <vector>

#include "appearance/spectra/relighting.h"
#include "apps/pictures/exr_block.h"

namespace {

constexpr int kWidth = 4096, kHeight = 2048;

void report(benchmark::State& state) {
  state.counters["pixels/s"] =
      benchmark::Counter(double{kWidth} * kHeight, benchmark::Counter::kIsIterationInvariantRate);
}

void fill(const Imf::FrameBuffer& slices, Imf::PixelType type) {
  for (const char* name : {"R", "G", "B"}) {
    char* samples = slices[name].base;
    const float level = 0.3F + 0.2F * static_cast<float>(name[0] % 3);
    for (std::size_t k = 0; k < std::size_t{kWidth} * kHeight; ++k) {
      const float value = level * (1 + 0.5F * static_cast<float>(k % 64) / 64);
      if (type == Imf::HALF) {
        reinterpret_cast<half*>(samples)[k] = half(value);
      } else {
        reinterpret_cast<float*>(samples)[k] = value;
      }
    }
  }
}

/// There and back again, so that values stay where they are.
void BM_Relight(benchmark::State& state, Imf::PixelType type) {
  const Imath::Box2i window({0, 0}, {kWidth - 1, kHeight - 1});
  Imf::ChannelList channels;
  for (const char* name : {"R", "G", "B"}) channels.insert(name, Imf::Channel(type));
  apps::ExrBlock block(channels, kWidth, kHeight);
  fill(block.at(window), type);
  const spectra::BilinearSet& set = spectra::bilinear_set("granier-iso");
  const Eigen::Vector3d sky{0.4, 0.9, 1.0}, yellow{1.0, 0.9, 0.1};
  const Eigen::Matrix3f there = spectra::relighting_matrix(set, sky, yellow).cast<float>();
  const Eigen::Matrix3f back = spectra::relighting_matrix(set, yellow, sky).cast<float>();
  const auto threads = static_cast<int>(state.range(0));
  double first_mean = 0;
  bool odd = false;
  for (auto _ : state) {
    const apps::PixelStatistics s = block.relight(odd ? back : there, threads);
    if (first_mean == 0) first_mean = s.before[0].sum;
    const double mean = odd ? s.after[0].sum : s.before[0].sum;
    if (!(std::abs(mean / first_mean - 1) < 0.05)) state.SkipWithError("wrong colours");
    odd = !odd;
  }
  report(state);
}

void BM_Copy(benchmark::State& state) {
  const std::size_t floats = std::size_t{kWidth} * kHeight * 3;
  std::vector<float> from(floats, 1), to(floats);
  const auto threads = static_cast<std::size_t>(state.range(0));
  for (auto _ : state) {
    std::vector<std::jthread> workers;
    for (std::size_t k = 0; k < threads; ++k) {
      workers.emplace_back([&, k] {
        const std::size_t first = k * floats / threads, last = (k + 1) * floats / threads;
        std::memcpy(&to[first], &from[first], (last - first) * sizeof(float));
      });
    }
  }
  if (to.back() != 1) state.SkipWithError("wrong copy");
  report(state);
}

BENCHMARK_CAPTURE(BM_Relight, float, Imf::FLOAT)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(BM_Relight, half, Imf::HALF)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(BM_Copy)->ArgName("threads")->Arg(1)->Arg(2)->MeasureProcessCPUTime()->UseRealTime();

}  // namespace
