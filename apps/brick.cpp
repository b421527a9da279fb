#include "apps/closed_form_report.h"
#include "scenes/closed_form_json.h"

namespace apps {

Exit solve_brick(const FileCommand& command, const Session& session) {
  const scenes::BrickFile brick = scenes::read_brick(command.in);
  const solver::BrickShape shape{.width_m = brick.width_m,
                                 .depth_m = brick.depth_m,
                                 .height_m = brick.height_m,
                                 .furniture_height = brick.furniture_height,
                                 .window_width_m = brick.window_width_m,
                                 .window_height_m = brick.window_height_m,
                                 .window_sill_m = brick.window_sill_m,
                                 .window_offset_m = brick.window_offset_m};
  write_report({.subcommand = "brick",
                .form_factors = "exact",
                .part_names = {scenes::kBrickParts.begin(), scenes::kBrickParts.end()},
                .notes = brick.notes,
                .radiosity = solver::brick_radiosity(shape, parts_of(brick.emission),
                                                     parts_of(brick.reflectance))},
               command, session);
  return Exit::done;
}

}  // namespace apps
