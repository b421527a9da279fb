#include "paints/base_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "appearance/spectra/spectrum_file.h"
#include "appearance/spectra/spectrum_library.h"
#include "appearance/spectra/text/csv_reader.h"
#include "appearance/spectra/text/input_error.h"

namespace paints {
namespace {

using spectra::CsvRow;
using spectra::CsvTable;

/// "ochre K" is ("ochre", 'K'); other names have no constant.
std::pair<std::string, char> split(const std::string& name) {
  const std::size_t size = name.size();
  if (size < 3 || name[size - 2] != ' ' || (name[size - 1] != 'K' && name[size - 1] != 'S')) {
    return {name, ' '};
  }
  return {name.substr(0, size - 2), name[size - 1]};
}

/// Row of K and row of S by base, in the order of the file; -1 where there is none.
struct Rows {
  std::vector<std::string> names;
  std::map<std::string, std::pair<int, int>> of;
};

Rows rows_by_base(const CsvTable& csv) {
  Rows rows;
  for (std::size_t i = 0; i < csv.rows.size(); ++i) {
    const auto [name, constant] = split(csv.rows[i].cells[0]);
    const auto [entry, is_new] = rows.of.try_emplace(name, -1, -1);
    if (is_new) rows.names.push_back(name);
    if (constant == 'K') entry->second.first = static_cast<int>(i);
    if (constant == 'S') entry->second.second = static_cast<int>(i);
  }
  return rows;
}

bool holds_two_constants(const std::string& name_or_path) {
  const std::vector<std::string>& names = spectra::atlas_names();
  if (std::find(names.begin(), names.end(), name_or_path) != names.end() ||
      !std::filesystem::exists(name_or_path)) {
    return false;
  }
  try {
    const Rows rows = rows_by_base(spectra::read_csv(name_or_path));
    return std::any_of(rows.of.begin(), rows.of.end(), [](const auto& entry) {
      return entry.second.first >= 0 && entry.second.second >= 0;
    });
  } catch (const spectra::InputError&) {
    return false;  // no CSV of ours; if it is of nobody, load_atlas says what is wrong
  }
}

void require_pairs_above_zero(const CsvTable& csv, const Rows& rows) {
  std::vector<spectra::Fault> faults;
  for (const CsvRow& row : csv.rows) {
    const auto [k, s] = rows.of.at(split(row.cells[0]).first);
    if (k < 0 || s < 0) {
      faults.push_back(cell_fault(csv, row, 0, fmt::format("\"{}\" has no partner", row.cells[0]),
                                  "give each base two rows, \"NAME K\" and \"NAME S\""));
    }
    for (std::size_t c = 1; c < row.cells.size(); ++c) {
      if (*spectra::parse_number(row.cells[c]) > 0) continue;
      faults.push_back(cell_fault(csv, row, c, fmt::format("{} is not above 0", row.cells[c]),
                                  "give K and S above 0"));
    }
  }
  if (!faults.empty()) throw spectra::InputError(std::move(faults));
}

Ingredients read_two_constants(const std::string& path, const Saunderson& surface,
                               const spectra::Grid& grid) {
  // Like light, K and S are numbers from 0 up without an upper end.
  const spectra::SpectrumFile file = spectra::read_spectrum_file(path, spectra::CurveKind::light);
  require_coverage(path, file.set.entries.front().samples, grid);
  const CsvTable csv = spectra::read_csv(path);
  const Rows rows = rows_by_base(csv);
  require_pairs_above_zero(csv, rows);

  Ingredients all{.atlas = {.name = path, .source = path, .paints = {}},
                  .set = {.grid = grid, .surface = surface},
                  .two_constant = true};
  const auto curve = [&](int row) {
    return spectra::reflectance_on(grid, file.set.entries[static_cast<std::size_t>(row)].samples)
        .values;
  };
  for (const std::string& name : rows.names) {
    const auto [k, s] = rows.of.at(name);
    all.set.bases.push_back(
        {.name = name, .label = "", .absorption = curve(k), .scattering = curve(s)});
    const int base = static_cast<int>(all.set.bases.size()) - 1;
    all.atlas.paints.push_back(
        {.name = name,
         .reflectance = mixture(all.set, {base}, Eigen::VectorXd::Ones(1)).reflectance,
         .label = ""});
  }
  return all;
}

}  // namespace

Ingredients load_ingredients(const std::string& name_or_path, const Saunderson& surface,
                             const spectra::Grid& grid) {
  if (holds_two_constants(name_or_path)) return read_two_constants(name_or_path, surface, grid);
  Ingredients all{.atlas = load_atlas(name_or_path, grid)};
  all.set = bases_of(all.atlas, surface);
  return all;
}

}  // namespace paints
