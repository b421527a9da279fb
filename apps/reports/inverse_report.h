#pragma once
#include <string>
#include <vector>

#include "apps/reports/colour_reports.h"
#include "paints/inverse_colour.h"

namespace apps {

/// The reflectance made for a wish, and how the room looks with it.
struct InverseRun {
  paints::InverseColour answer;         ///< by the room response
  std::vector<paints::SeenPaint> seen;  ///< by full solves, per lighting
  int rounds = 0;                       ///< of aiming off by what the response gets wrong
};

/// What is wished, what was missed, and what proves the answer.
[[nodiscard]] Json describe(const InverseRun& inverse, const paints::Target& wish);

/// inverse.csv: per band the reflectance and the multiplier of its bounds.
[[nodiscard]] std::string bands_csv(const paints::InverseColour& answer);

/// appearance.csv: per lighting the look by full solves, its difference from the wish, and the
/// multipliers.
[[nodiscard]] std::string appearance_csv(const InverseRun& inverse,
                                         const std::vector<spectra::LitRoom>& rooms,
                                         const paints::Target& wish);

/// The same for people, with the nearest paints of the atlas.
[[nodiscard]] std::string inverse_text(const InverseRun& inverse,
                                       const std::vector<spectra::LitRoom>& rooms,
                                       const paints::Ranking& ranking, const paints::Atlas& atlas);

}  // namespace apps
