#pragma once
#include <string>

#include "scenes/luminaires/luminaire.h"

namespace apps {

/// Luminous intensity by direction as an SVG page: the planes C0-C180 and C90-C270 through the
/// luminaire, C0 marked; nadir below. Of types A and B the same planes of its own axes.
[[nodiscard]] std::string polar_diagram(const scenes::Luminaire& luminaire);

}  // namespace apps
