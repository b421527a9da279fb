#pragma once
#include <Eigen/Core>

#include "appearance/spectra/grid.h"

namespace spectra {

/// Maximum luminous efficacy of radiation, lm/W, as the project's sources use it [Neumann2004].
inline constexpr double kMaxLuminousEfficacy_lm_W = 683;

/// CIE 1931 colour matching functions at the wavelengths of a grid: columns x, y, z; y is V.
/// The 1 nm table is sampled, not averaged. Cached; the reference stays valid.
/// @throws std::invalid_argument  if a wavelength of the grid is no whole nm within 360..830
[[nodiscard]] const Eigen::Matrix<double, Eigen::Dynamic, 3>& colour_matching(const Grid& grid);

/// The same of CIE 1964, for fields of 10 degrees; y is the luminous efficiency of such fields.
[[nodiscard]] Eigen::Matrix<double, Eigen::Dynamic, 3> colour_matching_10_deg(const Grid& grid);

}  // namespace spectra
