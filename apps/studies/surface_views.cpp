#include "apps/studies/surface_views.h"

#include <algorithm>

namespace apps {

solver::ViewedPoint view_on(const RoomRun& run, int surface) {
  for (std::size_t g = 0; g < std::max<std::size_t>(1, run.room.paint.size()); ++g) {
    const bool looked_at =
        (g == 0 && run.room.view) || (g < run.room.paint.size() && run.room.paint[g].view);
    if (!looked_at) continue;  // the default view is that of the surface alone
    const solver::ViewedPoint chosen = viewed_point(run, g);
    if (chosen.surface == surface) return chosen;
  }
  RoomRun alone{.path = run.path, .room = run.room};
  alone.room.paint = {{.surfaces = {surface}}};
  alone.room.view.reset();
  return viewed_point(alone);
}

}  // namespace apps
