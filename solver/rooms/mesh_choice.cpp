#include "solver/rooms/mesh_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>

#include "solver/rooms/room_faces.h"

namespace solver {
namespace {

/// Coarse patches aimed at, fewer where memory is short: in a room of 100 m^2, edges of 13 cm.
constexpr double kCoarsePatches = 6000, kFewestCoarsePatches = 500;

constexpr int kFloatCopies = 8,
              kLightingCopies = 8,   ///< of the same, in double, while light is reduced
    kDoubleCopies = 14,              ///< of patch x band arrays alive at the peak of a solve
    kFineCopies = 3;                 ///< of fine patch x band arrays, in double
constexpr double kMeshBytes = 2000,  ///< per patch, while the mesh is cut
    kGatherBytes = 2500;             ///< per patch, cut up for gathers

scenes::PatchMesh mesh_for(const scenes::Room& room, double patch_m, Light light) {
  return scenes::mesh_room(
      room, longest_edge_m(patch_m, light),
      light == Light::linear ? scenes::Cells::crowded : scenes::Cells::at_edges);
}

double area_m2(const scenes::Room& room) {
  const std::vector<double> area = whole_mesh(room).area_m2;
  return std::accumulate(area.begin(), area.end(), 0.0);
}

/// @param unknowns  patches, times three where light is linear on them
double bytes_for(double unknowns, const scenes::Room& room) {
  const int bands = room.grid.count;
  const double lightings = 1 + static_cast<double>(room.scenarios.size());
  const double padded = std::ceil(bands / 16.0) * 16;
  const auto points = static_cast<double>(room.receivers.size());
  return unknowns * unknowns / 2 * sizeof(float) + unknowns * points * sizeof(double) +
         unknowns * padded * (kFloatCopies * sizeof(float) + kDoubleCopies * sizeof(double)) +
         unknowns * bands * lightings * kLightingCopies * sizeof(double) +
         (kMeshBytes + kGatherBytes) * unknowns;
}

double fine_bytes_for(double patches, const scenes::Room& room) {
  return patches * (kFineCopies * room.grid.count * sizeof(double) + kMeshBytes);
}

[[noreturn]] void refuse(double patch_m, double bytes, double limit, double fits_m) {
  throw TooLarge(
      fmt::format("the solve at patch_m {:g} needs {:.3g} GB of memory and {:.3g} GB are free; "
                  "patch_m {:.2g} would fit",
                  patch_m, bytes * 1e-9, limit * 1e-9, std::ceil(fits_m * 100) / 100));
}

/// Coarse patches for a room of so many fine ones.
MeshChoice choose_coarse(const scenes::Room& room, Light light, double patch_m, double fine_patches,
                         double room_area_m2, double limit) {
  const int modes = modes_of(light);
  double count = kCoarsePatches;
  while (count > kFewestCoarsePatches && bytes_for(count, room) > limit / 2) count *= 0.9;
  MeshChoice choice{.solved = {},
                    .fine = {.patch_m = patch_m,
                             .patches = static_cast<std::int64_t>(std::llround(fine_patches))}};
  // Cutting along edges leaves more and smaller patches than asked for.
  for (choice.patch_m = std::sqrt(room_area_m2 / count);; choice.patch_m *= 1.1) {
    choice.solved = mesh_for(room, choice.patch_m, light);
    if (modes * choice.solved.size() <= 1.3 * count || choice.patch_m > std::sqrt(room_area_m2))
      break;
  }
  const double coarse = bytes_for(modes * choice.solved.size(), room);
  const double bytes = coarse + fine_bytes_for(fine_patches, room);
  if (coarse > limit) {  // nearly all of it grows as patch_m^-4
    refuse(patch_m, bytes, limit, choice.patch_m * std::pow(coarse / limit, 0.25) * 1.02);
  }
  if (bytes > limit) {
    refuse(patch_m, bytes, limit, patch_m * std::sqrt((bytes - coarse) / (limit - coarse)) * 1.02);
  }
  choice.memory_bytes = static_cast<std::int64_t>(bytes);
  return choice;
}

}  // namespace

std::int64_t available_memory_bytes() {
  std::ifstream file("/proc/meminfo");
  std::string word;
  while (file >> word) {
    std::int64_t kilobytes = 0;
    if (word == "MemAvailable:" && file >> kilobytes) return kilobytes * 1024;
  }
  return std::int64_t{4} << 30;  // a system that does not say is taken to have 4 GB
}

MeshChoice choose_mesh(const scenes::Room& room, const TransportOptions& options) {
  const double patch_m = options.patch_m > 0 ? options.patch_m : room.patch_m;
  const auto limit = static_cast<double>(options.memory_limit_bytes > 0 ? options.memory_limit_bytes
                                                                        : available_memory_bytes());
  const double room_area_m2 = area_m2(room);
  const double edge_m = longest_edge_m(patch_m, options.light);
  double unknowns = modes_of(options.light) * room_area_m2 / (edge_m * edge_m);  // at least
  const auto solvable = [&] {
    return unknowns <= kMostSolvedPatches && bytes_for(unknowns, room) <= limit;
  };
  if (solvable()) {
    MeshChoice choice{.solved = mesh_for(room, patch_m, options.light), .patch_m = patch_m};
    unknowns = modes_of(options.light) * choice.solved.size();
    choice.memory_bytes = static_cast<std::int64_t>(bytes_for(unknowns, room));
    if (solvable()) return choice;
  }
  const bool many = unknowns > kMostSolvedPatches;
  const double fine_patches =
      std::max(room_area_m2 / (patch_m * patch_m), options.light == Light::constant ? unknowns : 0);
  MeshChoice choice =
      choose_coarse(room, options.light, patch_m, fine_patches, room_area_m2, limit);
  choice.reason =
      many ? fmt::format("more than {}", kMostSolvedPatches) : "they do not fit in memory";
  return choice;
}

}  // namespace solver
