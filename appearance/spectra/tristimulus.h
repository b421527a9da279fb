#pragma once
#include "appearance/spectra/spectrum.h"

namespace spectra {

/// Tristimulus values in photometric units: y is a luminous quantity, lm m^-2 for a spectrum in
/// W m^-2 nm^-1 (683 lm/W times the integral with the colour matching functions of CIE 1931).
struct Xyz {
  double x = 0, y = 0, z = 0;
};

/// Tristimulus values on the scale where the adopted white has y = 100.
struct RelativeXyz {
  double x = 0, y = 0, z = 0;
};

struct Chromaticity {
  double x = 0, y = 0;
};

/// 683 * step * sum of light times the colour matching functions at the grid's wavelengths.
[[nodiscard]] Xyz absolute_xyz(const Spectrum& light);

/// The one way from absolute to relative: divided so that `white_y` becomes 100.
/// @throws std::invalid_argument  if white_y is not a positive number
[[nodiscard]] RelativeXyz relative_xyz(const Xyz& xyz, double white_y);

/// [Neumann2004] eq. 5-6: a reflectance under a light, normalised so that a perfect diffuser has y
/// = 100.
/// @throws std::invalid_argument  if grids differ or the light has no luminance
[[nodiscard]] RelativeXyz relative_xyz(const Spectrum& reflectance, const Spectrum& light);

/// (0, 0) for black.
[[nodiscard]] Chromaticity chromaticity(const Xyz& xyz);
[[nodiscard]] Chromaticity chromaticity(const RelativeXyz& xyz);

}  // namespace spectra
