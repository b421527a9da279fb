#include "apps/reports/verify_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/reports/csv.h"
#include "apps/system/terminal.h"

namespace apps {

Exit verdict(const std::vector<solver::Check>& checks) {
  return std::ranges::all_of(checks, &solver::Check::passed) ? Exit::done : Exit::self_check_failed;
}

std::string verify_table(const std::vector<solver::Check>& checks) {
  std::vector<std::vector<std::string>> rows{
      {"case", "quantity", "expected", "computed", "error", "tolerance", ""}};
  for (const solver::Check& c : checks) {
    rows.push_back({c.name, c.quantity, fmt::format("{:.9g}", c.expected),
                    fmt::format("{:.9g}", c.computed), fmt::format("{:.1e}", c.relative_error()),
                    fmt::format("{:.0e}", c.tolerance), c.passed() ? "pass" : "FAIL"});
  }
  return table("<<>>>><", rows);
}

std::string verify_csv(const std::vector<solver::Check>& checks) {
  CsvText csv("case,quantity,expected,computed,relative_error,tolerance,verdict");
  for (const solver::Check& c : checks) {
    csv.cell(c.name).cell(c.quantity).cell(c.expected).cell(c.computed);
    csv.cell(c.relative_error()).cell(c.tolerance).cell(c.passed() ? "pass" : "fail");
    csv.end_row();
  }
  return csv.take();
}

}  // namespace apps
