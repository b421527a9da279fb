#include "appearance/spectra/compiled_tables.h"

#include <stdexcept>

extern "C" {
extern const char spectra_cie1931_begin[], spectra_cie1931_end[];
extern const char spectra_cie1964_begin[], spectra_cie1964_end[];
extern const char spectra_alpha_opic_begin[], spectra_alpha_opic_end[];
extern const char spectra_lamp_metrics_begin[], spectra_lamp_metrics_end[];
extern const char spectra_illuminants_begin[], spectra_illuminants_end[];
extern const char spectra_houser_lamps_begin[], spectra_houser_lamps_end[];
extern const char spectra_munsell_nickerson_begin[], spectra_munsell_nickerson_end[];
extern const char spectra_munsell_renotation_begin[], spectra_munsell_renotation_end[];
}

namespace spectra {

CsvTable compiled_table(CompiledTable table) {
  switch (table) {
    case CompiledTable::cie1931:
      return parse_csv("cie1931.csv", {spectra_cie1931_begin, spectra_cie1931_end});
    case CompiledTable::cie1964:
      return parse_csv("cie1964.csv", {spectra_cie1964_begin, spectra_cie1964_end});
    case CompiledTable::alpha_opic:
      return parse_csv("alpha_opic.csv", {spectra_alpha_opic_begin, spectra_alpha_opic_end});
    case CompiledTable::lamp_metrics:
      return parse_csv("lamp_metrics.csv", {spectra_lamp_metrics_begin, spectra_lamp_metrics_end});
    case CompiledTable::illuminants:
      return parse_csv("illuminants.csv", {spectra_illuminants_begin, spectra_illuminants_end});
    case CompiledTable::houser_lamps:
      return parse_csv("houser_lamps.csv", {spectra_houser_lamps_begin, spectra_houser_lamps_end});
    case CompiledTable::munsell_nickerson:
      return parse_csv("munsell_nickerson.csv",
                       {spectra_munsell_nickerson_begin, spectra_munsell_nickerson_end});
    case CompiledTable::munsell_renotation:
      return parse_csv("munsell_renotation.csv",
                       {spectra_munsell_renotation_begin, spectra_munsell_renotation_end});
  }
  throw std::logic_error("no such compiled table");
}

double compiled_number(const std::string& cell) { return parse_number(cell).value(); }

}  // namespace spectra
