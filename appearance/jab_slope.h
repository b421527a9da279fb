#pragma once
#include <Eigen/Core>

#include "appearance/ciecam02.h"
#include "appearance/spectra/viewed_light.h"
#include "appearance/viewing_conditions.h"

namespace appearance {

/// How the wall looks, and how that changes with its paint.
struct JabSlope {
  Status status;                    ///< what is undefined is 0 below, and so is its slope
  Eigen::Vector3d jab;              ///< J, a_C, b_C
  Eigen::Matrix3Xd by_reflectance;  ///< a column per band: derivatives by the reflectance there
};

/// J, a_C, b_C of the viewed wall as view_of_room and `seen` give them, with their exact
/// derivatives: the paint changes the wall, and with it white, L_A, Y_b and surround. At black and
/// at exact neutrals, where the model's slope is infinite, it is the slope a millionth of the white
/// away, towards yellow; where the surround has a kink or a step, the slope of the side it is on.
/// @throws std::domain_error      as view_of_room and adapt
/// @throws std::invalid_argument  if the spectra are on different grids
[[nodiscard]] JabSlope jab_slope(const spectra::ViewedLightSlope& light,
                                 const spectra::ViewingChoices& choices = {});

/// The eight sums over the bands through which the model sees a room, in lm m^-2: X, Y, Z of the
/// sample, X, Y, Z of the room's white, Y of the adapting field, Y of the background.
inline constexpr int kViewedSums = 8;
using ViewedSums = Eigen::Matrix<double, kViewedSums, 1>;

/// @throws std::invalid_argument  if the spectra are on different grids
[[nodiscard]] ViewedSums viewed_sums(const spectra::ViewedLight& light);

struct JabOfSums {
  Eigen::Vector3d jab;
  Eigen::Matrix<double, 3, kViewedSums> by_sum;
};

/// The inner part of jab_slope, for those who try many paints: nothing is checked, what is
/// undefined is 0. `jab_of` gives the value alone, in half a microsecond.
[[nodiscard]] Eigen::Vector3d jab_of(const ViewedSums& sums, const Adopted& adopted);
[[nodiscard]] JabOfSums jab_slope(const ViewedSums& sums, const Adopted& adopted);

}  // namespace appearance
