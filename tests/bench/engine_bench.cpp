// The engine's hot functions on the sample rooms. Every benchmark fails if its answer is wrong.
#include <benchmark/benchmark.h>

#include <string>

#include "scenes/files/room_json.h"
#include "solver/exchange/exchange.h"
#include "solver/rooms/room_light.h"

namespace {

scenes::Room sample_room(const char* name) {
  return scenes::read_room(std::string(SOURCE_DIR) + "/scenes/rooms/" + name + ".json");
}

/// Pairs per second, visibility included: box 0.25 m, office 0.2 m.
void BM_Exchange(benchmark::State& state, const char* name) {
  const scenes::Room room = sample_room(name);
  const scenes::PatchMesh mesh =
      scenes::mesh_room(room, 0.01 * static_cast<double>(state.range(0)));
  const solver::Visibility visibility(room, mesh);
  std::int64_t pairs = 0;
  for (auto _ : state) {
    const solver::ExchangeAreas exchange = solver::compute_exchange(mesh, visibility);
    if (!(exchange.closure_defect < 1e-12)) state.SkipWithError("rows do not close");
    pairs += exchange.facing_pairs;
  }
  state.counters["pairs/s"] =
      benchmark::Counter(static_cast<double>(pairs), benchmark::Counter::kIsRate);
  state.counters["patches"] = mesh.size();
}

/// One solve of all bands with the geometry at hand.
void BM_Solve(benchmark::State& state, const char* name) {
  const scenes::Room room = sample_room(name);
  const solver::RoomTransport transport =
      solver::prepare_transport(room, {.patch_m = 0.01 * static_cast<double>(state.range(0))});
  for (auto _ : state) {
    const solver::RoomSolution solution = solver::solve_room(room, transport);
    if (!solution.radiosity.converged || !(solution.energy.relative_defect < 1e-5)) {
      state.SkipWithError("not converged");
    }
    state.counters["iterations"] = solution.radiosity.bands[0].iterations;
  }
  state.counters["patches"] = transport.mesh.size();
}

BENCHMARK_CAPTURE(BM_Exchange, box, "box")->ArgName("patch_cm")->Arg(25)->UseRealTime();
BENCHMARK_CAPTURE(BM_Exchange, office, "office")->ArgName("patch_cm")->Arg(25)->UseRealTime();
BENCHMARK_CAPTURE(BM_Solve, box, "box")->ArgName("patch_cm")->Arg(25)->UseRealTime();
BENCHMARK_CAPTURE(BM_Solve, office, "office")->ArgName("patch_cm")->Arg(25)->UseRealTime();

}  // namespace
