#pragma once
#include <Eigen/Core>
#include <string_view>

#include "apps/pictures/png.h"

namespace apps {

/// Letters on pictures: 5 x 9 dots with 1 between them, each dot a square of pixels. Capitals are
/// drawn as small letters; what the font lacks as a blank.
inline constexpr int kLetterColumns = 6, kLetterRows = 11;

/// @param column, row  of the top left corner  @param dot  pixels along a dot
/// @param colour  r, g, b, 0..1
void draw_text(PngPicture& png, std::string_view text, int column, int row, int dot,
               const Eigen::Vector3d& colour);

void fill(PngPicture& png, int column, int row, int columns, int rows,
          const Eigen::Vector3d& colour);

}  // namespace apps
