#pragma once
#include <Eigen/Core>
#include <vector>

#include "solver/factors/point_factors.h"
#include "solver/obstacles/visibility.h"

namespace solver {

/// Panels, lit openings and whatever else shines by area, whole; and what stands in their way.
class AreaLamps {
 public:
  /// @param exitance  S of each facet, W m^-2 nm^-1; those of 0 are no lamps
  AreaLamps(const std::vector<Facet>& facets, const std::vector<Eigen::ArrayXd>& exitance,
            const Visibility& visibility);

  /// Adds their irradiance per band at a surface element: form factors are exact [Lambert1760],
  /// shadows included.
  void add(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
           Eigen::ArrayXd& irradiance) const;

 private:
  struct Lamp {
    Facet facet;
    Eigen::ArrayXd exitance;
    SeparationMask mask;
  };

  using Polygons = std::vector<std::vector<Eigen::Vector3d>>;

  /// What of a lamp is seen from a point.
  [[nodiscard]] Polygons lit_parts(const Lamp& lamp, const SeparationMask& mask,
                                   const Eigen::Vector3d& point) const;

  std::vector<Lamp> lamps_;
  PointFactors factors_;
  const Visibility& visibility_;
  std::vector<std::vector<Blocker>> alone_;  ///< each blocker by itself
};

}  // namespace solver
