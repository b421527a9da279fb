#pragma once
#include <Eigen/Core>
#include <vector>

#include "solver/judges/closed_form.h"

namespace solver {

/// The radiosity that part `of` shall have, to be reached by the reflectance of part `by`: the same
/// part or another one.
struct WishedRadiosity {
  Eigen::Index of = 0, by = 0;
  Eigen::ArrayXd radiosity;  ///< one per wavelength, in the unit of the emission
};

/// Whether a reflectance from 0 to below 1 fulfils a wish.
enum class Reach { attained, too_dark, too_bright };

struct InverseReflectance {
  /// One per wavelength. Where the wish is out of reach the nearest: 0, or the last number below 1.
  Eigen::ArrayXd reflectance;
  Eigen::ArrayXd least, limit;  ///< attainable: least <= radiosity < limit
  std::vector<Reach> reach;
};

/// The parametric inverse problem of [Neumann2004] 4.3 and 6, in closed form: with all else given,
/// B_by = (S_by + rho h)/(1 - rho g) rises with rho, and every other radiosity is linear in it.
/// Where no light arrives at part `by`, or none goes from it to `of`, least and limit are equal.
/// @param reflectance  as for cube_radiosity; the row of part `by` is not used
/// @throws std::invalid_argument  as the forward forms do; if a part does not exist, or a wish is
/// negative, not finite or not given for every wavelength
[[nodiscard]] InverseReflectance inverse_cube(const Parts& emission, const Parts& reflectance,
                                              const WishedRadiosity& wish,
                                              const CubeFactors& factors = {});
[[nodiscard]] InverseReflectance inverse_brick(const BrickShape& shape, const Parts& emission,
                                               const Parts& reflectance,
                                               const WishedRadiosity& wish);

}  // namespace solver
