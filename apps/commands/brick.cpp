#include "apps/commands/closed_form_report.h"

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
  const solver::Parts emission = parts_of(brick.emission);
  solver::Parts reflectance = parts_of(brick.reflectance);
  const auto wish = answer(
      brick.wished, scenes::kBrickParts,
      [&](const solver::WishedRadiosity& wished) {
        return solver::inverse_brick(shape, emission, reflectance, wished);
      },
      reflectance);
  write_report({.subcommand = "brick",
                .form_factors = "exact",
                .part_names = {scenes::kBrickParts.begin(), scenes::kBrickParts.end()},
                .notes = brick.notes,
                .radiosity = solver::brick_radiosity(shape, emission, reflectance),
                .wish = wish},
               command, session);
  return Exit::done;
}

}  // namespace apps
