#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "apps/run/room_options.h"
#include "solver/rooms/room_colour.h"

namespace apps {

/// What the columns of a solved room are, for reports: wavelengths, or r, g, b.
struct SolutionColumns {
  std::vector<std::string> names;  ///< "400", ... or "r", "g", "b"
  std::vector<Json> labels;        ///< in run.json: { "nm": 400 } or { "component": "r" }
  std::string flux_unit;           ///< "W_nm" or "lm"
  Eigen::ArrayXd lux;              ///< illuminance of a unit in each column
};

[[nodiscard]] SolutionColumns columns_of(const spectra::Grid& grid);
[[nodiscard]] SolutionColumns columns_of(const solver::ColourSolution& solution);

}  // namespace apps
