#pragma once
#include <string>
#include <vector>

namespace solver {

/// The closed-form battery of `roomhue verify`: the engine that solves rooms, run on cases whose
/// answers are known by formula.

/// One number of the engine against its formula; where a case has many (points, patches, bands),
/// the one that errs most.
struct Check {
  std::string name;      ///< of the case
  std::string quantity;  ///< what is compared, with its unit
  double expected = 0;   ///< by formula; never 0
  double computed = 0;   ///< by the engine
  double tolerance = 0;  ///< on the relative error

  [[nodiscard]] double relative_error() const;

  /// False for NaN too.
  [[nodiscard]] bool passed() const { return relative_error() <= tolerance; }
};

/// Cases on one subject; formulas and their sources stand at each case.
struct CheckGroup {
  std::string name;
  std::vector<Check> (*run)();
};

[[nodiscard]] const std::vector<CheckGroup>& battery();

}  // namespace solver
