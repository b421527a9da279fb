#pragma once
#include <cmath>
#include <string>

namespace solver {

/// One number of the engine against its formula; where a case has many (points, patches, bands),
/// the one that errs most.
struct Check {
  std::string name;      ///< of the case
  std::string quantity;  ///< what is compared, with its unit
  double expected = 0;   ///< by formula; never 0
  double computed = 0;   ///< by the engine
  double tolerance = 0;  ///< on the relative error

  [[nodiscard]] double relative_error() const {
    return std::abs(computed - expected) / std::abs(expected);
  }

  /// False for NaN too.
  [[nodiscard]] bool passed() const { return relative_error() <= tolerance; }
};

}  // namespace solver
