#include "appearance/spectra/spectrum_library.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "appearance/spectra/compiled_tables.h"
#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/reconstruct.h"

namespace spectra {
namespace {

/// Columns name, label, then one per wavelength.
SpectrumSet measured_set(CompiledTable table, std::string name, std::string source) {
  CsvTable csv = compiled_table(table);
  std::vector<double> nm;
  for (std::size_t c = 2; c < csv.header.size(); ++c) nm.push_back(compiled_number(csv.header[c]));

  SpectrumSet set{.name = std::move(name), .source = std::move(source), .entries = {}};
  set.entries.reserve(csv.rows.size());
  for (CsvRow& row : csv.rows) {
    Samples samples{.nm = nm, .values = {}};
    samples.values.reserve(nm.size());
    for (std::size_t c = 2; c < row.cells.size(); ++c) {
      samples.values.push_back(compiled_number(row.cells[c]));
    }
    set.entries.push_back({.name = std::move(row.cells[0]),
                           .samples = std::move(samples),
                           .label = std::move(row.cells[1])});
  }
  return set;
}

SpectrumSet renotation_set() {
  // Y of the tables' white, magnesium oxide, on the scale of a perfect diffuser [Newhall1943].
  constexpr double kMagnesiumOxide = 0.975;
  const Spectrum light = light_on(kTransportGrid, illuminant("C"));
  std::vector<double> nm;
  for (int k = 0; k < kTransportGrid.count; ++k) nm.push_back(kTransportGrid.wavelength_nm(k));

  SpectrumSet set{.name = "munsell-renotation", .source = "", .reconstructed = true, .entries = {}};
  int left_out = 0;
  for (CsvRow& row : compiled_table(CompiledTable::munsell_renotation).rows) {
    const double x = compiled_number(row.cells[1]), y = compiled_number(row.cells[2]);
    const double luminance = kMagnesiumOxide * compiled_number(row.cells[3]);
    const RelativeXyz xyz{luminance * x / y, luminance, luminance * (1 - x - y) / y};
    const Reconstruction r = reconstruct_reflectance(xyz, light);
    left_out += r.converged ? 0 : 1;
    if (!r.converged) continue;
    const auto& rho = r.reflectance.values;
    set.entries.push_back({.name = std::move(row.cells[0]),
                           .samples = {.nm = nm, .values = {rho.begin(), rho.end()}},
                           .label = "reconstructed"});
  }
  set.source = fmt::format(
      "Munsell renotation [Newhall1943], reconstructed from x, y, Y under illuminant C; {} chips "
      "without a reflectance left out",
      left_out);
  return set;
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

std::string nearest_names(const SpectrumSet& set, std::string_view name) {
  std::vector<std::pair<std::size_t, std::string_view>> ranked;
  for (const NamedSpectrum& entry : set.entries) {
    ranked.emplace_back(edit_distance(entry.name, name), entry.name);
  }
  const std::size_t count = std::min<std::size_t>(3, ranked.size());
  std::partial_sort(ranked.begin(), ranked.begin() + static_cast<std::ptrdiff_t>(count),
                    ranked.end());
  std::vector<std::string_view> nearest;
  for (std::size_t i = 0; i < count; ++i) nearest.push_back(ranked[i].second);
  return fmt::format("{}", fmt::join(nearest, ", "));
}

/// "007" and "7" are one number; anything else stays itself.
std::string_view without_leading_zeros(std::string_view name) {
  const bool is_number = name.find_first_not_of("0123456789") == name.npos;
  while (is_number && name.size() > 1 && name[0] == '0') name.remove_prefix(1);
  return name;
}

SetAndSpectrum find(std::string_view qualified_name, const char* form,
                    const SpectrumSet& (*set_of)(std::string_view)) {
  const std::size_t colon = qualified_name.find(':');
  if (colon == qualified_name.npos) {
    throw std::invalid_argument(fmt::format("\"{}\" is not of the form {}", qualified_name, form));
  }
  const SpectrumSet& set = set_of(qualified_name.substr(0, colon));
  const std::string_view name = without_leading_zeros(qualified_name.substr(colon + 1));
  const auto entry = std::find_if(set.entries.begin(), set.entries.end(), [&](const auto& e) {
    return without_leading_zeros(e.name) == name;
  });
  if (entry == set.entries.end()) {
    throw std::invalid_argument(
        fmt::format("\"{}\" is not among the {} entries of {}; the nearest names are {}", name,
                    set.entries.size(), set.name, nearest_names(set, name)));
  }
  return {.set = &set, .spectrum = &*entry};
}

}  // namespace

const std::vector<std::string>& atlas_names() {
  static const std::vector<std::string> names{"munsell-nickerson", "munsell-renotation"};
  return names;
}

const SpectrumSet& atlas(std::string_view name) {
  if (name == "munsell-nickerson") {
    static const SpectrumSet set =
        measured_set(CompiledTable::munsell_nickerson, "munsell-nickerson",
                     "462 Munsell papers measured by Nickerson, from Psychtoolbox-3");
    return set;
  }
  if (name == "munsell-renotation") {
    static const SpectrumSet set = renotation_set();
    return set;
  }
  throw std::invalid_argument(
      fmt::format("no atlas \"{}\"; there are {}", name, fmt::join(atlas_names(), ", ")));
}

const std::vector<std::string>& lamp_set_names() {
  static const std::vector<std::string> names{"houser"};
  return names;
}

const SpectrumSet& lamps(std::string_view name) {
  if (name == "houser") {
    static const SpectrumSet set =
        measured_set(CompiledTable::houser_lamps, "houser",
                     "401 lamps collected by [Houser2013], from Psychtoolbox-3");
    return set;
  }
  throw std::invalid_argument(
      fmt::format("no lamps \"{}\"; there are {}", name, fmt::join(lamp_set_names(), ", ")));
}

SetAndSpectrum find_paint(std::string_view qualified_name) {
  return find(qualified_name, "ATLAS:NAME, e.g. munsell-nickerson:117", atlas);
}

SetAndSpectrum find_lamp(std::string_view qualified_name) {
  return find(qualified_name, "LAMPS:NUMBER, e.g. houser:12", lamps);
}

}  // namespace spectra
