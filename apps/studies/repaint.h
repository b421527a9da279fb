#pragma once
#include <string>
#include <vector>

#include "apps/run/room_run.h"

namespace apps {

/// Paints groups of surfaces of the room. @param paints  GROUP=PAINT, a paint of the group's atlas
/// by its name there, or of any compiled-in atlas as ATLAS:NAME
/// @return for run.json, which group got which paint
/// @throws spectra::InputError  with all that is unknown
Json repaint(RoomRun& run, const std::vector<std::string>& paints);

/// The room with each of its painted groups in another paint.
[[nodiscard]] scenes::Room painted(scenes::Room room, const std::vector<spectra::Spectrum>& paints);

}  // namespace apps
