#pragma once
#include "apps/run/room_run.h"
#include "paints/ranking.h"

namespace apps {

/// The target of a painted group.
/// @throws spectra::InputError  if the room names none
[[nodiscard]] const scenes::TargetColour& target_of(const RoomRun& run, std::size_t group = 0);

/// How it looks in the standard condition.
/// @throws spectra::InputError  if the model does not define that
[[nodiscard]] paints::Target wished(const RoomRun& run, const scenes::TargetColour& target,
                                    std::size_t group = 0);

/// @throws spectra::InputError  unless exactly one group is painted
void require_one_group(const RoomRun& run);

/// @throws spectra::InputError  if the eye looks at a surface that the group does not paint
void require_painted_view(const RoomRun& run, std::size_t group = 0);

/// The highest reflectance of a paint, a target, or kHighestReflectance.
[[nodiscard]] double highest_reflectance(const paints::Atlas& atlas,
                                         const std::optional<scenes::TargetColour>& target);

}  // namespace apps
