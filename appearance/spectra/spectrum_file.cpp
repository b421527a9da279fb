#include "appearance/spectra/spectrum_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "appearance/spectra/text/csv_reader.h"

namespace spectra {
namespace {

// No reflectance is above 1; a file whose values exceed this is in percent.
constexpr double kLargestFraction = 1.5;

/// Wavelengths of the header, from the second column on.
std::vector<double> wavelengths(const CsvTable& csv, std::vector<Fault>& faults) {
  const auto fault = [&](std::size_t column, std::string problem, std::string remedy) {
    const CsvPlace place = csv.header_places[column];
    faults.push_back({csv.path, place.line, place.column, csv.header[column], std::move(problem),
                      std::move(remedy)});
  };
  if (csv.header[0] != "name") {
    fault(0, "the first column is not \"name\"", "begin the header with name,400,410,...");
  }
  if (csv.header.size() < 3) {
    fault(0, fmt::format("{} wavelengths in the header", csv.header.size() - 1),
          "give at least two, separated by commas: name,400,410,...");
  }
  std::vector<double> nm;
  for (std::size_t c = 1; c < csv.header.size(); ++c) {
    const auto value = parse_number(csv.header[c]);
    if (!value || *value <= 0) {
      fault(c, "not a wavelength", "give wavelengths in nm after the name");
    } else if (!nm.empty() && *value <= nm.back()) {
      fault(c, fmt::format("{} nm after {} nm", *value, nm.back()),
            "order the columns by rising wavelength");
    } else {
      nm.push_back(*value);
    }
  }
  return nm;
}

std::vector<double> numbers(const CsvTable& csv, const CsvRow& row, std::vector<Fault>& faults) {
  std::vector<double> values;
  for (std::size_t c = 1; c < row.cells.size(); ++c) {
    const auto value = parse_number(row.cells[c]);
    if (!value) {
      faults.push_back(cell_fault(csv, row, c, fmt::format("\"{}\" is not a number", row.cells[c]),
                                  "give a finite number with a decimal point"));
    }
    values.push_back(value.value_or(0));
  }
  return values;
}

void check_names(const CsvTable& csv, std::vector<Fault>& faults) {
  std::map<std::string_view, int> first_line;
  for (const CsvRow& row : csv.rows) {
    if (row.cells[0].empty()) {
      faults.push_back(cell_fault(csv, row, 0, "no name", "name every curve"));
      continue;
    }
    const auto [earlier, is_new] = first_line.try_emplace(row.cells[0], row.line);
    if (is_new) continue;
    faults.push_back(cell_fault(
        csv, row, 0, fmt::format("\"{}\" again, first in line {}", row.cells[0], earlier->second),
        "give each curve a name of its own"));
  }
}

/// Reflectance 0 <= rho < 1 (or 100 percent), light >= 0.
void check_range(const CsvTable& csv, CurveKind kind, bool percent, const SpectrumSet& set,
                 std::vector<Fault>& faults) {
  const double limit = percent ? 100 : 1;
  for (std::size_t i = 0; i < set.entries.size(); ++i) {
    const std::vector<double>& values = set.entries[i].samples.values;
    for (std::size_t c = 0; c < values.size(); ++c) {
      if (values[c] >= 0 && (kind == CurveKind::light || values[c] < limit)) continue;
      faults.push_back(cell_fault(
          csv, csv.rows[i], c + 1, fmt::format("{} is out of range", values[c]),
          kind == CurveKind::light
              ? "give 0 or more"
              : fmt::format(
                    "give a reflectance from 0 to below {}{}", limit,
                    percent ? ", as the file holds values above 1.5 and so is percent" : "")));
    }
  }
}

}  // namespace

SpectrumFile read_spectrum_file(const std::string& path, CurveKind kind) {
  const CsvTable csv = read_csv(path);
  std::vector<Fault> faults;
  const std::vector<double> nm = wavelengths(csv, faults);
  if (csv.rows.empty()) faults.push_back({path, 0, 0, "", "no curves", "give one per row"});
  check_names(csv, faults);

  SpectrumFile file{.set = {.name = path, .source = path, .entries = {}}};
  double largest = 0;
  for (const CsvRow& row : csv.rows) {
    std::vector<double> values = numbers(csv, row, faults);
    for (const double value : values) largest = std::max(largest, value);
    file.set.entries.push_back(
        {.name = row.cells[0], .samples = {.nm = nm, .values = std::move(values)}, .label = ""});
  }
  file.percent = kind == CurveKind::reflectance && largest > kLargestFraction;
  check_range(csv, kind, file.percent, file.set, faults);
  if (!faults.empty()) throw InputError(std::move(faults));

  for (NamedSpectrum& entry : file.set.entries) {
    for (double& value : entry.samples.values) value /= file.percent ? 100 : 1;
  }
  return file;
}

}  // namespace spectra
