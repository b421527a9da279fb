#pragma once
#include <array>
#include <string_view>

#include "appearance/spectra/spectrum.h"

namespace spectra {

/// What the five receptors of the eye take in [CIES026].
enum class Receptor { s_cone, m_cone, l_cone, rhodopic, melanopic };

inline constexpr int kReceptors = 5;

/// "S_cone", "M_cone", "L_cone", "rhodopic", "melanopic"
[[nodiscard]] std::string_view to_string(Receptor receptor);

/// Relative sensitivity, 1 at its peak: cones of 10 degrees, rods, both tabulated at 5 nm;
/// melanopsin by the template of [Govardovskii2000] at 480 nm behind the lens of the standard. 0
/// outside 390 to 780 nm (melanopsin: 400 to 700).
[[nodiscard]] double sensitivity(Receptor receptor, double nm);

/// Equivalent daylight (D65) illuminance of each receptor, lx: how bright daylight would have to be
/// to do as much. Sums over the bands.
/// @param light  irradiance, W m^-2 nm^-1
[[nodiscard]] std::array<double, kReceptors> equivalent_daylight_lx(const Spectrum& light);

}  // namespace spectra
