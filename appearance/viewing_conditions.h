#pragma once
#include "appearance/ciecam02.h"
#include "appearance/spectra/viewed_light.h"

namespace appearance {

/// Factors for a surround ratio, linear between dark 0, dim 0.2 and average 1 [Neumann2004]
/// Table 5. The ratio is clamped to 0..1. @throws std::domain_error  if it is not finite
[[nodiscard]] SurroundFactors surround_factors(double ratio);

/// What a viewer of the lit room is adapted to, and the numbers it came from.
struct RoomView {
  ViewingConditions conditions;
  spectra::RelativeXyz sample;       ///< the wall, relative to the white
  double white_luminance_cd_m2 = 0;  ///< L_Aw
  double illuminance_lx = 0;         ///< on the viewed point
  double surround_ratio = 0;         ///< of `choice`; 1, 0.2, 0 for the fixed ones
  spectra::Surround surround =
      spectra::Surround::neumann;  ///< the choice made, to be named in outputs
};

/// @throws std::domain_error  if there is no light at the viewed point or in the adapting field
[[nodiscard]] RoomView view_of_room(const spectra::ViewedLight& light,
                                    const spectra::ViewingChoices& choices = {});

/// The swatch: 2000 lx D65, L_A = 2000/pi cd/m^2, Y_b = 20, average surround, on the transport grid
/// (physics of [Neumann2004] 4.4). The white is D65 summed over the same bands.
[[nodiscard]] const ViewingConditions& standard_conditions();

/// A reflectance as it looks on the swatch.
struct SwatchAppearance {
  spectra::RelativeXyz xyz;
  Correlates correlates;
};

[[nodiscard]] SwatchAppearance on_swatch(const spectra::Spectrum& reflectance);

}  // namespace appearance
