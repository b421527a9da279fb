#pragma once
#include <optional>
#include <string>
#include <vector>

#include "appearance/ciecam02.h"
#include "appearance/spectra/viewed_light.h"
#include "appearance/viewing_conditions.h"
#include "paints/atlas_file.h"

namespace paints {

/// The wished appearance: J, a_C, b_C (and M for the uniform space).
struct Target {
  double lightness = 0, a_c = 0, b_c = 0;
  double colourfulness = 0;
};

/// @throws std::domain_error  if the model leaves J or C undefined
[[nodiscard]] Target target_of(const appearance::Correlates& correlates);

/// From J, C, h under the standard conditions, where M = C F_L^0.25.
/// @throws std::domain_error  if they are not finite or J or C is negative
[[nodiscard]] Target target_of(const appearance::LightnessChromaHue& wished);

/// Rough rejection before any room is solved [Neumann2004] 4.4: a paint whose swatch differs from
/// the target by more than this is left out. Hue is not tested where either chroma is below 5, nor
/// anything where the model does not define the swatch.
struct Windows {
  std::optional<double> lightness, chroma, hue_deg;
};

/// jab: Euclidean in J, a_C, b_C [Neumann2004] 4.4. cam02_ucs: Delta E' of [Luo2006].
enum class Distance { jab, cam02_ucs };

[[nodiscard]] std::string to_string(Distance distance);

struct RankingOptions {
  Windows windows;
  Distance distance = Distance::jab;
  spectra::ViewingChoices viewing;
};

struct RankedPaint {
  const Paint* paint = nullptr;  ///< into the atlas
  double distance = 0;
  appearance::Correlates correlates;  ///< in the room
  appearance::RoomView view;
  spectra::Chromaticity chromaticity;  ///< of the light the wall sends to the eye
};

struct Ranking {
  std::vector<RankedPaint> paints;  ///< by distance, ties by the atlas's order
  int rejected = 0;                 ///< by the windows
  std::vector<std::string>
      undefined;  ///< names of paints whose appearance the model does not define
};

/// Every paint of the atlas, by how near it looks in the room to the target. `room` is called once
/// for each paint that the windows let pass, in the atlas's order; what it throws passes through.
/// @throws std::invalid_argument  if the target is not finite or a window is not a positive number
/// @throws std::domain_error      if the room leaves the viewer without light
[[nodiscard]] Ranking rank(const Atlas& atlas, const Target& target,
                           const spectra::RoomResponse& room, const RankingOptions& options = {});

}  // namespace paints
