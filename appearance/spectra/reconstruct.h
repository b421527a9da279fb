#pragma once
#include "appearance/spectra/spectrum.h"
#include "appearance/spectra/tristimulus.h"

namespace spectra {

struct Reconstruction {
  Spectrum reflectance;
  bool converged =
      false;  ///< false: the colour is outside the object-colour solid, or too near its surface
};

/// The smoothest reflectance within (0, 1) that has exactly these tristimulus values under a light:
/// minimises the squared slope of atanh(2 rho - 1) [Burns2020], on the light's grid.
/// @throws std::invalid_argument  if the light has no luminance
[[nodiscard]] Reconstruction reconstruct_reflectance(const RelativeXyz& xyz, const Spectrum& light);

/// The same for any three sums: one column of weights per band each for X, Y and Z, Y of a perfect
/// diffuser being 1, and `xyz` on that scale.
[[nodiscard]] Reconstruction reconstruct_from_sums(
    const Grid& grid, const Eigen::Matrix<double, Eigen::Dynamic, 3>& weights,
    const Eigen::Vector3d& xyz);

/// The X, Y, Z of an sRGB colour under the D65 of the transport grid, whose white is that of the
/// bands: a grey has the chromaticity of a flat reflectance.
/// @throws std::invalid_argument  if a component is not within 0..1
[[nodiscard]] RelativeXyz srgb_xyz(const Eigen::Vector3d& rgb);

/// From a colour of sRGB (IEC 61966-2-1, 0..1 each, D65), on the transport grid; a grey comes out
/// flat, black as 0. White, which would reflect everything, does not converge.
/// @throws std::invalid_argument  if a component is not within 0..1
[[nodiscard]] Reconstruction reconstruct_srgb(double r, double g, double b);

}  // namespace spectra
