#pragma once
#include <optional>

#include "appearance/spectra/tristimulus.h"

namespace spectra {

/// The colour of a light against the Planck locus, in the plane u, v of CIE 1960.
struct CorrelatedTemperature {
  double cct_K = 0;  ///< of the nearest point of the locus
  double duv = 0;    ///< how far from it; above the locus positive [Ohno2014]
};

/// From 1000 to 100 000 K, c2 of today; nothing farther than 0.05 from the locus, for there such a
/// temperature says nothing, and nothing of black.
[[nodiscard]] std::optional<CorrelatedTemperature> correlated_temperature(const Chromaticity& of);

}  // namespace spectra
