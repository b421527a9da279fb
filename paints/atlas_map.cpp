#include "paints/atlas_map.h"

#include <algorithm>

namespace paints {

bool MappedChip::defined() const {
  return swatch.correlates.status.all_defined() &&
         std::ranges::all_of(seen,
                             [](const SeenPaint& s) { return s.correlates.status.all_defined(); });
}

std::vector<MappedChip> map_atlas(const Atlas& atlas, const std::vector<spectra::LitRoom>& rooms,
                                  const RankingOptions& options) {
  std::vector<MappedChip> chips;
  for (const Paint& paint : atlas.paints) {
    MappedChip chip{.paint = &paint,
                    .swatch = appearance::on_swatch(paint.reflectance, options.swatch)};
    const Target own =
        chip.swatch.correlates.status.all_defined() ? target_of(chip.swatch.correlates) : Target{};
    chip.seen = look(paint.reflectance, own, rooms, options.distance, options.viewing);
    chips.push_back(std::move(chip));
  }
  return chips;
}

std::vector<Order> orders(const std::vector<MappedChip>& chips,
                          const std::vector<spectra::LitRoom>& rooms,
                          const RankingOptions& options) {
  std::vector<std::size_t> known;
  for (std::size_t i = 0; i < chips.size(); ++i) {
    if (chips[i].defined()) known.push_back(i);
  }
  std::vector<Order> all;
  std::vector<double> distances(rooms.size());
  for (const std::size_t wished : known) {
    const Target wish = target_of(chips[wished].swatch.correlates);
    Order best{.wished = wished, .distance = std::numeric_limits<double>::infinity()};
    for (const std::size_t candidate : known) {
      for (std::size_t l = 0; l < rooms.size(); ++l) {
        distances[l] = distance(options.distance, chips[candidate].seen[l].correlates, wish);
      }
      const double judgement = judged(options.judgement, distances, rooms);
      if (judgement < best.distance) {
        best.ordered = candidate;
        best.distance = judgement;
      }
    }
    all.push_back(best);
  }
  return all;
}

}  // namespace paints
