#include "appearance/spectra/rgb_space.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/LU>
#include <algorithm>
#include <stdexcept>

#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/tristimulus.h"

namespace spectra {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

Vector3d xyz_of_unit_luminance(const Chromaticity& c) {
  return {c.x / c.y, 1, (1 - c.x - c.y) / c.y};
}

Matrix3d balanced(const Matrix3d& primaries, const Vector3d& white) {
  return primaries * primaries.partialPivLu().solve(white).asDiagonal();
}

Matrix3d from_primaries(const Chromaticity& r, const Chromaticity& g, const Chromaticity& b,
                        const Chromaticity& white) {
  Matrix3d primaries;
  primaries << xyz_of_unit_luminance(r), xyz_of_unit_luminance(g), xyz_of_unit_luminance(b);
  return balanced(primaries, xyz_of_unit_luminance(white));
}

std::vector<RgbSpace> make_spaces() {
  constexpr Chromaticity kD65{.x = 0.3127, .y = 0.3290};
  const Matrix3d bt709 = from_primaries({0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, kD65);
  const Matrix3d bt2020 = from_primaries({0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, kD65);
  const Matrix3d ap1 =
      from_primaries({0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, {0.32168, 0.33767});
  // The white of ACES is near daylight of 6000 K, on the scale of 1931 on which D65 has 6500 K.
  const Samples d60 = daylight(6000 * 1.4388 / 1.4380);
  const Matrix3d white_to_equal_energy = xyz_of_unit_luminance(kD65).cwiseInverse().asDiagonal();
  return {{"srgb", bt709, illuminant("D65")},
          {"bt2020", bt2020, illuminant("D65")},
          {"acescg", ap1, d60},
          {"xyz", Matrix3d::Identity(), illuminant("E")},
          {"iso", white_to_equal_energy * bt709, illuminant("E")}};
}

Vector3d vector(const Xyz& xyz) { return {xyz.x, xyz.y, xyz.z}; }

}  // namespace

const std::vector<RgbSpace>& rgb_spaces() {
  static const std::vector<RgbSpace> spaces = make_spaces();
  return spaces;
}

const RgbSpace& rgb_space(std::string_view name) {
  const auto& all = rgb_spaces();
  const auto found = std::ranges::find(all, name, &RgbSpace::name);
  if (found != all.end()) return *found;
  std::vector<std::string> names;
  for (const RgbSpace& space : all) names.push_back(space.name);
  throw std::invalid_argument(
      fmt::format("no RGB space \"{}\"; there are {}", name, fmt::join(names, ", ")));
}

Matrix3d xyz_from_rgb_on(const Grid& grid, const RgbSpace& space) {
  const Vector3d white = vector(absolute_xyz(light_on(grid, space.white)));
  return balanced(space.xyz_from_rgb, white / white[1]);
}

Vector3d rgb_of_light(const RgbSpace& space, const Spectrum& light) {
  return xyz_from_rgb_on(light.grid, space).partialPivLu().solve(vector(absolute_xyz(light)));
}

Vector3d rgb_of_reflectance(const RgbSpace& space, const Spectrum& reflectance) {
  const Spectrum white = light_on(reflectance.grid, space.white);
  const Spectrum reflected{.grid = white.grid, .values = white.values * reflectance.values};
  return rgb_of_light(space, reflected) / absolute_xyz(white).y;
}

}  // namespace spectra
