#pragma once
#include <vector>

#include "scenes/mesh/patch_mesh.h"
#include "scenes/room.h"
#include "solver/factors/facet.h"

namespace solver {

/// The room in as few convex patches as there can be.
[[nodiscard]] scenes::PatchMesh whole_mesh(const scenes::Room& room);

/// What one surface has in one plane, whole: no patches.
struct RoomFace {
  int surface = 0;           ///< into Room::surfaces
  int plane = 0;             ///< numbered as in every mesh of the room
  std::vector<Facet> parts;  ///< convex; openings, panels and contacts of furniture cut out
  Eigen::Vector3d normal;
  double area_m2 = 0;
};

[[nodiscard]] std::vector<RoomFace> room_faces(const scenes::Room& room);

/// Area mean over a facet of the form factor to a polygon that nothing hides; made for facets much
/// smaller than the polygon.
[[nodiscard]] double mean_form_factor(const Facet& facet, const Facet& polygon);

}  // namespace solver
