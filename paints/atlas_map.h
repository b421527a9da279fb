#pragma once
#include <string>
#include <vector>

#include "paints/ranking.h"

namespace paints {

/// A chip of an atlas on the swatch and on the wall of the room, in each lighting.
struct MappedChip {
  const Paint* paint = nullptr;
  appearance::SwatchAppearance swatch;
  std::vector<SeenPaint> seen;  ///< the distance is that from its own swatch

  [[nodiscard]] bool defined() const;  ///< on the swatch and in every lighting
};

/// To see on the wall what a chip looks like on the swatch, order another.
struct Order {
  std::size_t wished = 0, ordered = 0;  ///< into the chips
  double distance = 0;                  ///< of the ordered chip's look in the room from the wish
};

/// Every chip, in the atlas's order, its swatch held as `options` say.
/// @throws std::domain_error  if the room leaves the viewer without light
[[nodiscard]] std::vector<MappedChip> map_atlas(const Atlas& atlas,
                                                const std::vector<spectra::LitRoom>& rooms,
                                                const RankingOptions& options = {});

/// The nearest chip for every chip that is defined; ties go to the first of the atlas.
[[nodiscard]] std::vector<Order> orders(const std::vector<MappedChip>& chips,
                                        const std::vector<spectra::LitRoom>& rooms,
                                        const RankingOptions& options = {});

}  // namespace paints
