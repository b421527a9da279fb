#include "apps/command_line/command_line.h"
#include "apps/system/output_files.h"
#include "apps/system/terminal.h"
#include "solver/rooms/room_light.h"

int main(int argc, char** argv) {
  apps::occupy_standard_streams();
  apps::exit_cleanly_on_signals();
  const apps::Outcome outcome = apps::guarded([&] {
    const apps::CommandLine line = apps::parse_command_line(argc, argv);
    if (!line.job) return line.exit;
    if (line.session.threads > 0) solver::set_threads(line.session.threads);
    return line.job(line.session);
  });
  if (!outcome.message.empty()) apps::tell("{}\n", outcome.message);
  return static_cast<int>(outcome.exit);
}
