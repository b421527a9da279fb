#pragma once
#include <Eigen/Core>
#include <functional>

#include "paints/viewed_table.h"

namespace paints {

/// How a mixture looks, given the parts of its bases.
using PartsToJab = std::function<Eigen::Vector3d(const Parts&)>;
using PartsToJabSlope = std::function<JabOfParts(const Parts&)>;

struct Fit {
  Parts parts;          ///< sum 1, none negative
  double distance = 0;  ///< Euclidean in J, a_C, b_C from the wish; infinity where none is defined
};

/// The parts nearest to the wish, downhill from `start`: Levenberg-Marquardt with exact slopes,
/// parts held at 0 or above. Steps are taken in parts times `strength`, which makes a weak white
/// and a strong black alike. A local answer; never farther than the start.
[[nodiscard]] Fit fit_parts(const PartsToJabSlope& look, const Eigen::Vector3d& wish,
                            const Parts& start, const Parts& strength);

/// The nearest recipe in whole units near `parts`: all recipes of `units` units in total whose
/// counts lie within two of those of the best so far are tried, until none of these is better.
/// @param count  of bases
[[nodiscard]] Fit fit_units(const PartsToJab& look, const Eigen::Vector3d& wish, const Parts& parts,
                            int count, int units);

}  // namespace paints
