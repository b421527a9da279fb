#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "scenes/room.h"
#include "solver/factors/slope_basis.h"
#include "solver/obstacles/blocker.h"
#include "solver/sources/intensity_quadrature.h"

namespace solver {

/// A luminaire and what stands in its way. Far away it is a point; nearer its luminous area is cut
/// into equal elements that share its intensity, each with the whole distribution: right for even
/// diffusers. The faces of a body share the intensity in a direction as they show themselves in it;
/// cylinders and spheres count as boxes of their size.
class LuminaireSource {
 public:
  LuminaireSource(const scenes::PlacedLuminaire& luminaire, const std::vector<Blocker>& blockers);

  /// Spectral flux per lumen of the file, W nm^-1 lm^-1.
  [[nodiscard]] const Eigen::ArrayXd& per_lumen() const { return per_lumen_; }

  void scale(double by) { per_lumen_ *= by; }

  /// Flux on each facet, lm of the file; with psi_1, psi_2 where there are bases. All facets get it
  /// from the same elements, no larger than a fifth of the way to the nearest facet, or than an
  /// eighth of the luminaire; so nothing of the flux is lost between them.
  [[nodiscard]] std::vector<Eigen::Vector3d> on_facets(const std::vector<Facet>& facets,
                                                       const std::vector<SlopeBasis>& bases) const;

  /// What reaches a closed room, lm of the file: all; or `arriving` where the luminaire is flush
  /// with a surface, which takes what is sent into it.
  [[nodiscard]] double flux_lm(const std::vector<Facet>& facets, double arriving_lm) const;

  /// Illuminance of a surface element, lx of the file; from elements no larger than a tenth of the
  /// way, or than a sixteenth of the luminaire.
  [[nodiscard]] double at_point(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;

 private:
  /// A side of the luminous body.
  struct Face {
    Eigen::Vector3d normal;  ///< in the room; zero: shines to both sides
    double area_m2 = 0;
  };

  struct Element {
    Eigen::Vector3d at_m;
    int face = 0;
    double share = 1;  ///< of the face's intensity
    Shadows shadows;
  };

  using Elements = std::vector<Element>;

  [[nodiscard]] Elements cut(int longest_parts, const std::vector<Blocker>& blockers) const;
  void add_face(Elements& elements, int face, int across, double part_m,
                const std::vector<Blocker>& blockers) const;
  [[nodiscard]] double distance_m(const Eigen::Vector3d& point) const;
  [[nodiscard]] const Elements& elements(double distance_m, double parts_per_distance,
                                         int most) const;
  [[nodiscard]] const Elements& elements_for(const std::vector<Facet>& facets) const;
  [[nodiscard]] double intensity_cd(const Element& element, const Eigen::Vector3d& direction) const;

  scenes::PlacedLuminaire luminaire_;
  Eigen::ArrayXd per_lumen_;
  std::vector<Face> faces_;
  std::shared_ptr<const std::vector<Elements>> levels_;  ///< 1, 2, 4, ... parts along the longest
};

}  // namespace solver
