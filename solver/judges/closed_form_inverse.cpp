#include "solver/judges/closed_form_inverse.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace solver {
namespace {

using Eigen::ArrayXd;
using Forward = std::function<Parts(const Parts& emission, const Parts& reflectance)>;

void require_wish(const WishedRadiosity& wish, Eigen::Index parts, const Parts& emission,
                  const Parts& reflectance) {
  const auto exists = [&](Eigen::Index part) { return part >= 0 && part < parts; };
  if (!exists(wish.of) || !exists(wish.by) || emission.rows() != parts ||
      reflectance.rows() != parts) {
    throw std::invalid_argument(
        fmt::format("wish of part {} by part {}, {} emissions, {} reflectances; want {} parts",
                    wish.of, wish.by, emission.rows(), reflectance.rows(), parts));
  }
  if (wish.radiosity.size() != emission.cols() ||
      !(wish.radiosity >= 0 && wish.radiosity.isFinite()).all()) {
    throw std::invalid_argument(fmt::format(
        "a wished radiosity needs {} numbers from 0 up, one per wavelength", emission.cols()));
  }
}

/// If part `by` sends b, it receives h + g b and part `of` sends p + q b.
struct LinearLight {
  ArrayXd own_emission, least;  ///< S_by, and the radiosity of `of` at rho = 0
  ArrayXd h, g, p, q;
};

/// Part `by` as a lamp that reflects nothing: dark, then 1 with all other lamps off.
LinearLight held_at_a_radiosity(const Forward& radiosity, const Eigen::RowVectorXd& factors,
                                const Parts& emission, Parts reflectance,
                                const WishedRadiosity& wish) {
  reflectance.row(wish.by) = 0;
  Parts others = emission, unit = Parts::Zero(emission.rows(), emission.cols());
  others.row(wish.by) = 0;
  unit.row(wish.by) = 1;
  const Parts dark = radiosity(others, reflectance), lit = radiosity(unit, reflectance);
  return {.own_emission = emission.row(wish.by).transpose(),
          .least = radiosity(emission, reflectance).row(wish.of).transpose(),
          .h = (factors * dark.matrix()).transpose().array(),
          .g = (factors * lit.matrix()).transpose().array(),
          .p = dark.row(wish.of).transpose(),
          .q = lit.row(wish.of).transpose()};
}

InverseReflectance invert(const LinearLight& light, const ArrayXd& wished) {
  constexpr double kRounding = 1e-13;  // relative; a wish so near to `least` is fulfilled by 0
  const double below_one = std::nextafter(1.0, 0.0);
  const auto& [own_emission, least, h, g, p, q] = light;
  InverseReflectance inverse{.reflectance = ArrayXd::Zero(wished.size()),
                             .least = least,
                             .limit = p + q * (own_emission + h) / (1 - g),
                             .reach = {}};
  for (Eigen::Index k = 0; k < wished.size(); ++k) {
    Reach reach = Reach::attained;
    if (wished[k] >= inverse.limit[k] && wished[k] > least[k] * (1 + kRounding)) {
      reach = Reach::too_bright;
      inverse.reflectance[k] = below_one;
    } else if (wished[k] < least[k] * (1 - kRounding)) {
      reach = Reach::too_dark;
    } else if (wished[k] > least[k]) {
      const double b = (wished[k] - p[k]) / q[k];
      const double rho = (b - own_emission[k]) / (h[k] + g[k] * b);
      inverse.reflectance[k] = std::clamp(rho, 0.0, below_one);
    }
    inverse.reach.push_back(reach);
  }
  return inverse;
}

}  // namespace

InverseReflectance inverse_cube(const Parts& emission, const Parts& reflectance,
                                const WishedRadiosity& wish, const CubeFactors& factors) {
  require_wish(wish, 6, emission, reflectance);
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Constant(6, factors.adjacent);
  row[wish.by] = 0;
  row[wish.by ^ 1] = factors.opposite;  // 0-1, 2-3, 4-5
  const auto radiosity = [&](const Parts& s, const Parts& rho) {
    return cube_radiosity(s, rho, factors);
  };
  return invert(held_at_a_radiosity(radiosity, row, emission, reflectance, wish), wish.radiosity);
}

InverseReflectance inverse_brick(const BrickShape& shape, const Parts& emission,
                                 const Parts& reflectance, const WishedRadiosity& wish) {
  require_wish(wish, 10, emission, reflectance);
  const Eigen::RowVectorXd row = brick_form_factors(shape).row(wish.by);
  const auto radiosity = [&](const Parts& s, const Parts& rho) {
    return brick_radiosity(shape, s, rho);
  };
  return invert(held_at_a_radiosity(radiosity, row, emission, reflectance, wish), wish.radiosity);
}

}  // namespace solver
