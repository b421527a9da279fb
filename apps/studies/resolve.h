#pragma once
#include <vector>

#include "apps/studies/painted_room.h"
#include "paints/scheme.h"

namespace apps {

/// Paints that a search put first, one per group, and their judged distance by the response.
struct Winner {
  std::vector<spectra::Spectrum> paints;
  double distance = 0;
};

/// The winners by full solves: what the response got wrong about them.
struct Resolved {
  std::vector<double> distance;   ///< of the winners that were solved, in their order
  double largest_difference = 0;  ///< |distance - solved distance|
  bool same_order = true;

  /// For run.json. @param what  was solved: "paints", "schemes"
  [[nodiscard]] Json record(const char* what) const;
};

/// Solves the best `options.resolve_top` of the winners; how the room with the first of them was
/// solved in the first lighting is left in the run's record.
/// @throws spectra::InputError  if the room leaves the viewer without light
[[nodiscard]] Resolved resolve(RoomRun& run, PaintedRoom& painted,
                               const std::vector<Winner>& winners,
                               const std::vector<paints::SchemeGroup>& groups,
                               const RankOptions& options);

}  // namespace apps
