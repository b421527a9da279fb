#pragma once
#include <string>
#include <vector>

namespace apps {

/// What all subcommands share.
struct Session {
  std::vector<std::string> command_line;
  bool json = false;  ///< data on stdout as JSON
  int threads = 0;    ///< 0: one per core
};

/// As asked for, or one per core.
[[nodiscard]] int thread_count(const Session& session);

}  // namespace apps
