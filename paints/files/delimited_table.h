#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "paints/files/paint_draft.h"

namespace paints {

/// A text cut into cells, with their places. ' ' separates at any run of blanks. Empty lines and
/// empty cells behind the last one are dropped, blanks around cells too.
struct DelimitedTable {
  char separator = ',';
  std::vector<spectra::CsvRow> rows;   ///< the header, if there is one, is the first
  std::vector<spectra::Fault> faults;  ///< of quotes
  bool even = true;                    ///< every row has as many cells as the first
};

/// @param most_rows  stop there; 0: never
[[nodiscard]] DelimitedTable cut(const std::string& path, std::string_view text, char separator,
                                 std::size_t most_rows = 0);

/// ",", ";", "tab" or "blanks", for people.
[[nodiscard]] std::string separator_name(char separator);

}  // namespace paints
