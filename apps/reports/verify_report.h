#pragma once
#include <string>
#include <vector>

#include "apps/system/outcome.h"
#include "solver/judges/battery.h"

namespace apps {

/// Done if all have passed, else self_check_failed.
[[nodiscard]] Exit verdict(const std::vector<solver::Check>& checks);

/// For people; failures stand out.
[[nodiscard]] std::string verify_table(const std::vector<solver::Check>& checks);

/// verify.csv
[[nodiscard]] std::string verify_csv(const std::vector<solver::Check>& checks);

}  // namespace apps
