#pragma once
#include <vector>

#include "scenes/room.h"

namespace scenes {

/// A plane polygon as convex ones, its holes left out, counter-clockwise seen from the same side.
[[nodiscard]] std::vector<Outline> convex_parts(const Outline& outline,
                                                const std::vector<Outline>& holes = {});

/// A convex polygon that hides from both sides.
[[nodiscard]] ConvexPart plate(const Outline& convex);

}  // namespace scenes
