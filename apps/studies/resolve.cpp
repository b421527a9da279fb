#include "apps/studies/resolve.h"

#include <algorithm>
#include <cmath>

namespace apps {

Json Resolved::record(const char* what) const {
  return {{what, distance.size()},
          {"largest_difference", largest_difference},
          {"same_order", same_order}};
}

Resolved resolve(RoomRun& run, PaintedRoom& painted, const std::vector<Winner>& winners,
                 const std::vector<paints::SchemeGroup>& groups, const RankOptions& options) {
  Resolved resolved;
  const std::vector<spectra::LitRoom> lightings = painted.lightings();
  const auto count = std::min(winners.size(), static_cast<std::size_t>(options.resolve_top));
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<std::vector<double>> by_group(groups.size());
    for (std::size_t l = 0; l < lightings.size(); ++l) {
      const solver::RoomSolution solution = painted.solve(winners[i].paints, l);
      if (i == 0 && l == 0) run.record["solution"] = describe(solution, run.room);
      for (std::size_t g = 0; g < groups.size(); ++g) {
        const Seen seen = seen_in_room(view_of(run, solution, g));
        by_group[g].push_back(
            paints::distance(options.distance, seen.correlates, groups[g].target));
      }
    }
    double sum = 0, weights = 0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      sum += groups[g].weight * paints::judged(run.room.judgement, by_group[g], lightings);
      weights += groups[g].weight;
    }
    resolved.distance.push_back(sum / weights);
    resolved.largest_difference =
        std::max(resolved.largest_difference, std::abs(resolved.distance[i] - winners[i].distance));
  }
  resolved.same_order = std::ranges::is_sorted(resolved.distance);
  return resolved;
}

}  // namespace apps
