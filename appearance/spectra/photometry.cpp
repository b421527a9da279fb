#include "appearance/spectra/photometry.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "appearance/spectra/tristimulus.h"

namespace spectra {

double luminous(const Spectrum& light) { return absolute_xyz(light).y; }

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
