#pragma once
#include <Eigen/Core>
#include <string>

#include "apps/pictures/png.h"

namespace apps {

/// What a picture in false colours shows.
struct Quantity {
  std::string name, unit;  ///< "luminance", "cd/m2"
};

/// A quantity in the colours of viridis, which is even for the eye, on a logarithmic scale that
/// runs from the darkest hundredth of the pixels to the largest value, both widened to 1, 2 or 5
/// times a power of ten; with lines of equal value at all of these, and a legend on the right.
/// @param values  from the top left, at least one above 0
[[nodiscard]] PngPicture false_colours(int width, int height, const Eigen::ArrayXf& values,
                                       const Quantity& quantity);

/// 0..1 to sRGB, encoded.
[[nodiscard]] Eigen::Vector3d viridis(double at);

/// 1, 2 and 5 times powers of ten from the last at or below `least` to the first at or above
/// `most`. @param least, most  above 0
[[nodiscard]] std::vector<double> decade_ticks(double least, double most);

}  // namespace apps
