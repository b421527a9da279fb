#pragma once
#include "apps/run/room_run.h"
#include "apps/studies/painted_room.h"
#include "paints/ranking.h"

namespace apps {

/// The target of a painted group.
/// @throws spectra::InputError  if the room names none
[[nodiscard]] const scenes::TargetColour& target_of(const RoomRun& run, std::size_t group = 0);

/// Where a target's swatch is held, and as what size it is seen.
/// @param here  the room as it is painted now, for a swatch that is held there
/// @throws spectra::InputError  if it is held in a room that leaves it without light
[[nodiscard]] appearance::SwatchCondition swatch_of(
    const RoomRun& run, const scenes::TargetColour& target, const spectra::ViewingChoices& viewing,
    const std::optional<spectra::ViewedLight>& here);

/// How it looks there.
/// @throws spectra::InputError  if the model does not define that
[[nodiscard]] paints::Target wished(const RoomRun& run, const scenes::TargetColour& target,
                                    const appearance::SwatchCondition& swatch,
                                    std::size_t group = 0);

/// That `wished` will know, as far as that can be told before the room is solved.
/// @throws spectra::InputError
void require_wish(const RoomRun& run, std::size_t group = 0);

/// What `swatch_of` needs of the room: nothing, unless the swatch is held there.
[[nodiscard]] std::optional<spectra::ViewedLight> light_here(const RoomRun& run,
                                                             PaintedRoom& painted,
                                                             std::size_t group = 0);

/// The swatch of a group as the room file has it held: the standard one, if it names no target.
/// @throws spectra::InputError  as swatch_of
[[nodiscard]] appearance::SwatchCondition swatch_of_group(const RoomRun& run, PaintedRoom& painted,
                                                          std::size_t group = 0);

/// Says so, where the white counts lamps that do not shine on the viewed point.
void tell_white(const RoomRun& run, const appearance::RoomView& view);

/// @throws spectra::InputError  unless exactly one group is painted
void require_one_group(const RoomRun& run);

/// @throws spectra::InputError  if the eye looks at a surface that the group does not paint
void require_painted_view(const RoomRun& run, std::size_t group = 0);

/// The highest reflectance of a paint, a target, or kHighestReflectance.
[[nodiscard]] double highest_reflectance(const paints::Atlas& atlas,
                                         const std::optional<scenes::TargetColour>& target);

}  // namespace apps
