#pragma once
#include <string>
#include <vector>

#include "solver/judges/check.h"

namespace solver {

/// The closed-form battery of `roomhue verify`: the engine that solves rooms, run on cases whose
/// answers are known by formula.

/// Cases on one subject; formulas and their sources stand at each case.
struct CheckGroup {
  std::string name;
  std::vector<Check> (*run)();
};

[[nodiscard]] const std::vector<CheckGroup>& battery();

}  // namespace solver
