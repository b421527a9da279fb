#pragma once
#include <functional>
#include <string>

namespace apps {

/// What the program's exit codes mean (README.md).
enum class Exit {
  done = 0,
  our_bug = 1,
  usage = 2,
  invalid_input = 3,
  file_error = 4,
  not_converged = 5,
  batch_failures = 6,
  self_check_failed = 7,
};

struct Outcome {
  Exit exit = Exit::done;
  std::string message;  ///< for people; empty if nothing was thrown
};

/// Runs a job and turns whatever it throws into an exit code and a message.
[[nodiscard]] Outcome guarded(const std::function<Exit()>& job);

}  // namespace apps
