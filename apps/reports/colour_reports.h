#pragma once
#include <string>
#include <vector>

#include "apps/run/room_options.h"
#include "apps/studies/look_errors.h"
#include "apps/studies/seen.h"
#include "paints/ranking.h"

namespace apps {

/// shift.csv: conditions swatch, room, and change with hue differences taken the short way round.
[[nodiscard]] std::string shift_csv(const std::vector<Shift>& shifts);
[[nodiscard]] Json shift_list(const std::vector<Shift>& shifts);
[[nodiscard]] std::string shift_table(const std::vector<Shift>& shifts);

/// Chroma and hue, swatch -> room: "21.3 -> 27.9", and with `hue` "48.1 -> 45.0".
[[nodiscard]] std::string chroma_arrow(const Shift& shift);
[[nodiscard]] std::string hue_arrow(const Shift& shift);

/// "munsell-nickerson:117", as a room file would name it; a paint of an atlas file by its own name.
[[nodiscard]] std::string paint_name(const paints::Atlas& atlas, const paints::Paint& paint);

/// ranking.csv: the first `top` paints, compared with the target; correlates of the first lighting.
/// @param solved  distances of the best by full solves
[[nodiscard]] std::string ranking_csv(const paints::Ranking& ranking, const paints::Atlas& atlas,
                                      const paints::Target& target, int top,
                                      const std::vector<double>& solved,
                                      const RankingErrors& errors);

/// scenarios.csv: the same paints in every lighting.
[[nodiscard]] std::string scenarios_csv(const paints::Ranking& ranking, const paints::Atlas& atlas,
                                        const std::vector<spectra::LitRoom>& rooms, int top);

}  // namespace apps
