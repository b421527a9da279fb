#pragma once
#include <functional>

#include "apps/commands/commands.h"

namespace apps {

/// What the command line asks for. Without a job (help, version, usage error) all has been said and
/// `exit` is the answer.
struct CommandLine {
  Session session;
  std::function<Exit(const Session&)> job;
  Exit exit = Exit::done;
};

[[nodiscard]] CommandLine parse_command_line(int argc, const char* const* argv);

}  // namespace apps
