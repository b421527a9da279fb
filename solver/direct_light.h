#pragma once
#include <Eigen/Core>
#include <vector>

#include "scenes/patch_mesh.h"
#include "scenes/room.h"
#include "solver/radiosity.h"
#include "solver/visibility.h"

namespace solver {

/// Light from sources that are no patches, the paper's "first shot" [Neumann2004] 4.2: point lights
/// and the sun through openings.

/// Area means over the patches, patch x band. Solid angles, lit polygons and shadows are
/// exact; each source is then scaled, by what rounding leaves, so that all its flux arrives in the
/// closed room.
struct DirectLight {
  Bands irradiance;
  double largest_scaling = 0;  ///< max |scale - 1| over the sources
};

[[nodiscard]] DirectLight direct_light_on_patches(const scenes::Room& room,
                                                  const scenes::PatchMesh& mesh,
                                                  const std::vector<Facet>& facets,
                                                  const Visibility& visibility);

/// Irradiance per band at a surface element; shadows are sharp.
[[nodiscard]] Eigen::ArrayXd direct_light_at_point(const scenes::Room& room,
                                                   const Eigen::Vector3d& point,
                                                   const Eigen::Vector3d& normal,
                                                   const Visibility& visibility);

/// Solid angle of a polygon that shows its front to the point, sr [VanOosterom1983].
[[nodiscard]] double solid_angle(const Eigen::Vector3d& point,
                                 const std::vector<Eigen::Vector3d>& polygon);

/// Unit vector towards the sun; azimuth clockwise from +y seen from above.
[[nodiscard]] Eigen::Vector3d towards_sun(const scenes::Sun& sun);

}  // namespace solver
