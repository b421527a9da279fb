#pragma once
#include <optional>
#include <vector>

#include "apps/run/room_run.h"
#include "apps/studies/painted_room.h"
#include "paints/scheme.h"

namespace apps {

/// The painted groups of a room with their atlases and targets; not to be copied, as `groups` point
/// into `atlases`.
struct SchemeGroups {
  std::vector<paints::Atlas> atlases;
  std::vector<paints::SchemeGroup> groups;
  std::vector<appearance::SwatchCondition> swatches;  ///< of the targets
  double highest_reflectance = 0;
};

/// Without targets and swatches, which may depend on the room as it is painted now.
/// @param atlas  for all groups; empty: each has its own
/// @throws spectra::InputError  unless each group has a target and a view that meets its paint
[[nodiscard]] SchemeGroups scheme_groups(const RoomRun& run, const std::string& atlas);

/// Sets targets and swatches. @return of each group the light here, where its swatch is held there
std::vector<std::optional<spectra::ViewedLight>> set_targets(const RoomRun& run,
                                                             PaintedRoom& painted,
                                                             SchemeGroups& groups);

/// The `top` best schemes. @throws spectra::InputError  if the room leaves a viewer without light
[[nodiscard]] paints::SchemeRanking search_schemes(const RoomRun& run, const PaintedRoom& painted,
                                                   const SchemeGroups& groups,
                                                   paints::Distance distance, std::size_t top);

}  // namespace apps
