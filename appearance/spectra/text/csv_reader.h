#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "appearance/spectra/text/input_error.h"

namespace spectra {

struct CsvPlace {
  int line = 0;    ///< from 1
  int column = 0;  ///< from 1, in bytes
};

struct CsvRow {
  int line = 0;  ///< where the row begins, from 1
  std::vector<std::string> cells;
  std::vector<CsvPlace> places;  ///< where each cell begins
};

struct CsvTable {
  std::string path;
  std::vector<std::string> header;
  std::vector<CsvPlace> header_places;
  std::vector<CsvRow> rows;  ///< each with as many cells as the header
};

/// A table with one header row as RFC 4180 has it: quoted cells, CRLF or LF, UTF-8 with or without
/// a byte order mark. Empty lines are skipped; cells are kept as they are, blanks included.
/// @throws FileError   if it cannot be read
/// @throws InputError  with every fault (the first 100): empty or larger than 256 MiB, not UTF-8,
/// NUL bytes, unterminated or misplaced quotes, duplicate or empty header names, ragged rows
[[nodiscard]] CsvTable read_csv(const std::string& path);

/// The same for text in memory; `path` serves the messages.
[[nodiscard]] CsvTable parse_csv(const std::string& path, std::string_view text);

/// The fault of one cell, its column named by the header.
[[nodiscard]] Fault cell_fault(const CsvTable& table, const CsvRow& row, std::size_t column,
                               std::string problem, std::string remedy);

/// A whole cell as a number, blanks around it allowed; nothing if it is no finite number.
[[nodiscard]] std::optional<double> parse_number(std::string_view cell);

}  // namespace spectra
