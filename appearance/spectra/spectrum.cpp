#include "appearance/spectra/spectrum.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace spectra {
namespace {

void require_curve(const Samples& samples) {
  if (samples.nm.empty() || samples.nm.size() != samples.values.size()) {
    throw std::invalid_argument(fmt::format("a curve of {} wavelengths and {} values",
                                            samples.nm.size(), samples.values.size()));
  }
  for (std::size_t i = 0; i < samples.nm.size(); ++i) {
    if (!std::isfinite(samples.nm[i]) || !std::isfinite(samples.values[i])) {
      throw std::invalid_argument(
          fmt::format("{} at {} nm in a curve", samples.values[i], samples.nm[i]));
    }
    if (i > 0 && samples.nm[i] <= samples.nm[i - 1]) {
      throw std::invalid_argument(fmt::format("wavelengths of a curve must rise: {} nm after {} nm",
                                              samples.nm[i], samples.nm[i - 1]));
    }
  }
}

void require_covered(const Samples& samples, const Grid& grid) {
  const std::string missing = missing_range(samples, grid);
  if (grid != kClosedFormGrid && !missing.empty()) {
    throw std::invalid_argument(fmt::format("the curve covers {}..{} nm and lacks {}",
                                            samples.nm.front(), samples.nm.back(), missing));
  }
}

double interpolate(const Samples& samples, std::size_t left, double wavelength_nm) {
  const double t = (wavelength_nm - samples.nm[left]) / (samples.nm[left + 1] - samples.nm[left]);
  return std::lerp(samples.values[left], samples.values[left + 1], t);
}

/// Linear between the samples, the end values beyond.
double value_at(const Samples& samples, double wavelength_nm) {
  if (wavelength_nm <= samples.nm.front()) return samples.values.front();
  if (wavelength_nm >= samples.nm.back()) return samples.values.back();
  const auto right = std::upper_bound(samples.nm.begin(), samples.nm.end(), wavelength_nm);
  return interpolate(samples, static_cast<std::size_t>(right - samples.nm.begin()) - 1,
                     wavelength_nm);
}

/// Mean of the piecewise-linear curve over from_nm..to_nm, exact: trapezia between its corners.
double mean_over(const Samples& samples, double from_nm, double to_nm) {
  double area = 0, nm = from_nm, value = value_at(samples, from_nm);
  auto corner = std::upper_bound(samples.nm.begin(), samples.nm.end(), from_nm);
  while (nm < to_nm) {
    const double next_nm = corner == samples.nm.end() ? to_nm : std::min(*corner++, to_nm);
    const double next_value = value_at(samples, next_nm);
    area += (next_nm - nm) * (value + next_value) / 2;
    nm = next_nm;
    value = next_value;
  }
  return area / (to_nm - from_nm);
}

bool is_at_band_centres(const Samples& samples, const Grid& grid) {
  if (samples.nm.size() != static_cast<std::size_t>(grid.count)) return false;
  for (int k = 0; k < grid.count; ++k) {
    if (samples.nm[static_cast<std::size_t>(k)] != grid.wavelength_nm(k)) return false;
  }
  return true;
}

}  // namespace

Spectrum constant(const Grid& grid, double value) {
  return {.grid = grid, .values = Eigen::ArrayXd::Constant(grid.count, value)};
}

std::string missing_range(const Samples& samples, const Grid& grid) {
  require_curve(samples);
  std::string missing;
  if (samples.nm.front() > grid.first_nm) {
    missing = fmt::format("{}..{}", grid.first_nm, std::min(samples.nm.front(), grid.last_nm()));
  }
  if (samples.nm.back() < grid.last_nm()) {
    missing += fmt::format("{}{}..{}", missing.empty() ? "" : " and ",
                           std::max(samples.nm.back(), grid.first_nm), grid.last_nm());
  }
  return missing.empty() ? missing : missing + " nm";
}

Spectrum reflectance_on(const Grid& grid, const Samples& samples) {
  require_covered(samples, grid);
  Spectrum s = constant(grid, 0);
  for (int k = 0; k < grid.count; ++k) s.values[k] = value_at(samples, grid.wavelength_nm(k));
  return s;
}

Spectrum light_on(const Grid& grid, const Samples& samples) {
  require_covered(samples, grid);
  const bool point_values = grid == kClosedFormGrid || is_at_band_centres(samples, grid);
  Spectrum s = constant(grid, 0);
  for (int k = 0; k < grid.count; ++k) {
    const double nm = grid.wavelength_nm(k);
    if (nm < samples.nm.front() || nm > samples.nm.back())
      continue;  // on the closed-form grid: dark
    const double from_nm = std::max(nm - grid.step_nm / 2, grid.first_nm);
    const double to_nm = std::min(nm + grid.step_nm / 2, grid.last_nm());
    s.values[k] = point_values ? value_at(samples, nm) : mean_over(samples, from_nm, to_nm);
  }
  return s;
}

}  // namespace spectra
