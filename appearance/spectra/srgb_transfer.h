#pragma once
#include <cmath>

namespace spectra {

/// Transfer function of sRGB (IEC 61966-2-1): linear 0..1 to what a display is sent.
[[nodiscard]] inline double srgb_encoded(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// Its inverse.
[[nodiscard]] inline double srgb_decoded(double component) {
  return component <= 0.04045 ? component / 12.92 : std::pow((component + 0.055) / 1.055, 2.4);
}

}  // namespace spectra
