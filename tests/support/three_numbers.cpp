// Writes the table "When three numbers are enough" of appearance/spectra/README.md to standard
// output: every measured wall paper under three lights in two rooms, by every method of
// `roomhue compare`, beside the 31-band answer.
//
//   ninja -C build/release three_numbers && build/release/tests/support/three_numbers
//
// An argument N takes every N-th paper only. The rooms are the box of scenes/rooms/box.json, the
// lamp replaced at equal flux, with the paper on the walls, and with the paper on all six sides.
// The mesh is coarse (1 m), the same for all methods, and the colour is that of the middle of the
// north wall.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/photometry.h"
#include "appearance/spectra/spectrum_library.h"
#include "apps/studies/colour_verdict.h"
#include "scenes/files/room_json.h"

namespace {

struct Case {
  double distance = 0;
  bool all_sides = false;
};

using Cases = std::map<std::string, std::vector<Case>>;

void relamp(scenes::Room& room, const spectra::Samples& lamp) {
  for (scenes::Surface& surface : room.surfaces) {
    if (surface.kind != scenes::SurfaceKind::panel) continue;
    surface.exitance = spectra::scaled_to_luminous(spectra::light_on(room.grid, lamp),
                                                   spectra::luminous(surface.exitance));
  }
}

void paint(scenes::Room& room, const spectra::Spectrum& paper, bool all_sides) {
  for (scenes::Surface& surface : room.surfaces) {
    const bool side =
        surface.kind == scenes::SurfaceKind::floor || surface.kind == scenes::SurfaceKind::ceiling;
    if (surface.kind == scenes::SurfaceKind::wall || (side && all_sides)) {
      surface.reflectance = paper;
    }
  }
}

void add_cases(const apps::ComparedRoom& room, const std::vector<apps::ColourMethod>& methods,
               bool all_sides, Cases& cases) {
  const solver::RoomSolution solution =
      solver::solve_room(room.room, room.transport, room.radiosity);
  const apps::Eye eye = apps::eye_of(appearance::view_of_room(
      solver::viewed_light(room.room, room.transport, solution), room.room.viewing));
  const spectra::Xyz truth = apps::spectral_method().solve(room).sent.front();
  for (const apps::ColourMethod& method : methods) {
    const apps::MethodColours colours = method.solve(room);
    const auto distance = apps::judge(colours.sent.front(), truth, eye).distance;
    if (!distance || !colours.converged) {
      throw std::runtime_error(method.name + " has no answer for a paper");
    }
    cases[method.name].push_back({*distance, all_sides});
  }
}

double mean(const std::vector<Case>& cases, const auto& counts) {
  double sum = 0;
  int n = 0;
  for (const Case& c : cases) {
    if (!counts(c)) continue;
    sum += c.distance;
    ++n;
  }
  return sum / n;
}

void print_row(const std::string& name, std::vector<Case> cases) {
  std::ranges::sort(cases, {}, &Case::distance);
  const std::size_t p95 = (cases.size() * 95 + 99) / 100 - 1;
  fmt::print("| `{}` | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n", name,
             mean(cases, [](const Case&) { return true; }), cases[p95].distance,
             cases.back().distance, mean(cases, [](const Case& c) { return !c.all_sides; }),
             mean(cases, [](const Case& c) { return c.all_sides; }));
}

void print_table(std::size_t every) {
  const std::vector<spectra::Samples> lamps{spectra::illuminant("A"), spectra::illuminant("D65"),
                                            spectra::find_lamp("houser:48").spectrum->samples};
  const auto& papers = spectra::atlas("munsell-nickerson").entries;
  const std::vector<apps::ColourMethod> methods = apps::judged_methods();
  scenes::Room room = scenes::read_room("scenes/rooms/box.json");
  Cases cases;
  for (const spectra::Samples& lamp : lamps) {
    relamp(room, lamp);
    const solver::RoomTransport transport = solver::prepare_transport(room, {.patch_m = 1});
    const std::vector<int> surfaces{transport.viewed.front().at.surface};
    for (std::size_t i = 0; i < papers.size(); i += std::max<std::size_t>(every, 1)) {
      const auto paper = spectra::reflectance_on(room.grid, papers[i].samples);
      for (const bool all_sides : {false, true}) {
        scenes::Room painted = room;
        paint(painted, paper, all_sides);
        add_cases({painted, transport, surfaces, {}}, methods, all_sides, cases);
      }
    }
  }
  fmt::print("| method | mean | 95th percentile | largest | mean, walls | mean, all sides |\n");
  fmt::print("| --- | --- | --- | --- | --- | --- |\n");
  for (const apps::ColourMethod& method : methods) print_row(method.name, cases[method.name]);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    print_table(argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 1);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
