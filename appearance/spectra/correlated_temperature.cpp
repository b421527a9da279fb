#include "appearance/spectra/correlated_temperature.h"

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <vector>

#include "appearance/spectra/cie_tables.h"

namespace spectra {
namespace {

using Eigen::Vector2d;

constexpr double kLeast_MK = 10, kMost_MK = 1000;  ///< 100 000 and 1000 K in mired

Vector2d uv_of(double x, double y) {
  const double d = -2 * x + 12 * y + 3;
  return {4 * x / d, 6 * y / d};
}

/// A point of the locus; its temperature by its inverse, in which it runs evenly.
Vector2d locus(double mired) {
  constexpr double kC2_nm_K = 1.438776877e7;
  const auto& table = colour_matching(kClosedFormGrid);
  Eigen::Vector3d xyz = Eigen::Vector3d::Zero();
  for (int k = 0; k < kClosedFormGrid.count; ++k) {
    const double nm = kClosedFormGrid.wavelength_nm(k);
    const double power = std::pow(560 / nm, 5) / std::expm1(kC2_nm_K / nm * mired * 1e-6);
    xyz += power * table.row(k).transpose();
  }
  return uv_of(xyz[0] / xyz.sum(), xyz[1] / xyz.sum());
}

/// Every 5 mired.
const std::vector<Vector2d>& locus_table() {
  static const std::vector<Vector2d> table = [] {
    std::vector<Vector2d> points;
    for (double mired = kLeast_MK; mired <= kMost_MK; mired += 5) points.push_back(locus(mired));
    return points;
  }();
  return table;
}

}  // namespace

std::optional<CorrelatedTemperature> correlated_temperature(const Chromaticity& of) {
  if (!(of.x > 0 && of.y > 0)) return std::nullopt;
  const Vector2d at = uv_of(of.x, of.y);
  const std::vector<Vector2d>& table = locus_table();
  std::size_t nearest = 0;
  for (std::size_t k = 1; k < table.size(); ++k) {
    if ((table[k] - at).norm() < (table[nearest] - at).norm()) nearest = k;
  }
  double low = std::max(kLeast_MK, kLeast_MK + 5 * (static_cast<double>(nearest) - 1)),
         high = std::min(kMost_MK, kLeast_MK + 5 * (static_cast<double>(nearest) + 1));
  constexpr double kGolden = std::numbers::phi - 1;
  for (int step = 0; step < 40; ++step) {  // golden section, to 1e-7 mired
    const double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
    ((locus(a) - at).squaredNorm() < (locus(b) - at).squaredNorm() ? high : low) =
        (locus(a) - at).squaredNorm() < (locus(b) - at).squaredNorm() ? b : a;
  }
  const double mired = (low + high) / 2;
  const Vector2d offset = at - locus(mired);
  constexpr double kFarthest = 0.05, kEnd_MK = 0.01;
  const bool at_end = mired < kLeast_MK + kEnd_MK || mired > kMost_MK - kEnd_MK;
  if (offset.norm() > kFarthest || at_end) return std::nullopt;
  return CorrelatedTemperature{.cct_K = 1e6 / mired,
                               .duv = offset.y() < 0 ? -offset.norm() : offset.norm()};
}

}  // namespace spectra
