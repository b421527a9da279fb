#pragma once
#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "appearance/spectra/spectrum.h"

namespace spectra {

/// Relative spectral power; the scale has no meaning. Names: A, C, D50, D55, D65, D75, E.
/// @throws std::invalid_argument  naming the known illuminants
[[nodiscard]] Samples illuminant(std::string_view name);
[[nodiscard]] const std::vector<std::string>& illuminant_names();

/// [Neumann2004] eq. 7, at 1 nm, 355..835 nm. @throws std::invalid_argument  outside 100..1e6 K
[[nodiscard]] Samples planck(double temperature_K);

/// CIE daylight of a correlated colour temperature. @throws std::invalid_argument  outside
/// 4000..25000 K
[[nodiscard]] Samples daylight(double cct_K);

/// S0, S1, S2 of [CIE15]: daylight is S0 + m1 S1 + m2 S2.
[[nodiscard]] std::array<Samples, 3> daylight_components();
/// m1 and m2 of a temperature from 4000 to 25000 K, unrounded.
[[nodiscard]] Eigen::Vector2d daylight_weights(double cct_K);

/// A light source of [Neumann2004] Table 4: Planckian, with its efficacy where one is printed.
struct LampPreset {
  std::string name;
  double temperature_K = 0;
  double efficacy_lm_W = 0;  ///< 0: not printed
};

[[nodiscard]] const std::vector<LampPreset>& lamp_presets();

}  // namespace spectra
