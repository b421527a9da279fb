#include "apps/commands/closed_form_report.h"

namespace apps {

Exit solve_cube(const FileCommand& command, const Session& session) {
  const scenes::CubeFile cube = scenes::read_cube(command.in);
  const solver::CubeFactors factors =
      cube.exact_form_factors ? solver::exact_cube_factors() : solver::CubeFactors{};
  const solver::Parts emission = parts_of(cube.emission);
  solver::Parts reflectance = parts_of(cube.reflectance);
  const auto wish = answer(
      cube.wished, scenes::kCubeFaces,
      [&](const solver::WishedRadiosity& wished) {
        return solver::inverse_cube(emission, reflectance, wished, factors);
      },
      reflectance);
  write_report({.subcommand = "cube",
                .form_factors = cube.exact_form_factors ? "exact" : "paper",
                .part_names = {"B1", "B2", "B3", "B4", "B5", "B6"},
                .notes = cube.notes,
                .radiosity = solver::cube_radiosity(emission, reflectance, factors),
                .wish = wish},
               command, session);
  return Exit::done;
}

}  // namespace apps
