#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "appearance/spectra/stated_colour.h"

namespace paints {

/// A colour that stands in three columns, or in one.
struct ColourColumns {
  enum class Kind { lab, xyz, xy_y, rgb, hex };
  Kind kind = Kind::hex;
  std::vector<std::size_t> columns;
  std::optional<spectra::StatedWhite> white;  ///< if the header states it
};

/// What the columns of a header mean; each column has one meaning at most.
struct ColumnRoles {
  std::optional<std::size_t> name, code, lrv;
  std::vector<std::pair<std::size_t, double>> wavelengths;  ///< column, nm
  std::vector<ColourColumns> colours;  ///< the surest first: XYZ, xyY, Lab, RGB, hex
  std::vector<std::size_t> others;     ///< to be kept
};

/// By the words of the header alone.
[[nodiscard]] ColumnRoles roles_of(const std::vector<std::string>& header);

/// "Lab", "hex", ...
[[nodiscard]] const char* to_string(ColourColumns::Kind kind);

}  // namespace paints
