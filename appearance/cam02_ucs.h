#pragma once
#include "appearance/ciecam02.h"

namespace appearance {

/// CAM02-UCS coordinates [Luo2006]: J', a'_M, b'_M with c1 = 0.007, c2 = 0.0228.
struct UcsColour {
  double j = 0, a = 0, b = 0;
};

/// J, M and h of CIECAM02.
struct LightnessColourfulnessHue {
  double lightness = 0, colourfulness = 0, hue_deg = 0;
};

[[nodiscard]] UcsColour cam02_ucs(const LightnessColourfulnessHue& colour);

/// Delta E' with K_L = 1: the Euclidean distance.
[[nodiscard]] double ucs_distance(const UcsColour& p, const UcsColour& q);

}  // namespace appearance
