#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "appearance/spectra/text/csv_reader.h"

namespace paints {

/// A file as UTF-8, without its byte order mark.
struct SourceText {
  std::string text;
  std::vector<std::string> notes;
};

/// UTF-8, UTF-16 with a mark, or else Latin-1, which is noted.
/// @throws spectra::InputError  empty; NUL bytes; or a binary format, which is named
[[nodiscard]] SourceText decode(const std::string& path, std::string bytes);

/// The place of a byte: lines end by LF, CR LF or CR.
class LineIndex {
 public:
  explicit LineIndex(std::string_view text);

  [[nodiscard]] spectra::CsvPlace place(std::size_t offset) const;

 private:
  std::vector<std::size_t> starts_;
};

/// In lower case, as far as it is ASCII.
[[nodiscard]] std::string lower(std::string_view text);

/// Without blanks at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

}  // namespace paints
