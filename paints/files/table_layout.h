#pragma once
#include <optional>
#include <string>

#include "paints/files/column_roles.h"
#include "paints/files/delimited_table.h"

namespace paints {

/// What the rows and columns of a table are.
struct TableLayout {
  enum class Kind {
    across,   ///< a paint per row, its spectrum across
    down,     ///< a paint per column, wavelengths down the first
    colours,  ///< a paint per row, its colour in columns named by a header
    list      ///< the same without a header: names and a column of hex codes
  };
  Kind kind = Kind::across;
  ColumnRoles roles;
  bool header = true;
};

/// By the header and the cells; nothing if it is none of these.
[[nodiscard]] std::optional<TableLayout> layout_of(const DelimitedTable& table);

/// "spectra across, 31 wavelengths from 400 to 700 nm", ...
[[nodiscard]] std::string describe(const TableLayout& layout, const DelimitedTable& table);

}  // namespace paints
