#pragma once
#include "appearance/spectra/spectrum.h"

namespace spectra {

/// 683 * step * sum E V: lux for an irradiance, lm m^-2 for an exitance, lm for a spectral flux,
/// cd m^-2 for a radiance.
[[nodiscard]] double luminous(const Spectrum& light);

/// `shape` scaled so that luminous() of the result is exactly `amount` up to rounding: from lux,
/// lumen or candela to W nm^-1 (per m^2, per sr).
/// @throws std::invalid_argument  if the shape has no luminance or the amount is negative or not
/// finite
[[nodiscard]] Spectrum scaled_to_luminous(const Spectrum& shape, double amount);

}  // namespace spectra
