#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "appearance/spectra/grid.h"

namespace spectra {

/// A quantity at each wavelength of a grid. The name of the variable says which quantity; light is
/// a density, W m^-2 nm^-1 (or relative), reflectance a fraction 0..1.
struct Spectrum {
  Grid grid;
  Eigen::ArrayXd values;  ///< grid.count of them
};

/// A measured curve as it was published: strictly rising wavelengths, linear in between.
struct Samples {
  std::vector<double> nm;
  std::vector<double> values;
};

[[nodiscard]] Spectrum constant(const Grid& grid, double value);

/// What `samples` lacks to cover the grid, e.g. "400..415 nm"; empty if nothing is missing.
/// The transport grid must be covered; the 1 nm grid completes what is short (see below).
[[nodiscard]] std::string missing_range(const Samples& samples, const Grid& grid);

/// Reflectance or transmittance: point values at the grid's wavelengths, linear between samples.
/// Beyond the samples the end value is kept on the closed-form grid only.
/// @throws std::invalid_argument  if the curve falls short of any other grid
[[nodiscard]] Spectrum reflectance_on(const Grid& grid, const Samples& samples);

/// Light: means over each band, +- step/2 and one-sided at both ends of the grid; data given at
/// exactly the grid's wavelengths are the band values already. On the closed-form grid: point
/// values, and 0 beyond the samples.
/// @throws std::invalid_argument  if the curve falls short of any other grid
[[nodiscard]] Spectrum light_on(const Grid& grid, const Samples& samples);

}  // namespace spectra
