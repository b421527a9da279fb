#pragma once
#include "appearance/ciecam02.h"

namespace appearance {

/// CAM02-UCS coordinates [Luo2006]: J', a'_M, b'_M with c1 = 0.007, c2 = 0.0228.
struct UcsColour {
  double j = 0, a = 0, b = 0;
};

/// From J, M and h of CIECAM02.
[[nodiscard]] UcsColour cam02_ucs(double lightness, double colourfulness, double hue_deg);

/// Delta E' with K_L = 1: the Euclidean distance.
[[nodiscard]] double ucs_distance(const UcsColour& p, const UcsColour& q);

}  // namespace appearance
