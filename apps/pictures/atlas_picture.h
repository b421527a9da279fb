#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "appearance/spectra/tristimulus.h"

namespace apps {

/// A chip in the plane of a_C and b_C.
struct ChipArrow {
  Eigen::Vector2d swatch, room;  ///< a_C, b_C
  spectra::RelativeXyz colour;   ///< of the swatch under D65, drawn in sRGB
  std::string name;
};

/// An SVG picture: an arrow for each chip from where it is on the swatch to where it is in the
/// room.
[[nodiscard]] std::string arrow_picture(const std::string& title,
                                        const std::vector<ChipArrow>& chips);

}  // namespace apps
