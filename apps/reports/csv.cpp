#include "apps/reports/csv.h"

#include <fmt/format.h>

#include <iterator>

namespace apps {

CsvText::CsvText(std::string_view header) : text_(header) { end_row(); }

CsvText& CsvText::cell(std::string_view text) {
  separate();
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    text_ += text;
    return *this;
  }
  text_ += '"';
  for (const char c : text) text_.append(c == '"' ? 2 : 1, c);
  text_ += '"';
  return *this;
}

CsvText& CsvText::cell(double value) {
  separate();
  fmt::format_to(std::back_inserter(text_), "{}", value);
  return *this;
}

CsvText& CsvText::cell(int value) {
  separate();
  fmt::format_to(std::back_inserter(text_), "{}", value);
  return *this;
}

CsvText& CsvText::cell(std::optional<double> value) {
  return value ? cell(*value) : cell(std::string_view());
}

void CsvText::end_row() {
  text_ += "\r\n";
  at_row_start_ = true;
}

void CsvText::separate() {
  if (!at_row_start_) text_ += ',';
  at_row_start_ = false;
}

std::string reflectances_csv(const std::vector<std::pair<std::string, spectra::Spectrum>>& named) {
  CsvText csv;
  csv.cell("name");
  const spectra::Grid& grid = named.front().second.grid;
  for (int k = 0; k < grid.count; ++k) csv.cell(grid.wavelength_nm(k));
  csv.end_row();
  for (const auto& [name, reflectance] : named) {
    csv.cell(name);
    for (const double value : reflectance.values) csv.cell(value);
    csv.end_row();
  }
  return csv.take();
}

}  // namespace apps
