// The room response: what it costs to make, in solves of the room, and what a paint costs then.
#include <benchmark/benchmark.h>

#include <random>
#include <string>

#include "paints/ranking.h"
#include "scenes/files/room_json.h"
#include "solver/response/room_response.h"
#include "solver/rooms/room_light.h"

namespace {

struct SampleRoom {
  scenes::Room room;
  solver::RoomTransport transport;
};

SampleRoom sample_room(const char* name) {
  SampleRoom sample{
      .room = scenes::read_room(std::string(SOURCE_DIR) + "/scenes/rooms/" + name + ".json")};
  sample.transport = solver::prepare_transport(sample.room);
  return sample;
}

/// One full solve of all bands beside one reduction: `solves` counts those that the basis took.
void BM_Solve(benchmark::State& state, const char* name) {
  const SampleRoom sample = sample_room(name);
  for (auto _ : state) {
    const solver::RoomSolution solution = solver::solve_room(sample.room, sample.transport);
    if (!solution.radiosity.converged) state.SkipWithError("not converged");
  }
}

void BM_Reduce(benchmark::State& state, const char* name) {
  const SampleRoom sample = sample_room(name);
  double solves = 0, error = 0;
  for (auto _ : state) {
    const solver::ReducedViews views = solver::reduce_views(sample.room, sample.transport);
    if (!views.room.converged) state.SkipWithError("error above 1e-6");
    solves = views.room.solves;
    error = views.room.largest_error;
  }
  state.counters["solves"] = solves;
  state.counters["error"] = error;
}

/// A paint on the wall: response, viewing conditions, CIECAM02, distance, sorting.
void BM_Rank(benchmark::State& state, const char* name) {
  const SampleRoom sample = sample_room(name);
  const solver::ReducedViews views = solver::reduce_views(sample.room, sample.transport);
  const solver::RoomResponse response(views, 0, 0, {});
  paints::Atlas atlas = paints::load_atlas("munsell-nickerson");
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  const std::vector<paints::Paint> papers = atlas.paints;
  while (static_cast<std::int64_t>(atlas.paints.size()) < state.range(0)) {
    const double share = unit(random);
    paints::Paint mixed = papers[random() % papers.size()];
    mixed.reflectance.values = share * mixed.reflectance.values +
                               (1 - share) * papers[random() % papers.size()].reflectance.values;
    atlas.paints.push_back(mixed);
  }
  const paints::Target target{.lightness = 75, .a_c = 10, .b_c = 10};
  for (auto _ : state) {
    const paints::Ranking ranking = paints::rank(
        atlas, target,
        {{.view = [&](const spectra::Spectrum& paint) { return response.light(paint); }}},
        {.top = 20});
    if (ranking.paints.empty() || !(ranking.paints[0].distance <= ranking.paints[1].distance))
      state.SkipWithError("no order");
  }
  state.counters["s/paint"] = benchmark::Counter(
      static_cast<double>(atlas.paints.size()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

}  // namespace

BENCHMARK_CAPTURE(BM_Solve, box, "box")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Reduce, box, "box")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Solve, office, "office")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Reduce, office, "office")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Rank, office, "office")->Arg(100'000)->Unit(benchmark::kMillisecond);
