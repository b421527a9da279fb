#pragma once
#include "apps/run/room_run.h"

namespace apps {

/// A point of a surface to look at: what the view of a painted group meets, or the surface's
/// default view.
/// @throws spectra::InputError  if nothing of the surface can be looked at
[[nodiscard]] solver::ViewedPoint view_on(const RoomRun& run, int surface);

}  // namespace apps
