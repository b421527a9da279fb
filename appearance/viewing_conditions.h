#pragma once
#include <string>

#include "appearance/ciecam02.h"
#include "appearance/spectra/viewed_light.h"

namespace appearance {

/// Factors for a surround ratio, linear between dark 0, dim 0.2 and average 1 [Neumann2004]
/// Table 5. The ratio is clamped to 0..1. @throws std::domain_error  if it is not finite
[[nodiscard]] SurroundFactors surround_factors(double ratio);

/// What a room tells of its surround, luminances in cd/m^2.
struct SurroundLight {
  double adapting_luminance_cd_m2 = 0;  ///< L_A
  double white_luminance_cd_m2 = 0;     ///< L_Aw
  double illuminance_lx = 0;            ///< on the viewed point
};

struct RatioAndFactors {
  double ratio = 0;
  SurroundFactors factors;
};

/// The surround by one of these readings:
/// - neumann: L_A / L_Aw, clamped to 0..1 and interpolated [Neumann2004] eq. 17.
/// - cie: S_R, luminance of a white in the surround over that of the viewed white, with the classes
///   of [CIE159]: average from 0.2 up, dim below, dark at 0. The white of the surround is 5 L_A:
///   the adapting field taken as a grey of 20 %, as in F_L.
/// - illuminance: average from 40 lx up, dim below, dark at 0 [Neumann2004] 7.1; ratio 1, 0.2, 0.
/// - average, dim, dark: as named; ratio 1, 0.2, 0.
/// @throws std::domain_error  if L_Aw is not positive or a luminance is negative or not finite
[[nodiscard]] RatioAndFactors surround_of(spectra::Surround choice, const SurroundLight& light);

/// The choices as room files and outputs name them: "neumann", "ring", "ideal", ...
[[nodiscard]] std::string to_string(spectra::Surround choice);
[[nodiscard]] std::string to_string(spectra::Background choice);
[[nodiscard]] std::string to_string(spectra::ReferenceWhite choice);

/// What a viewer of the lit room is adapted to, and the numbers it came from.
struct RoomView {
  ViewingConditions conditions;
  spectra::RelativeXyz sample;       ///< the wall, relative to the white
  double white_luminance_cd_m2 = 0;  ///< L_Aw
  double illuminance_lx = 0;         ///< on the viewed point: what makes an ideal diffuser there as
                                     ///< bright as the reference white
  double surround_ratio = 0;         ///< of `surround`; 1, 0.2, 0 for the fixed ones
  spectra::Surround surround =
      spectra::Surround::neumann;  ///< the choice made, to be named in outputs
};

/// @throws std::domain_error  if there is no light at the viewed point, in its background or in the
/// adapting field, or the white is too saturated for the model
[[nodiscard]] RoomView view_of_room(const spectra::ViewedLight& light,
                                    const spectra::ViewingChoices& choices = {});

/// The swatch: 2000 lx D65, L_A = 2000/pi cd/m^2, Y_b = 20, average surround, on the transport grid
/// ([Neumann2004] 4.4, where 636.32 is a misprint). The white is D65 summed over the same bands.
[[nodiscard]] const ViewingConditions& standard_conditions();

/// The same, digested.
[[nodiscard]] const Adaptation& standard_adaptation();

/// A reflectance as it looks on the swatch.
struct SwatchAppearance {
  spectra::RelativeXyz xyz;
  Correlates correlates;
};

/// @throws std::invalid_argument  if the reflectance is not on the transport grid
[[nodiscard]] SwatchAppearance on_swatch(const spectra::Spectrum& reflectance);

}  // namespace appearance
