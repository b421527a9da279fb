#include "apps/system/terminal.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "appearance/spectra/text/input_error.h"

namespace apps {

void put(std::string_view data) {
  const bool written = std::fwrite(data.data(), 1, data.size(), stdout) == data.size();
  if (!written || std::fflush(stdout) != 0) {
    throw spectra::FileError("standard output cannot be written");
  }
}

void tell(std::string_view text) noexcept {
  // What cannot be told cannot be complained of either.
  (void)std::fwrite(text.data(), 1, text.size(), stderr);
}

void occupy_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) >= 0) continue;
    // The lowest free descriptor is this one. Reading from one end, writing to none, both fail.
    (void)::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

std::string bold(const std::string& text) {
  const char* no_color = std::getenv("NO_COLOR");
  const bool plain = (no_color != nullptr && *no_color != '\0') || ::isatty(STDOUT_FILENO) == 0;
  return plain ? text : "\x1b[1m" + text + "\x1b[0m";
}

std::string table(const std::string& align, const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> width(align.size(), 0);
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += align[i] == '<' ? fmt::format("{:<{}}  ", row[i], width[i])
                              : fmt::format("{:>{}}  ", row[i], width[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += (&row == &rows.front() ? bold(line) : line) + "\n";
  }
  return text;
}

Progress::Progress(std::string what, int total)
    : what_(std::move(what)), total_(total), shown_(::isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (shown_ && done_ > 0) tell("\r\x1b[K");
}

void Progress::step() {
  ++done_;
  if (shown_) tell("\r{} {}/{}\x1b[K", what_, done_, total_);
}

}  // namespace apps
