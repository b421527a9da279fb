#include "appearance/spectra/cie_tables.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <mutex>
#include <stdexcept>
#include <tuple>

#include "appearance/spectra/compiled_tables.h"

namespace spectra {
namespace {

using ColourMatching = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// A table of CIE 15 as published: 360..830 nm, step 1.
ColourMatching published_table(CompiledTable which) {
  const CsvTable csv = compiled_table(which);
  ColourMatching table(kClosedFormGrid.count, 3);
  for (int k = 0; k < kClosedFormGrid.count; ++k) {
    const auto& cells = csv.rows.at(static_cast<std::size_t>(k)).cells;
    for (int c = 0; c < 3; ++c) {
      table(k, c) = compiled_number(cells.at(static_cast<std::size_t>(c) + 1));
    }
  }
  return table;
}

int row_of(double wavelength_nm) {
  const double row = (wavelength_nm - kClosedFormGrid.first_nm) / kClosedFormGrid.step_nm;
  if (!(row >= 0 && row < kClosedFormGrid.count && row == std::floor(row))) {
    throw std::invalid_argument(
        fmt::format("the CIE 1931 table has whole nm from 360 to 830, not {} nm", wavelength_nm));
  }
  return static_cast<int>(row);
}

}  // namespace

const ColourMatching& colour_matching(const Grid& grid) {
  static const ColourMatching published = published_table(CompiledTable::cie1931);
  if (grid == kTransportGrid) {  // asked for millions of times a second: no lock
    static const ColourMatching transport =
        published(Eigen::seqN(row_of(grid.first_nm), grid.count,
                              row_of(grid.first_nm + grid.step_nm) - row_of(grid.first_nm)),
                  Eigen::all);
    return transport;
  }
  static std::mutex mutex;
  static std::map<std::tuple<double, double, int>, ColourMatching> cache;

  (void)row_of(grid.first_nm);  // before it becomes a key: NaN has no order
  (void)row_of(grid.last_nm());
  const std::lock_guard lock(mutex);
  const auto [entry, is_new] = cache.try_emplace({grid.first_nm, grid.step_nm, grid.count});
  if (is_new) {
    try {
      entry->second.resize(grid.count, 3);
      for (int k = 0; k < grid.count; ++k) {
        entry->second.row(k) = published.row(row_of(grid.wavelength_nm(k)));
      }
    } catch (...) {
      cache.erase(entry);
      throw;
    }
  }
  return entry->second;
}

ColourMatching colour_matching_10_deg(const Grid& grid) {
  static const ColourMatching published = published_table(CompiledTable::cie1964);
  ColourMatching table(grid.count, 3);
  for (int k = 0; k < grid.count; ++k) table.row(k) = published.row(row_of(grid.wavelength_nm(k)));
  return table;
}

}  // namespace spectra
