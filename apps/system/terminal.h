#pragma once
#include <string>
#include <vector>

namespace apps {

/// Bold where stdout is a terminal and NO_COLOR is unset or empty (no-color.org).
[[nodiscard]] std::string bold(const std::string& text);

/// Columns as wide as their widest cell; the header bold; numbers are the caller's to round.
/// `align` holds '<' or '>' per column.
[[nodiscard]] std::string table(const std::string& align,
                                const std::vector<std::vector<std::string>>& rows);

/// "paints 123/462" on stderr, redrawn in place; silent unless stderr is a terminal.
class Progress {
 public:
  Progress(std::string what, int total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void step();

 private:
  std::string what_;
  int total_;
  int done_ = 0;
  bool shown_;
};

}  // namespace apps
