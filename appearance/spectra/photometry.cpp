#include "appearance/spectra/photometry.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "appearance/spectra/cie_tables.h"
#include "appearance/spectra/tristimulus.h"

namespace spectra {

double luminous(const Spectrum& light) {
  if (light.values.size() != light.grid.count) return absolute_xyz(light).y;  // which refuses it
  return kMaxLuminousEfficacy_lm_W * light.grid.step_nm *
         colour_matching(light.grid).col(1).dot(light.values.matrix());
}

Spectrum scaled_to_luminous(const Spectrum& shape, double amount) {
  const double unscaled = luminous(shape);
  if (!(unscaled > 0 && std::isfinite(unscaled))) {
    throw std::invalid_argument(
        fmt::format("a light of luminance {} cannot be scaled to {}", unscaled, amount));
  }
  if (!(amount >= 0 && std::isfinite(amount))) {
    throw std::invalid_argument(
        fmt::format("a photometric amount must be 0 or more, not {}", amount));
  }
  return {.grid = shape.grid, .values = shape.values * (amount / unscaled)};
}

}  // namespace spectra
