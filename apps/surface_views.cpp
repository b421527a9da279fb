#include "apps/surface_views.h"

namespace apps {

solver::ViewedPoint view_on(const RoomRun& run, int surface) {
  const solver::ViewedPoint chosen = viewed_point(run);
  if (chosen.surface == surface) return chosen;
  RoomRun alone{.path = run.path, .room = run.room};
  alone.room.paint = scenes::PaintTask{.surfaces = {surface}};
  alone.room.view.reset();
  return viewed_point(alone);
}

void look_from(RoomRun& run, const std::vector<solver::ViewedPoint>& views) {
  run.room.receivers.clear();
  for (const solver::ViewedPoint& at : views) {
    run.room.receivers.push_back({surface_name(run, at), at.point_m, at.normal});
  }
}

appearance::RoomView view_at(RoomRun& run, solver::RoomSolution& solution,
                             const solver::ViewedPoint& at, std::size_t k) {
  run.transport.viewed = at;
  run.transport.view = solver::view_rows(at.eye_m, at.point_m, run.transport.mesh);
  solution.viewed = solution.receivers[k];
  return view_of(run, solution);
}

}  // namespace apps
