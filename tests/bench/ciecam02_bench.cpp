#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include "appearance/ciecam02.h"

namespace appearance {
namespace {

const Adaptation& daylight() {
  static const Adaptation kAdaptation = adapt({.white = {95.05, 100, 108.88},
                                               .adapting_luminance_cd_m2 = 318.31,
                                               .background_y = 20,
                                               .surround = {}});
  return kAdaptation;
}

/// Colours all over the solid, in no order a branch predictor could learn.
std::vector<spectra::RelativeXyz> stimuli() {
  std::mt19937 draw(1);
  std::uniform_real_distribution<double> y(5, 95), tint(0.8, 1.2);
  std::vector<spectra::RelativeXyz> all(1 << 14);
  for (auto& s : all) {
    const double grey = y(draw);
    s = {grey * tint(draw), grey, grey * tint(draw)};
  }
  return all;
}

/// A fast wrong answer ends the benchmark.
void require_right(double computed, double wanted) {
  if (std::abs(computed - wanted) <= 1e-9 * std::abs(wanted)) return;
  std::fprintf(stderr, "wrong answer: %.17g instead of %.17g\n", computed, wanted);
  std::exit(1);
}

void BM_Ciecam02Forward(benchmark::State& state) {
  // The first worked example of the model, in 50-digit arithmetic.
  const Correlates example = ciecam02_forward({19.01, 20, 21.78}, daylight());
  require_right(example.lightness, 41.731091132513911);
  require_right(example.chroma, 0.10470775717113408);
  require_right(example.hue_quadrature, 278.0607358566738);

  const auto samples = stimuli();
  for (auto _ : state) {
    for (const auto& s : samples) benchmark::DoNotOptimize(ciecam02_forward(s, daylight()));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<long>(samples.size()));
}

void BM_Ciecam02Inverse(benchmark::State& state) {
  const auto samples = stimuli();
  std::vector<LightnessChromaHue> wished;
  for (const auto& s : samples) {
    const Correlates p = ciecam02_forward(s, daylight());
    wished.push_back({p.lightness, p.chroma, p.hue_deg});
    require_right(ciecam02_inverse(wished.back(), daylight()).x, s.x);
  }
  for (auto _ : state) {
    for (const auto& w : wished) benchmark::DoNotOptimize(ciecam02_inverse(w, daylight()));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<long>(samples.size()));
}

BENCHMARK(BM_Ciecam02Forward);
BENCHMARK(BM_Ciecam02Inverse);

}  // namespace
}  // namespace appearance
