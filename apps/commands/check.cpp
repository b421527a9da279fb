#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "apps/commands/commands.h"
#include "apps/run/room_options.h"
#include "apps/run/run_record.h"
#include "apps/system/terminal.h"
#include "scenes/files/room_json.h"

namespace apps {
namespace {

std::string plan_text(const scenes::Room& room, const solver::Plan& plan) {
  std::vector<std::vector<std::string>> rows{
      {"plan of " + (room.name.empty() ? "the room" : room.name), ""},
      {"patches", fmt::format("{}", plan.patches)},
      {"pairs that face each other", fmt::format("{}", plan.pairs)},
      {"pairs that something may block", fmt::format("{}", plan.occludable_pairs)},
      {"bands with light, solved", fmt::format("{}, {}", plan.bands, plan.solved_bands)},
      {"memory", fmt::format("{:.1f} MB", static_cast<double>(plan.memory_bytes) * 1e-6)},
      {"expected time on one core", fmt::format("{:.2f} s", plan.expected_seconds)}};
  if (plan.fine.patch_m > 0) {
    rows[1][0] = fmt::format("coarse patches, edges up to {:.3g} m", plan.patch_m);
    rows.insert(rows.begin() + 1, {fmt::format("patches, edges up to {:g} m", plan.fine.patch_m),
                                   fmt::format("about {}", plan.fine.patches)});
  }
  std::string text = table("<>", rows);
  for (const auto& [what, why, saved_seconds] : plan.left_out)
    text += fmt::format("left out, about {:.2f} s: {}: {}\n", saved_seconds, what, why);
  return text;
}

}  // namespace

Exit check_room(const RoomCommand& command, const Session& session) {
  const scenes::Room room = scenes::read_room(command.room);
  report_notes(room.notes);
  const solver::Plan plan =
      solver::make_plan(room, {.patch_m = command.options.patch_m, .light = command.options.light});
  if (session.json) {
    Json data = describe(plan);
    data["available_memory_bytes"] = solver::available_memory_bytes();
    data["room"] = describe(room);
    put(data.dump(2) + "\n");
  } else {
    put(plan_text(room, plan));
  }
  return Exit::done;
}

}  // namespace apps
