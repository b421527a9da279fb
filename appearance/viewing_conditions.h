#pragma once
#include <string>

#include "appearance/ciecam02.h"
#include "appearance/size_effect.h"
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

/// The light of lamps as X / Y and Z / Y, and how much of it is in the adopted white: a mixture of
/// the two whites at equal Y, so only the colour of the white changes.
struct WhiteMixture {
  double share = 1;  ///< of the white that the room's light makes; 1: all
  double lamps_x = 0, lamps_z = 0;

  template <typename T>
  [[nodiscard]] T x(const T& white_x, const T& white_y) const {
    return share == 1 ? white_x : T(share * white_x + (1 - share) * lamps_x * white_y);
  }

  template <typename T>
  [[nodiscard]] T z(const T& white_z, const T& white_y) const {
    return share == 1 ? white_z : T(share * white_z + (1 - share) * lamps_z * white_y);
  }
};

/// What of the choices meets the room, whatever its paint.
struct Adopted {
  spectra::ViewingChoices choices;
  WhiteMixture white;
  SizeEffect size;
};

/// @throws std::domain_error  if the white is that of lamps and there are none, or the size effect
/// is wanted of no angle
[[nodiscard]] Adopted adopted(const spectra::ViewedLight& light,
                              const spectra::ViewingChoices& choices);

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
  SizeEffect size;                 ///< of the viewed paint
  double angle_deg = 0;            ///< it was taken for; 0: no size effect
  bool lamps_by_flux = false;      ///< what the lamps' part of the white is, if it has one
};

/// @throws std::domain_error  if there is no light at the viewed point, in its background or in the
/// adapting field, or the white is too saturated for the model
[[nodiscard]] RoomView view_of_room(const spectra::ViewedLight& light,
                                    const spectra::ViewingChoices& choices = {});

/// How the viewed wall looks, the size effect included.
/// @throws std::domain_error  as `adapt`
[[nodiscard]] Correlates seen(const RoomView& view);

/// A sample seen so.
[[nodiscard]] Correlates seen(const spectra::RelativeXyz& sample, const Adaptation& adaptation,
                              const SizeEffect& size);

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

/// Where a swatch is held, and how large it is.
struct SwatchCondition {
  spectra::Spectrum light;  ///< what an ideal diffuser would send, of any amount
  ViewingConditions conditions;
  SizeEffect size;  ///< of the swatch
};

/// L_A is that of an ideal diffuser, as in the standard condition.
/// @param irradiance  W m^-2 nm^-1
[[nodiscard]] SwatchCondition swatch_in(const spectra::Spectrum& irradiance, double background_y,
                                        spectra::Surround surround);

[[nodiscard]] const SwatchCondition& standard_swatch();

/// @throws std::invalid_argument  if the reflectance is not on the grid of the light
[[nodiscard]] SwatchAppearance on_swatch(const spectra::Spectrum& reflectance,
                                         const SwatchCondition& swatch = standard_swatch());

}  // namespace appearance
