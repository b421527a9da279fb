#pragma once
#include <Eigen/Core>
#include <vector>

#include "solver/response/painted_patches.h"

namespace solver {

/// Bands with the same fixed reflectances, and the fewest columns of light that theirs combine
/// from.
struct BandClass {
  std::vector<int> bands;
  Eigen::ArrayXd fixed;   ///< reflectance per patch, 0 where painted
  SourceLight sources;    ///< patch x source
  Eigen::MatrixXd share;  ///< sources x (bands * lights): light = sources * share
};

/// Of the bands that carry light.
[[nodiscard]] std::vector<BandClass> band_classes(const Eigen::ArrayXd& area_m2,
                                                  const std::vector<SourceLight>& lights,
                                                  const PaintedPatches& painted);

}  // namespace solver
