#include "scenes/skies/sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/photometry.h"
#include "scenes/skies/sphere_integral.h"

namespace scenes {
namespace {

using Eigen::ArrayXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using std::numbers::pi;

constexpr double kOvercast_K = 6514;

/// [Chain1999], within what daylight is defined for.
double colour_temperature_K(double luminance_cd_m2, bool overcast) {
  constexpr double kLeast_K = 4000, kMost_K = 25000;
  if (overcast) return kOvercast_K;
  const double inverse = -132.1 + 59.77 * std::log10(std::max(luminance_cd_m2, 1e-9));
  return inverse <= 0 ? kMost_K : std::clamp(1e6 / inverse, kLeast_K, kMost_K);
}

}  // namespace

Sky make_sky(const spectra::Grid& grid, const SkyPattern& pattern, const SkyColour& colour,
             const SkyAmounts& amounts) {
  Sky sky{.pattern = pattern,
          .cd_m2 = amounts.horizontal_lx / horizontal_integral(pattern),
          .by_direction = !colour.spectrum,
          .overcast = colour.overcast,
          .beam = amounts.beam};
  if (colour.spectrum) {
    sky.components = spectra::scaled_to_luminous(*colour.spectrum, 1).values.matrix();
  } else {
    sky.components.resize(grid.count, 3);
    const auto components = spectra::daylight_components();
    for (std::size_t k = 0; k < 3; ++k) {
      const spectra::Spectrum component = spectra::light_on(grid, components[k]);
      sky.components.col(static_cast<Eigen::Index>(k)) = component.values.matrix();
      sky.lumens[static_cast<Eigen::Index>(k)] = spectra::luminous(component);
    }
  }
  sky.ground = ArrayXd::Zero(grid.count);
  const ArrayXd on_ground = irradiance_outside(sky, Vector3d::UnitZ());
  sky.ground = amounts.ground_reflectance / pi * on_ground;
  return sky;
}

Sky dark_sky(const spectra::Grid& grid) {
  return make_sky(grid, {}, {.spectrum = spectra::constant(grid, 1)},
                  {.beam = ArrayXd::Zero(grid.count)});
}

Sky unscaled(Sky sky) {
  sky.scale = 1;
  return sky;
}

VectorXd component_weights(const Sky& sky, const Vector3d& direction) {
  const double luminance = sky.cd_m2 * relative_luminance(sky.pattern, direction);
  if (!sky.by_direction) return VectorXd::Constant(1, sky.scale * luminance);
  const Eigen::Vector2d m =
      spectra::daylight_weights(colour_temperature_K(luminance, sky.overcast));
  const Vector3d mixed(1, m[0], m[1]);
  return sky.scale * luminance / mixed.dot(sky.lumens.matrix()) * mixed;
}

ArrayXd radiance(const Sky& sky, const Vector3d& direction) {
  if (direction.z() <= 0) return sky.scale * sky.ground;
  return (sky.components * component_weights(sky, direction)).array();
}

ArrayXd irradiance_outside(const Sky& sky, const Vector3d& normal) {
  const Vector3d& to_sun = sky.pattern.to_sun;
  VectorXd weights = VectorXd::Zero(sky.components.cols());
  for_directions(to_sun, {Vector3d::UnitZ(), normal}, [&](const Vector3d& d, double solid_angle) {
    weights += solid_angle * normal.dot(d) * component_weights(sky, d);
  });
  const double seen_of_ground = (1 - normal.z()) / 2;
  return (sky.components * weights).array() + pi * seen_of_ground * sky.scale * sky.ground +
         std::max(0.0, normal.dot(to_sun)) * sky.scale * sky.beam;
}

}  // namespace scenes
