#include "apps/pictures/picture_sheet.h"

#include <algorithm>

#include "apps/pictures/pixel_font.h"

namespace apps {
namespace {

void paste(const PngPicture& from, int column, int row, PngPicture& onto) {
  const auto width = static_cast<std::size_t>(from.width),
             wide = static_cast<std::size_t>(onto.width);
  for (std::size_t y = 0; y < static_cast<std::size_t>(from.height); ++y) {
    const auto at = (y + static_cast<std::size_t>(row)) * wide + static_cast<std::size_t>(column);
    std::copy_n(from.samples.begin() + static_cast<std::ptrdiff_t>(3 * y * width), 3 * width,
                onto.samples.begin() + static_cast<std::ptrdiff_t>(3 * at));
  }
}

}  // namespace

PngPicture picture_sheet(const std::vector<SheetCell>& cells, std::size_t columns) {
  const int height = cells.front().picture.height, dot = std::max(1, height / 360);
  const int gap = 6 * dot, step = height + kLetterRows * dot + 2 * gap;
  const auto rows = static_cast<int>((cells.size() + columns - 1) / columns);
  int width = 0, column = gap;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (k % columns == 0) column = gap;
    column += cells[k].picture.width + gap;
    width = std::max(width, column);
  }
  PngPicture sheet{.width = width, .height = gap + rows * step, .bits = cells.front().picture.bits};
  sheet.samples.resize(3 * static_cast<std::size_t>(sheet.width) *
                       static_cast<std::size_t>(sheet.height));
  fill(sheet, 0, 0, sheet.width, sheet.height, Eigen::Vector3d::Ones());
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const auto& [picture, caption] = cells[k];
    if (k % columns == 0) column = gap;
    const int row = gap + static_cast<int>(k / columns) * step;
    paste(picture, column, row, sheet);
    const auto letters = static_cast<std::size_t>(picture.width / (kLetterColumns * dot));
    draw_text(sheet, caption.substr(0, letters), column, row + height + gap, dot,
              Eigen::Vector3d::Zero());
    column += picture.width + gap;
  }
  return sheet;
}

}  // namespace apps
