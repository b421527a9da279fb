#pragma once
#include <vector>

#include "solver/bounce/reflector.h"

namespace solver {

/// A band whose solution is that of another one times a factor.
struct RepeatedBand {
  Eigen::Index band, of;
  double factor;
};

/// Takes from `lit` the bands with the reflectances of an earlier one and its light times a factor.
/// @param light        one row per source of light, or per patch, that differs from others
/// @param reflectance  the same of surfaces, or patches
[[nodiscard]] std::vector<RepeatedBand> take_repeated_bands(const Bands& light,
                                                            const Bands& reflectance,
                                                            std::vector<Eigen::Index>& lit);

}  // namespace solver
