#pragma once
#include "appearance/spectra/text/csv_reader.h"

namespace spectra {

/// The files of data/ that are compiled into the program.
enum class CompiledTable {
  cie1931,
  cie1964,
  alpha_opic,
  lamp_metrics,
  illuminants,
  houser_lamps,
  munsell_nickerson,
  munsell_renotation
};

/// Parsed anew at each call; callers keep what they make of it.
[[nodiscard]] CsvTable compiled_table(CompiledTable table);

/// A number in a cell of a compiled table.
[[nodiscard]] double compiled_number(const std::string& cell);

}  // namespace spectra
