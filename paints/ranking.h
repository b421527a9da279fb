#pragma once
#include <limits>
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
  spectra::Judgement judgement = spectra::Judgement::mean;
  std::size_t top = std::numeric_limits<std::size_t>::max();  ///< how many of the best are kept
  appearance::SwatchCondition swatch =
      appearance::standard_swatch();  ///< what windows and atlas maps see the paints on
};

/// A paint on the viewed wall of the room, in one lighting.
struct SeenPaint {
  double distance = 0;  ///< from the target
  appearance::Correlates correlates;
  appearance::RoomView view;
  spectra::Chromaticity chromaticity;  ///< of the light the wall sends to the eye
};

struct RankedPaint {
  const Paint* paint = nullptr;  ///< into the atlas
  double distance = 0;           ///< judged over the lightings
  double inconstancy = 0;        ///< largest distance between its looks in two of the lightings
  std::vector<SeenPaint> seen;   ///< in each lighting
};

struct Ranking {
  std::vector<RankedPaint> paints;  ///< the best by distance, ties by the atlas's order
  int rejected = 0;                 ///< by the windows
  std::vector<std::string>
      undefined;  ///< names of paints whose appearance the model does not define
};

[[nodiscard]] double distance(Distance kind, const appearance::Correlates& seen,
                              const Target& target);

/// One distance from those under each lighting.
[[nodiscard]] double judged(spectra::Judgement judgement, const std::vector<double>& distances,
                            const std::vector<spectra::LitRoom>& rooms);

/// A paint as it looks in one lighting.
[[nodiscard]] SeenPaint look(const spectra::Spectrum& reflectance, const Target& target,
                             const spectra::LitRoom& room, Distance kind,
                             const spectra::ViewingChoices& viewing);

/// In each of them.
[[nodiscard]] std::vector<SeenPaint> look(const spectra::Spectrum& reflectance,
                                          const Target& target,
                                          const std::vector<spectra::LitRoom>& rooms, Distance kind,
                                          const spectra::ViewingChoices& viewing);

/// One distance from theirs.
[[nodiscard]] double judged(spectra::Judgement judgement, const std::vector<SeenPaint>& seen,
                            const std::vector<spectra::LitRoom>& rooms);

/// Those of the atlas that the windows of `options` let pass.
[[nodiscard]] std::vector<const Paint*> within_windows(const Atlas& atlas, const Target& target,
                                                       const RankingOptions& options);

/// Every paint of the atlas, by how near it looks in the room to the target. The room is asked once
/// in each lighting for each paint that the windows let pass, in the atlas's order; what it throws
/// passes through.
/// @throws std::invalid_argument  if the target is not finite, a window is not a positive number or
/// there is no lighting
/// @throws std::domain_error      if the room leaves the viewer without light
[[nodiscard]] Ranking rank(const Atlas& atlas, const Target& target,
                           const std::vector<spectra::LitRoom>& rooms,
                           const RankingOptions& options = {});

}  // namespace paints
