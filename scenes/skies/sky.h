#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>

#include "appearance/spectra/spectrum.h"
#include "scenes/skies/sky_pattern.h"

namespace scenes {

/// The colour of the sky: one spectrum, or CIE daylight whose colour temperature follows the
/// luminance of each direction [Chain1999], kept within 4000 to 25000 K.
struct SkyColour {
  std::optional<spectra::Spectrum> spectrum;  ///< of any scale; none: by direction
  bool overcast = false;                      ///< by direction, 6514 K everywhere
};

/// What stands opposite an upright or slanting opening, without end along it.
struct Obstruction {
  double angle_deg = 0;  ///< it hides the sky up to here, from every point; or
  std::optional<double> distance_m,
      top_m;  ///< a wall outside, parallel to the opening; z of its top
  double reflectance = 0.2;
};

/// Daylight as it is outside: the sky above the horizon, the ground below it, both infinitely far.
struct Sky {
  std::string name;
  SkyPattern pattern;
  double cd_m2 = 0;  ///< luminance where the pattern is 1
  double scale = 1;  ///< of all light, its colours stay
  bool by_direction = false;
  /// Columns: spectra that the radiance is a sum of, W m^-2 sr^-1 nm^-1, one at 1 cd m^-2, or the
  /// three components of daylight.
  Eigen::MatrixXd components;
  Eigen::Array3d lumens = Eigen::Array3d::Zero();  ///< luminance of each component
  bool overcast = false;                           ///< by direction, 6514 K everywhere
  Eigen::ArrayXd beam;  ///< of the sun outside, normal to it, W m^-2 nm^-1; only lights the ground
  Eigen::ArrayXd ground;  ///< radiance, W m^-2 sr^-1 nm^-1
  std::optional<Obstruction> obstruction;
};

/// How much light there is.
struct SkyAmounts {
  double horizontal_lx = 0;  ///< skylight on an open plain
  Eigen::ArrayXd beam;       ///< of the sun, normal to it, W m^-2 nm^-1
  double ground_reflectance = 0.2;
};

/// @param grid  of the spectra
[[nodiscard]] Sky make_sky(const spectra::Grid& grid, const SkyPattern& pattern,
                           const SkyColour& colour, const SkyAmounts& amounts);

/// One that gives no light.
[[nodiscard]] Sky dark_sky(const spectra::Grid& grid);

/// The same with a scale of 1.
[[nodiscard]] Sky unscaled(Sky sky);

/// What each component has in a direction above the horizon: radiance = components * this.
[[nodiscard]] Eigen::VectorXd component_weights(const Sky& sky, const Eigen::Vector3d& direction);

/// Radiance per band in a direction, of sky or ground, W m^-2 sr^-1 nm^-1; nothing stands opposite.
[[nodiscard]] Eigen::ArrayXd radiance(const Sky& sky, const Eigen::Vector3d& direction);

/// Irradiance per band of a plane outside by sky, ground and beam, W m^-2 nm^-1.
[[nodiscard]] Eigen::ArrayXd irradiance_outside(const Sky& sky, const Eigen::Vector3d& normal);

}  // namespace scenes
