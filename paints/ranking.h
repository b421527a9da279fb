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

[[nodiscard]] Target target_of(const appearance::Correlates& correlates);
/// From J, C, h under the standard conditions, where M = C F_L^0.25.
[[nodiscard]] Target target_of(const appearance::LightnessChromaHue& wished);

/// Rough rejection before any room is solved [Neumann2004] 4.4: a paint whose swatch differs from
/// the target by more than this is left out. Hue is not tested where either chroma is below 5.
struct Windows {
  std::optional<double> lightness, chroma, hue_deg;
};

enum class Distance { jab, cam02_ucs };

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

/// Every paint of the atlas, by how near it looks in the room to the target.
[[nodiscard]] Ranking rank(const Atlas& atlas, const Target& target,
                           const spectra::RoomResponse& room, const RankingOptions& options = {});

}  // namespace paints
