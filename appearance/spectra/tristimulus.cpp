#include "appearance/spectra/tristimulus.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "appearance/spectra/cie_tables.h"

namespace spectra {
namespace {

/// step * sum of light times colour matching functions, without K_m.
Eigen::Vector3d integrate(const Spectrum& light) {
  if (light.values.size() != light.grid.count) {
    throw std::invalid_argument(fmt::format("a spectrum of {} values on a grid of {}",
                                            light.values.size(), light.grid.count));
  }
  const auto& table = colour_matching(light.grid);
  Eigen::Vector3d sums;  // three plain sums: a matrix product costs more to set up than to do
  for (int c = 0; c < 3; ++c) sums[c] = table.col(c).dot(light.values.matrix());
  return light.grid.step_nm * sums;
}

template <class Triple>
Chromaticity chromaticity_of(const Triple& xyz) {
  const double sum = xyz.x + xyz.y + xyz.z;
  if (sum == 0) return {};
  return {.x = xyz.x / sum, .y = xyz.y / sum};
}

}  // namespace

Xyz absolute_xyz(const Spectrum& light) {
  const Eigen::Vector3d xyz = kMaxLuminousEfficacy_lm_W * integrate(light);
  return {.x = xyz[0], .y = xyz[1], .z = xyz[2]};
}

RelativeXyz relative_xyz(const Xyz& xyz, double white_y) {
  if (!(white_y > 0 && std::isfinite(white_y))) {
    throw std::invalid_argument(fmt::format("the white must have a positive Y, not {}", white_y));
  }
  const double m = 100 / white_y;
  return {.x = m * xyz.x, .y = m * xyz.y, .z = m * xyz.z};
}

RelativeXyz relative_xyz(const Spectrum& reflectance, const Spectrum& light) {
  if (reflectance.grid != light.grid) {
    throw std::invalid_argument(
        fmt::format("reflectance on {}..{} nm in {} steps, light on {}..{} nm in {}",
                    reflectance.grid.first_nm, reflectance.grid.last_nm(), reflectance.grid.count,
                    light.grid.first_nm, light.grid.last_nm(), light.grid.count));
  }
  const Eigen::Vector3d white = integrate(light);
  const Spectrum reflected{.grid = light.grid, .values = reflectance.values * light.values};
  const Eigen::Vector3d xyz = integrate(reflected);
  return relative_xyz(Xyz{.x = xyz[0], .y = xyz[1], .z = xyz[2]}, white[1]);
}

Chromaticity chromaticity(const Xyz& xyz) { return chromaticity_of(xyz); }

Chromaticity chromaticity(const RelativeXyz& xyz) { return chromaticity_of(xyz); }

}  // namespace spectra
