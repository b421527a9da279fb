#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "apps/commands.h"
#include "apps/room_options.h"
#include "apps/run_record.h"
#include "apps/terminal.h"
#include "scenes/room_json.h"

namespace apps {
namespace {

constexpr double kNoCut_m = 1e9;  // a patch edge longer than any room: faces stay whole

std::string plan_text(const scenes::Room& room, const solver::Plan& plan) {
  std::string text = table(
      "<>", {{"plan of " + (room.name.empty() ? "the room" : room.name), ""},
             {"patches", fmt::format("{}", plan.patches)},
             {"pairs that face each other", fmt::format("{}", plan.pairs)},
             {"pairs that something may block", fmt::format("{}", plan.occludable_pairs)},
             {"bands with light, solved", fmt::format("{}, {}", plan.bands, plan.solved_bands)},
             {"memory", fmt::format("{:.1f} MB", static_cast<double>(plan.memory_bytes) * 1e-6)},
             {"expected time on one core", fmt::format("{:.2f} s", plan.expected_seconds)}});
  for (const auto& [what, why, saved_seconds] : plan.left_out)
    text += fmt::format("left out, about {:.2f} s: {}: {}\n", saved_seconds, what, why);
  return text;
}

void require_memory(const std::string& room, double patch_m, double bytes) {
  const auto available_bytes = static_cast<double>(solver::available_memory_bytes());
  if (bytes <= available_bytes) return;
  // Nearly all of it grows as patch_m^-4; rounded up to whole centimetres.
  const double fits_m = std::ceil(100 * patch_m * std::pow(bytes / available_bytes, 0.25)) / 100;
  throw solver::TooLarge(
      fmt::format("{}: patch_m {:g} needs {:.3g} GB, {:.3g} GB are free; patch_m {:g} would fit",
                  room, patch_m, bytes * 1e-9, available_bytes * 1e-9, fits_m));
}

/// What the exchange areas of patches of this size must take, known before there is a mesh.
double least_memory_bytes(const scenes::Room& room, double patch_m) {
  const std::vector<double> area_m2 = scenes::mesh_room(room, kNoCut_m).area_m2;
  const double patches = std::accumulate(area_m2.begin(), area_m2.end(), 0.0) / (patch_m * patch_m);
  return patches * patches / 2 * sizeof(float);
}

}  // namespace

Exit check_room(const RoomCommand& command, const Session& session) {
  const scenes::Room room = scenes::read_room(command.room);
  report_notes(room.notes);
  const double patch_m = command.options.patch_m > 0 ? command.options.patch_m : room.patch_m;
  require_memory(command.room, patch_m, least_memory_bytes(room, patch_m));
  const solver::Plan plan = solver::make_plan(room, scenes::mesh_room(room, patch_m));
  if (session.json) {
    Json data = describe(plan);
    data["available_memory_bytes"] = solver::available_memory_bytes();
    data["room"] = describe(room);
    fmt::print("{}\n", data.dump(2));
  } else {
    fmt::print("{}", plan_text(room, plan));
  }
  require_memory(command.room, patch_m, static_cast<double>(plan.memory_bytes));
  return Exit::done;
}

}  // namespace apps
