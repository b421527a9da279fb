#pragma once
#include "apps/room_run.h"

namespace apps {

/// A point of a surface to look at: what the room's view meets, or the surface's default view.
/// @throws spectra::InputError  if nothing of the surface can be looked at
[[nodiscard]] solver::ViewedPoint view_on(const RoomRun& run, int surface);

/// The viewed points become the room's receivers, in this order.
void look_from(RoomRun& run, const std::vector<solver::ViewedPoint>& views);

/// The solution as seen at the k-th of these.
/// @throws spectra::InputError  if there is no light to view it by
[[nodiscard]] appearance::RoomView view_at(RoomRun& run, solver::RoomSolution& solution,
                                           const solver::ViewedPoint& at, std::size_t k);

}  // namespace apps
