#pragma once
#include "appearance/ciecam02.h"

namespace appearance {

/// Large fields look lighter and more chromatic than small ones; their hue stays [Xiao2011]. A
/// colour is told as that of the swatch of 2 degrees that looks the same, so a swatch of 2 degrees
/// is as CIECAM02 has it.
struct SizeEffect {
  double lightness = 1;  ///< factor of 100 - J
  double chroma = 1;     ///< factor of C

  [[nodiscard]] LightnessChromaHue forward(const LightnessChromaHue& small) const {
    return {.lightness = small.lightness + (1 - lightness) * (100 - small.lightness),
            .chroma = chroma * small.chroma,
            .hue_deg = small.hue_deg};
  }

  [[nodiscard]] LightnessChromaHue inverse(const LightnessChromaHue& large) const {
    return {.lightness = (large.lightness - 100 * (1 - lightness)) / lightness,
            .chroma = large.chroma / chroma,
            .hue_deg = large.hue_deg};
  }

  [[nodiscard]] bool none() const { return lightness == 1 && chroma == 1; }
};

/// What every output with a size effect says: its constants could not be checked against the
/// published ones.
inline constexpr const char* kSizeEffectCaution = "unverified constants";

/// Of a field of this angle; beyond 2 to 50 degrees, which were observed, that of the nearest.
/// @throws std::domain_error  unless 0 < angle_deg <= 180
[[nodiscard]] SizeEffect size_effect(double angle_deg);

}  // namespace appearance
