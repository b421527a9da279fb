// Bilinear against classical three-number radiosity [Granier2004], Jacobi against Jacobi.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <string>
#include <vector>

#include "scenes/files/room_json.h"
#include "solver/rooms/room_colour.h"

namespace {

/// Of all threads: what else the machine does counts little.
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Solves by both models in turn. Counters are medians; the overhead of a solve is the median of
/// the ratios of neighbours. Bounces fade at different rates in the two, so that a solve may take
/// fewer sweeps in one of them: the overhead of a sweep is the price of the matrices.
void BM_BilinearOverhead(benchmark::State& state, const char* name) {
  const scenes::Room room =
      scenes::read_room(std::string(SOURCE_DIR) + "/scenes/rooms/" + name + ".json");
  const double start = cpu_seconds();
  const solver::RoomTransport transport =
      solver::prepare_transport(room, {.patch_m = 0.001 * static_cast<double>(state.range(0))});
  const double transport_s = cpu_seconds() - start;
  const solver::ColourModel classical = solver::colour_model("rgb:iso"),
                            bilinear = solver::colour_model("bilinear:iso");
  std::vector<double> classical_s, bilinear_s, ratio;
  int classical_sweeps = 0, bilinear_sweeps = 0;
  const auto solve = [&](const solver::ColourModel& model, int& sweeps) {
    const double begin = cpu_seconds();
    const solver::ColourSolution solution = solver::solve_room_colour(
        room, transport, model, {.method = solver::Method::jacobi, .relative_error = 1e-6});
    const double seconds = cpu_seconds() - begin;
    sweeps = solution.light.radiosity.bands[0].iterations;
    if (!solution.light.radiosity.converged || !(solution.light.energy.relative_defect < 1e-5)) {
      state.SkipWithError("not converged");
    }
    return seconds;
  };
  for (auto _ : state) {
    classical_s.push_back(solve(classical, classical_sweeps));
    bilinear_s.push_back(solve(bilinear, bilinear_sweeps));
    ratio.push_back(bilinear_s.back() / classical_s.back());
    state.SetIterationTime(bilinear_s.back());
  }
  const double sweep_ratio = median(ratio) * classical_sweeps / bilinear_sweeps;
  const double whole = transport_s + median(classical_s);
  state.counters["patches"] = transport.mesh.size();
  state.counters["classical_sweeps"] = classical_sweeps;
  state.counters["bilinear_sweeps"] = bilinear_sweeps;
  state.counters["classical_ms"] = 1e3 * median(classical_s);
  state.counters["solve_overhead_%"] = 100 * (median(ratio) - 1);
  state.counters["sweep_overhead_%"] = 100 * (sweep_ratio - 1);
  state.counters["run_overhead_%"] = 100 * (median(bilinear_s) - median(classical_s)) / whole;
}

BENCHMARK_CAPTURE(BM_BilinearOverhead, box, "box")
    ->ArgName("patch_mm")
    ->Arg(215)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_BilinearOverhead, lounge, "colour/lounge")
    ->ArgName("patch_mm")
    ->Arg(280)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
