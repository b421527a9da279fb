#pragma once
#include <vector>

#include "scenes/mesh/patch_mesh.h"
#include "scenes/room.h"
#include "solver/bounce/radiosity.h"
#include "solver/sources/direct_light.h"

namespace solver {

/// The extended ambient term [Castro2000], the cheap answer that [Neumann2004] 4.3 names for really
/// complex scenes: no occlusion, only back faces and quasi-shadows.
///
/// - The room becomes an axis-aligned box. A face of normal n counts for the side whose inward
///   normal is +-e with weight (n . e)^2, if n . e has the side's sign: a back face counts for the
///   opposite side. Each side has the area, and the area-mean reflectance, of all that counts for
///   it; the box's edges follow from the mean areas of opposite sides.
/// - Direct light falls on every face that is turned to the source, whatever stands between.
/// - Quasi-shadows: light that so reaches a face and the face behind it too is taken from all
/// alike.
///   Each source is scaled so that its faces get just its flux; exchange between sides is scaled
///   symmetrically so that its rows close. So energy is conserved in any room, and where everything
///   reflects alike the mean irradiance is exact.
/// - Interreflection is solved between the six sides; a surface element gets the direct light at
///   its own place, and of the sides' indirect light its share by (n . e)^2.
/// The papers leave open how quasi-shadows are made and whether direct light has them: the scaling
/// is this project's reading.
struct AmbientTerm {
  scenes::PatchMesh faces;      ///< whole, in convex parts
  Bands direct;                 ///< D, face x band, area means
  Bands indirect;               ///< side x band: +x, -x, +y, -y, +z, -z by inward normal
  Eigen::ArrayXd lamp_scaling;  ///< per face, 0 where it does not shine
  DirectSources sources;        ///< point lights and suns, each opening's beam scaled by itself

  /// Area mean of H on each face.
  [[nodiscard]] Bands irradiance() const;
};

[[nodiscard]] AmbientTerm solve_ambient_term(const scenes::Room& room);

/// Irradiance at points of the room, point x band, from nothing but the room: no mesh, no rays,
/// some milliseconds.
[[nodiscard]] Bands extended_ambient_term(const scenes::Room& room,
                                          const std::vector<scenes::Receiver>& at);

}  // namespace solver
