#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "apps/commands/commands.h"
#include "apps/reports/verify_report.h"
#include "apps/run/run_record.h"
#include "apps/system/terminal.h"

namespace apps {
namespace {

std::vector<solver::Check> run_battery() {
  std::vector<solver::Check> checks;
  Progress progress("checks", static_cast<int>(solver::battery().size()));
  for (const solver::CheckGroup& group : solver::battery()) {
    for (solver::Check& check : group.run()) checks.push_back(std::move(check));
    progress.step();
  }
  return checks;
}

Json to_json(const solver::Check& c) {
  return {{"case", c.name},
          {"quantity", c.quantity},
          {"expected", c.expected},
          {"computed", c.computed},
          {"relative_error", c.relative_error()},
          {"tolerance", c.tolerance},
          {"passed", c.passed()}};
}

/// As every run.json, but nothing is read: no inputs.
void write(const std::filesystem::path& out, const std::string& csv, const Json& summary,
           const Session& session) {
  Json record = begin_record({{"roomhue", ROOMHUE_VERSION},
                              {"subcommand", "verify"},
                              {"options", Json::object()},
                              {"inputs", Json::array()}},
                             session);
  record.update(summary);
  record["status"] = summary["passed"] == summary["cases"] ? "done" : "self-check failed";
  record["peak_memory_bytes"] = peak_memory_bytes();
  const std::vector<OutputFile> files{{.path = out / "verify.csv", .text = csv},
                                      run_json(out, record)};
  write_files(files);
  report_written(files);
}

}  // namespace

Exit verify_engine(const VerifyCommand& command, const Session& session) {
  if (!command.measured.empty()) return compare_measured(command, session);
  if (!command.out.empty()) require_writable(command.out);
  const auto start = std::chrono::steady_clock::now();
  const std::vector<solver::Check> checks = run_battery();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  const auto passed = std::ranges::count_if(checks, &solver::Check::passed);

  Json summary{{"cases", checks.size()}, {"passed", passed}, {"seconds", seconds.count()}};
  if (session.json) {
    Json all = Json::array();
    for (const solver::Check& check : checks) all.push_back(to_json(check));
    Json data = summary;
    data["checks"] = all;
    put(data.dump(2) + "\n");
  } else {
    put(verify_table(checks));
  }
  std::fflush(stdout);
  tell("{} of {} cases passed, {:.1f} s\n", passed, checks.size(), seconds.count());
  if (!command.out.empty()) write(command.out, verify_csv(checks), summary, session);
  return verdict(checks);
}

}  // namespace apps
