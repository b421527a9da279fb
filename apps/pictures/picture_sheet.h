#pragma once
#include <string>
#include <vector>

#include "apps/pictures/png.h"

namespace apps {

struct SheetCell {
  PngPicture picture;
  std::string caption;  ///< below it, cut off where it is too long
};

/// Pictures of one height and depth side by side, `columns` in a row, on white.
[[nodiscard]] PngPicture picture_sheet(const std::vector<SheetCell>& cells, std::size_t columns);

}  // namespace apps
