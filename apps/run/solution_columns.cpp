#include "apps/run/solution_columns.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "appearance/spectra/cie_tables.h"

namespace apps {

SolutionColumns columns_of(const spectra::Grid& grid) {
  SolutionColumns columns{.names = {}, .labels = {}, .flux_unit = "W_nm", .lux = {}};
  for (int k = 0; k < grid.count; ++k) {
    columns.names.push_back(fmt::format("{}", grid.wavelength_nm(k)));
    columns.labels.push_back({{"nm", grid.wavelength_nm(k)}});
  }
  columns.lux = spectra::kMaxLuminousEfficacy_lm_W * grid.step_nm *
                spectra::colour_matching(grid).col(1).array();
  return columns;
}

SolutionColumns columns_of(const solver::ColourSolution& solution) {
  SolutionColumns columns{.names = {"r", "g", "b"},
                          .labels = {},
                          .flux_unit = "lm",
                          .lux = solution.xyz_from_rgb.row(1).transpose()};
  for (const std::string& name : columns.names) columns.labels.push_back({{"component", name}});
  return columns;
}

}  // namespace apps
