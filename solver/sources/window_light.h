#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "scenes/room.h"
#include "solver/bands.h"
#include "solver/factors/slope_basis.h"
#include "solver/obstacles/visibility.h"

namespace solver {

/// Daylight through one opening: at a point, the integral of the radiance outside times what glass
/// lets through, over what the point sees of the opening. Cut by the point's own plane, by what
/// stands in the room, by the horizon and by what stands opposite, then at the sun's image, where
/// the sky has a cusp; product Gauss on the pieces, quartered where they are near.
class WindowLight {
 public:
  /// @param surface  an opening
  WindowLight(const scenes::Room& room, int surface, const scenes::Sky& sky,
              std::shared_ptr<const Visibility> visibility);

  /// Irradiance per band at a surface element, W m^-2 nm^-1.
  [[nodiscard]] Eigen::ArrayXd at_point(const Eigen::Vector3d& point,
                                        const Eigen::Vector3d& normal) const;

  /// Means over facets, facet x band, and with bases also those with psi_1 and psi_2; as the
  /// quadrature gives them, not yet closed.
  [[nodiscard]] Bands on_facets(const std::vector<Facet>& facets,
                                const std::vector<SlopeBasis>& bases) const;

  /// All that comes in, W nm^-1 per m^2 of the opening and band.
  [[nodiscard]] Eigen::ArrayXd entering() const;

  /// Radiance per band of what a point sees through the pane, itself on a line to `pane`.
  [[nodiscard]] Eigen::ArrayXd radiance(const Eigen::Vector3d& point,
                                        const Eigen::Vector3d& pane) const;

  [[nodiscard]] int surface() const { return surface_; }

  void scale(double by) { sky_.scale *= by; }

 private:
  using Polygon = std::vector<Eigen::Vector3d>;

  /// From where the opening is looked at.
  struct Station {
    Eigen::Vector3d point, normal;
    Plane horizon, over_obstruction;  ///< front: sky
    bool obstructed = false;
  };

  /// Integrals over the opening: component of the sky x distinct transmittance of the glass, and
  /// those of ground and obstruction, 1 x transmittance.
  struct Sums {
    Eigen::MatrixXd sky;
    Eigen::VectorXd ground, opposite;
  };

  [[nodiscard]] Station station(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;
  [[nodiscard]] double obstruction_rad(const Eigen::Vector3d& point) const;
  [[nodiscard]] std::vector<Polygon> seen_from(const Eigen::Vector3d& point,
                                               const Eigen::Vector3d& normal) const;
  void add_part(const Station& from, Polygon part, int order, Sums& sums) const;
  void add_sky(const Station& from, const Polygon& part, int order, Sums& sums) const;
  [[nodiscard]] Eigen::ArrayXd integral(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                                        int order) const;
  void add_facet(const Facet& facet, const SlopeBasis* basis, const Polygon& part, int level,
                 Bands& means) const;
  [[nodiscard]] double distance_m(const Eigen::Vector3d& point) const;
  [[nodiscard]] Eigen::ArrayXd passed(const Eigen::Vector3d& direction) const;
  [[nodiscard]] Eigen::ArrayXd in_bands(const Sums& sums) const;

  int surface_;
  scenes::Sky sky_;
  std::optional<scenes::Glass> glass_;
  Eigen::ArrayXd transmittance_;  ///< per band; without glass
  std::shared_ptr<const Visibility> visibility_;
  Facet opening_;  ///< its front is the room's side
  SeparationMask mask_;
  Eigen::Vector3d along_, outwards_;  ///< level: along the opening, and away from the room
  bool upright_ = true;      ///< not flat like a roof's skylight: something can be opposite
  Eigen::ArrayXd opposite_;  ///< radiance of the obstruction
  std::vector<std::vector<Blocker>> alone_;  ///< each blocker by itself
};

}  // namespace solver
