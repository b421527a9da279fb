#pragma once
#include "appearance/spectra/tristimulus.h"

namespace appearance {

/// CIE 1976 L*a*b* [CIE15].
struct Lab {
  double l = 0, a = 0, b = 0;
};

/// @throws std::domain_error  if a component of the white is not above 0
[[nodiscard]] Lab cielab(const spectra::RelativeXyz& sample, const spectra::RelativeXyz& white);

/// The colour difference Delta E_00 with k_L = k_C = k_H = 1, in the form of [Sharma2005]. About 1
/// is just noticeable side by side.
[[nodiscard]] double ciede2000(const Lab& p, const Lab& q);

}  // namespace appearance
