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

/// From a colour of sRGB (IEC 61966-2-1, 0..1 each, D65), on the transport grid; a grey comes out
/// flat, black as 0. White, which would reflect everything, does not converge.
/// @throws std::invalid_argument  if a component is not within 0..1
[[nodiscard]] Reconstruction reconstruct_srgb(double r, double g, double b);

}  // namespace spectra
