#pragma once
#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "appearance/spectra/spectrum.h"

namespace spectra {

/// A linear RGB space, by its primaries and its white.
struct RgbSpace {
  std::string name;
  Eigen::Matrix3d xyz_from_rgb;  ///< maps (1, 1, 1) to the white with Y = 1
  Samples white;                 ///< a light of the white's colour; its scale has no meaning
};

/// srgb (primaries of [BT709], D65), bt2020 [BT2020], acescg [ACES2014], xyz (equal-energy white)
/// and iso, in which [Granier2004] prints its matrices: the primaries of BT.709 with X and Z scaled
/// so that an equal-energy light is white.
[[nodiscard]] const std::vector<RgbSpace>& rgb_spaces();

/// @throws std::invalid_argument  naming the known spaces
[[nodiscard]] const RgbSpace& rgb_space(std::string_view name);

/// As xyz_from_rgb, with the primaries balanced so that the white, integrated on this grid, is
/// exactly (1, 1, 1): a grey surface has r = g = b, whatever the grid leaves out.
[[nodiscard]] Eigen::Matrix3d xyz_from_rgb_on(const Grid& grid, const RgbSpace& space);

/// Light in the space, in photometric units: r = g = b = Y for light of the white's colour.
/// Components of saturated lights may be negative.
[[nodiscard]] Eigen::Vector3d rgb_of_light(const RgbSpace& space, const Spectrum& light);

/// Reflectance or transmittance in the space: the colour of the surface under the white, (1, 1, 1)
/// for a perfect diffuser.
[[nodiscard]] Eigen::Vector3d rgb_of_reflectance(const RgbSpace& space,
                                                 const Spectrum& reflectance);

}  // namespace spectra
