#include "apps/system/terminal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace apps {

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
  if (shown_ && done_ > 0) fmt::print(stderr, "\r\x1b[K");
}

void Progress::step() {
  ++done_;
  if (shown_) fmt::print(stderr, "\r{} {}/{}\x1b[K", what_, done_, total_);
}

}  // namespace apps
