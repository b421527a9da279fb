#include "scenes/luminaires/measures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace scenes {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;

/// The midpoints of a fine net about the optical axis, with the flux each stands for, lm.
void each_direction(const IntensityTable& intensity,
                    const std::function<void(const Vector3d&, double polar_deg, double)>& use) {
  constexpr int kPolar = 720, kAzimuth = 360;
  const Vector3d axis = axis_of(intensity), side = Vector3d::UnitY(), other = axis.cross(side);
  for (int p = 0; p < kPolar; ++p) {
    const double low = std::numbers::pi * p / kPolar, high = std::numbers::pi * (p + 1) / kPolar,
                 polar = (low + high) / 2;
    const double solid_angle_sr =
        (std::cos(low) - std::cos(high)) * 2 * std::numbers::pi / kAzimuth;
    for (int a = 0; a < kAzimuth; ++a) {
      const double azimuth = 2 * std::numbers::pi * (a + 0.5) / kAzimuth;
      const Vector3d direction =
          std::cos(polar) * axis +
          std::sin(polar) * (std::cos(azimuth) * side + std::sin(azimuth) * other);
      use(direction, polar / kDegree, intensity.at(direction) * solid_angle_sr);
    }
  }
}

}  // namespace

Vector3d axis_of(const IntensityTable& intensity) {
  return intensity.type() == Goniometry::a ? Vector3d(1, 0, 0) : Vector3d(0, 0, -1);
}

std::vector<Zone> zones(const IntensityTable& intensity) {
  std::vector<Zone> all{{0, 30}, {30, 60}, {60, 80}, {80, 90}, {90, 120}, {120, 180}};
  if (intensity.type() == Goniometry::c) {
    for (Zone& zone : all) zone.flux_lm = intensity.flux_lm(zone.from_deg, zone.to_deg);
    return all;
  }
  each_direction(intensity, [&](const Vector3d&, double polar_deg, double flux_lm) {
    const auto zone =
        std::ranges::find_if(all, [&](const Zone& z) { return polar_deg < z.to_deg; });
    zone->flux_lm += flux_lm;
  });
  return all;
}

double reach_deg(const IntensityTable& intensity, const Vector3d& side, double share) {
  constexpr double kStep_deg = 0.05;
  const Vector3d axis = axis_of(intensity);
  const double wanted_cd = share * intensity.peak_cd();
  const auto at = [&](double angle_deg) {
    return intensity.at(std::cos(kDegree * angle_deg) * axis +
                        std::sin(kDegree * angle_deg) * side);
  };
  double inside = 180;
  while (inside > 0 && at(inside) < wanted_cd) inside -= kStep_deg;
  if (inside <= 0) return 0;
  double outside = std::min(180.0, inside + kStep_deg);
  for (int k = 0; k < 30; ++k) {
    const double middle = (inside + outside) / 2;
    (at(middle) < wanted_cd ? outside : inside) = middle;
  }
  return inside;
}

double share_behind(const IntensityTable& intensity, const Vector3d& front) {
  double behind_lm = 0, all_lm = 0;
  each_direction(intensity, [&](const Vector3d& direction, double, double flux_lm) {
    all_lm += flux_lm;
    if (direction.dot(front) < 0) behind_lm += flux_lm;
  });
  return all_lm > 0 ? behind_lm / all_lm : 0;
}

}  // namespace scenes
