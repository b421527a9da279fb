#pragma once
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace apps {

/// Data, on stdout; flushed. @throws spectra::FileError  if it cannot be written
void put(std::string_view data);

/// Talk, on stderr. Where nobody can listen it is lost, and nothing else is.
void tell(std::string_view text) noexcept;

template <typename... Values>
void tell(fmt::format_string<Values...> format, Values&&... values) {
  tell(std::string_view(fmt::format(format, std::forward<Values>(values)...)));
}

/// Standard streams that are closed become ones that cannot be read or written, so that no file is
/// opened in their place. Call it first.
void occupy_standard_streams();

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
