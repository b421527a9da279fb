#pragma once
#include <Eigen/Core>
#include <vector>

#include "scenes/mesh/patch_mesh.h"
#include "scenes/room.h"
#include "solver/bands.h"
#include "solver/factors/slope_basis.h"
#include "solver/obstacles/visibility.h"
#include "solver/sources/luminaire_light.h"
#include "solver/sources/window_light.h"

namespace solver {

/// Light from sources that are no patches, the paper's "first shot" [Neumann2004] 4.2: point
/// lights, luminaires, and sun and sky through openings.

/// Area means over the patches, patch x band, and, where bases are given, below them the means with
/// psi_1, then with psi_2. Solid angles, lit polygons, their moments, and shadows are exact, the
/// light of luminaires and of the sky is integrated by quadrature; each source is then scaled, by
/// what rounding or quadrature leaves, so that all its flux arrives in the closed room.
struct DirectLight {
  Bands irradiance;
  /// Of each point light, then of each sun through each opening, each luminaire, each sky through
  /// each opening.
  std::vector<double> scaling;

  /// max |scale - 1|
  [[nodiscard]] double largest_scaling() const;
};

struct PointSource {
  Eigen::Vector3d at_m;
  Eigen::ArrayXd intensity;  ///< W sr^-1 nm^-1
  Shadows shadows;
};

/// The sun through one opening: a prism of parallel light.
struct SunBeam {
  int surface = 0;  ///< the opening
  Eigen::Vector3d to_sun;
  Plane opening;             ///< front: into the room
  std::vector<Plane> sides;  ///< the prism is in front of all
  Shadows shadows;           ///< of what is on the room's side of the opening
  Eigen::ArrayXd normal_irradiance;
};

/// The point lights, suns and luminaires of a room, and what stands in their way.
class DirectSources {
 public:
  DirectSources(const scenes::Room& room, const Visibility& visibility);

  /// Every source times a number, in the order of DirectLight::scaling.
  [[nodiscard]] DirectSources scaled(const std::vector<double>& by) const;

  /// @param bases  of the facets where light is linear on them; else empty
  [[nodiscard]] DirectLight on_patches(const scenes::PatchMesh& mesh,
                                       const std::vector<Facet>& facets,
                                       const std::vector<SlopeBasis>& bases = {}) const;

  /// Irradiance per band at a surface element; shadows are sharp.
  [[nodiscard]] Eigen::ArrayXd at_point(const Eigen::Vector3d& point,
                                        const Eigen::Vector3d& normal) const;

  /// The parts of it: from skies, which throw no sharp shadows, and from all others.
  [[nodiscard]] Eigen::ArrayXd sharp_at(const Eigen::Vector3d& point,
                                        const Eigen::Vector3d& normal) const;
  [[nodiscard]] Eigen::ArrayXd skylight_at(const Eigen::Vector3d& point,
                                           const Eigen::Vector3d& normal) const;

  /// Radiance per band that a point sees of the sky in `pane`, a point of an opening.
  [[nodiscard]] Eigen::ArrayXd radiance(const Eigen::Vector3d& point, const Eigen::Vector3d& pane,
                                        int surface) const;

  /// Mean irradiance without skylight over a polygon that is small, like a pixel: the light is that
  /// of its middle, but where the edge of a shadow crosses it, of the middles of what is lit.
  [[nodiscard]] Eigen::ArrayXd over(const std::vector<Eigen::Vector3d>& polygon,
                                    const Eigen::Vector3d& middle,
                                    const Eigen::Vector3d& normal) const;

  /// Whether there is none but skies.
  [[nodiscard]] bool empty_but_for_skies() const {
    return lamps_.empty() && beams_.empty() && luminaires_.empty();
  }

  [[nodiscard]] bool has_skies() const { return !windows_.empty(); }

 private:
  Eigen::Index bands_;
  std::vector<PointSource> lamps_;
  std::vector<SunBeam> beams_;
  std::vector<LuminaireSource> luminaires_;
  std::vector<WindowLight> windows_;  ///< each sky through each opening
};

/// Solid angle of a polygon that shows its front to the point, sr [VanOosterom1983].
[[nodiscard]] double solid_angle(const Eigen::Vector3d& point,
                                 const std::vector<Eigen::Vector3d>& polygon);

/// Integral over a polygon of the vector from the point to x, by solid angle, as far as it lies in
/// the polygon's plane, m sr: that of the gradient of 1 / r, so a sum over the edges.
[[nodiscard]] Eigen::Vector3d solid_angle_moment(const Eigen::Vector3d& point,
                                                 const std::vector<Eigen::Vector3d>& polygon,
                                                 const Eigen::Vector3d& normal);

/// Unit vector towards the sun; azimuth clockwise from +y seen from above.
[[nodiscard]] Eigen::Vector3d towards_sun(const scenes::Sun& sun);

}  // namespace solver
