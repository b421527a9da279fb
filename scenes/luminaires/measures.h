#pragma once
#include <vector>

#include "scenes/luminaires/luminaire.h"

namespace scenes {

/// Flux between two angles from straight down, lm. Types A and B: of the sphere around the optical
/// axis, by their own interpolant to about 1e-4.
struct Zone {
  double from_deg = 0, to_deg = 0, flux_lm = 0;
};

/// 0..30, 30..60, 60..80, 80..90, 90..120, 120..180.
[[nodiscard]] std::vector<Zone> zones(const IntensityTable& intensity);

/// The optical axis of a table: -z, or x for type A.
[[nodiscard]] Eigen::Vector3d axis_of(const IntensityTable& intensity);

/// How far from the optical axis towards `side` there is still this share of the peak, degrees.
[[nodiscard]] double reach_deg(const IntensityTable& intensity, const Eigen::Vector3d& side,
                               double share);

/// Share of the flux that leaves to the back of a plane through the centre.
[[nodiscard]] double share_behind(const IntensityTable& intensity, const Eigen::Vector3d& front);

}  // namespace scenes
