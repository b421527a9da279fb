#include "paints/files/table_layout.h"

#include <fmt/format.h>

#include <algorithm>

#include "paints/files/source_text.h"

namespace paints {
namespace {

using Kind = TableLayout::Kind;

constexpr std::size_t kFewestBands = 8;

bool is_hex_column(const DelimitedTable& table, std::size_t column, std::size_t first_row) {
  bool marked = false;
  for (std::size_t r = first_row; r < table.rows.size(); ++r) {
    const auto& cells = table.rows[r].cells;
    if (column >= cells.size() || !spectra::parse_hex(cells[column])) return false;
    // Six digits may be an article number.
    marked = marked || cells[column].find_first_not_of("0123456789 ") != std::string::npos;
  }
  return marked && table.rows.size() > first_row;
}

std::optional<std::size_t> hex_column(const DelimitedTable& table, std::size_t first_row) {
  const std::size_t width = table.rows.front().cells.size();
  for (std::size_t c = 0; c < width; ++c) {
    if (is_hex_column(table, c, first_row)) return c;
  }
  return {};
}

bool is_across(const DelimitedTable& table, const ColumnRoles& roles) {
  const auto& header = table.rows.front().cells;
  const std::size_t bands = roles.wavelengths.size();
  const bool own = header[0] == "name" && bands >= 2 && 2 * bands > header.size() - 1;
  return bands >= kFewestBands || own || (bands == header.size() && bands >= 2);
}

/// Wavelengths down the first column, rising or falling, with numbers beside.
bool is_down(const DelimitedTable& table, const ColumnRoles& roles, bool& header) {
  header = !parse_wavelength(table.rows.front().cells[0]);
  const std::size_t first = header ? 1 : 0;
  if (table.rows.size() < first + kFewestBands || table.rows.front().cells.size() < 2) return false;
  const bool first_is_key = (roles.name && *roles.name == 0) || (roles.code && *roles.code == 0);
  if (header && (first_is_key || !roles.colours.empty())) return false;
  std::vector<double> nm;
  for (std::size_t r = first; r < table.rows.size(); ++r) {
    const auto value = parse_wavelength(table.rows[r].cells[0]);
    if (!value) return false;
    nm.push_back(*value);
  }
  const auto& beside = table.rows[first].cells;
  return (std::is_sorted(nm.begin(), nm.end()) || std::is_sorted(nm.rbegin(), nm.rend())) &&
         beside.size() > 1 && parse_decimal(beside[1], table.separator != ',').has_value();
}

/// Without a header: the key is the first column whose cells all differ.
TableLayout list_layout(const DelimitedTable& table, std::size_t hex) {
  TableLayout list{.kind = Kind::list, .roles = {}, .header = false};
  list.roles.colours.push_back({.kind = ColourColumns::Kind::hex, .columns = {hex}, .white = {}});
  for (std::size_t c = 0; c < table.rows.front().cells.size(); ++c) {
    if (c == hex) continue;
    std::vector<std::string> cells;
    for (const spectra::CsvRow& row : table.rows) {
      if (c < row.cells.size() && !row.cells[c].empty()) cells.push_back(row.cells[c]);
    }
    std::sort(cells.begin(), cells.end());
    const bool unique = cells.size() == table.rows.size() &&
                        std::adjacent_find(cells.begin(), cells.end()) == cells.end();
    if (unique && !list.roles.name) {
      list.roles.name = c;
    } else {
      list.roles.others.push_back(c);
    }
  }
  if (!list.roles.name && !list.roles.others.empty()) {
    list.roles.name = list.roles.others.front();
    list.roles.others.erase(list.roles.others.begin());
  }
  return list;
}

}  // namespace

std::optional<TableLayout> layout_of(const DelimitedTable& table) {
  if (table.rows.empty() || table.rows.front().cells.empty()) return {};
  TableLayout layout{.roles = roles_of(table.rows.front().cells)};
  ColumnRoles& roles = layout.roles;
  if (is_across(table, roles) && table.separator != ' ') return layout;
  if (is_down(table, roles, layout.header)) {
    layout.kind = Kind::down;
    return layout;
  }
  layout.header = true;
  if (table.separator == ' ') return {};
  if (const auto hex = hex_column(table, 0)) return list_layout(table, *hex);
  if (roles.colours.empty()) {
    if (const auto hex = hex_column(table, 1)) {
      roles.colours.push_back({.kind = ColourColumns::Kind::hex, .columns = {*hex}, .white = {}});
      std::erase(roles.others, *hex);
    }
  }
  if (roles.colours.empty() && !roles.lrv) return {};
  layout.kind = Kind::colours;
  return layout;
}

std::string describe(const TableLayout& layout, const DelimitedTable& table) {
  const std::string cut = fmt::format("cells separated by {}", separator_name(table.separator));
  const auto& nm = layout.roles.wavelengths;
  switch (layout.kind) {
    case Kind::across:
      return fmt::format("{}, spectra across: {} wavelengths in the header, {} to {} nm", cut,
                         nm.size(), nm.front().second, nm.back().second);
    case Kind::down:
      return fmt::format("{}, wavelengths down the first column", cut);
    case Kind::list:
      return fmt::format("{}, no header, a column of hex codes", cut);
    case Kind::colours:
      return fmt::format(
          "{}, colours by the header: {}", cut,
          layout.roles.colours.empty() ? "LRV" : to_string(layout.roles.colours.front().kind));
  }
  return cut;
}

}  // namespace paints
