#pragma once
#include <Eigen/Core>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "appearance/spectra/rgb_space.h"
#include "appearance/spectra/tristimulus.h"
#include "solver/rooms/room_light.h"

namespace solver {

/// A room with three numbers for every light in place of its spectrum: what the numbers are, and
/// what a surface does with them.
struct ColourModel {
  std::string name;         ///< "rgb:srgb", "bilinear:granier-iso", "display:spectral", ...
  spectra::RgbSpace space;  ///< of light: spectra::rgb_of_light, lm m^-2
  /// Diagonal where the components keep to themselves.
  std::function<Eigen::Matrix3d(const spectra::Spectrum& reflectance)> reflection;
  std::string approximation;  ///< what is approximate, in a sentence
};

/// By name:
/// - rgb[:SPACE]: light and reflectance multiplied component by component; SPACE of
///   spectra::rgb_spaces(), default srgb.
/// - bilinear[:SET[:alpha=r,g,b]]: the product of [Granier2004]; SET of
///   spectra::bilinear_set_names(), default granier-iso.
/// - display[:MODE]: object colours as matrices in the display space srgb [Kolchin2001], from a
///   reference space: spectral (default), xyz, iso, bt2020 or acescg; or diagonal, exact for D65.
/// @throws std::invalid_argument  naming what there is; for display:reference-light the reason why
/// it cannot be solved
[[nodiscard]] ColourModel colour_model(std::string_view name);

/// Negative values among the three numbers: the model's, not clamped.
struct NegativeLight {
  int irradiance = 0, radiosity = 0;  ///< patches with a negative component
  double lowest = 0;  ///< most negative component relative to the brightest; 0 if none is negative
};

struct ColourSolution {
  RoomSolution light;            ///< as solve_room, with r, g, b (lm m^-2) in place of bands
  Eigen::Matrix3d xyz_from_rgb;  ///< absolute tristimulus values of such light
  std::vector<Eigen::Matrix3d> reflections;  ///< per surface
  NegativeLight negative;
};

/// As solve_room. Light is projected linearly from its spectrum; point lights and sun too.
[[nodiscard]] ColourSolution solve_room_colour(const scenes::Room& room,
                                               const RoomTransport& transport,
                                               const ColourModel& model,
                                               const RadiosityOptions& options = {});

/// The light in the eye at a viewed point as in viewed_light, in tristimulus values (Y in
/// lm m^-2); the white is an ideal diffuser there.
struct ViewedColours {
  spectra::Xyz sample, background, field, white;
};

[[nodiscard]] ViewedColours viewed_colours(const scenes::Room& room, const RoomTransport& transport,
                                           const ColourSolution& solution, std::size_t viewed = 0);

}  // namespace solver
