#include <fmt/format.h>

#include <cstdio>

#include "apps/command_line/command_line.h"
#include "apps/system/output_files.h"
#include "solver/rooms/room_light.h"

int main(int argc, char** argv) {
  apps::exit_cleanly_on_signals();
  apps::Outcome outcome = apps::guarded([&] {
    const apps::CommandLine line = apps::parse_command_line(argc, argv);
    if (!line.job) return line.exit;
    if (line.session.threads > 0) solver::set_threads(line.session.threads);
    return line.job(line.session);
  });
  if (outcome.exit == apps::Exit::done && std::fflush(stdout) != 0) {
    outcome = {.exit = apps::Exit::file_error, .message = "standard output cannot be written"};
  }
  if (!outcome.message.empty()) fmt::print(stderr, "{}\n", outcome.message);
  return static_cast<int>(outcome.exit);
}
