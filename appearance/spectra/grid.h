#pragma once

namespace spectra {

/// Evenly spaced wavelengths. A band of transport is one of them.
struct Grid {
  double first_nm = 0;
  double step_nm = 0;
  int count = 0;

  [[nodiscard]] constexpr double wavelength_nm(int k) const { return first_nm + k * step_nm; }

  [[nodiscard]] constexpr double last_nm() const { return wavelength_nm(count - 1); }

  bool operator==(const Grid&) const = default;
};

/// 31 bands, 400..700 nm: light transport, the default everywhere.
inline constexpr Grid kTransportGrid{.first_nm = 400, .step_nm = 10, .count = 31};

/// 471 samples, 360..830 nm: closed forms, and the judge of the 31 bands.
inline constexpr Grid kClosedFormGrid{.first_nm = 360, .step_nm = 1, .count = 471};

}  // namespace spectra
