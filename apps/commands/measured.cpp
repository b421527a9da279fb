#include <nlohmann/json.hpp>

#include "apps/commands/commands.h"
#include "apps/reports/measured_report.h"
#include "apps/run/run_record.h"
#include "apps/system/terminal.h"

namespace apps {

Exit compare_measured(const VerifyCommand& command, const Session& session) {
  if (!command.out.empty()) require_writable(command.out);
  const Measured measured{.box = compare_box(command.measured),
                          .rooms = compare_rooms(command.measured)};
  put(session.json ? describe(measured).dump(2) + "\n" : measured_text(measured));
  if (command.out.empty()) return Exit::done;
  Json record = begin_record({{"roomhue", ROOMHUE_VERSION},
                              {"subcommand", "verify"},
                              {"options", {{"measured", command.measured}}},
                              {"inputs", Json::array()}},
                             session);
  record.update(describe(measured));
  record["status"] = "done";
  record["peak_memory_bytes"] = peak_memory_bytes();
  std::vector<OutputFile> files = measured_files(command.out, measured);
  files.push_back(run_json(command.out, record));
  write_files(files);
  report_written(files);
  return Exit::done;
}

}  // namespace apps
