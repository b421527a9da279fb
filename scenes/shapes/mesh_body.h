#pragma once
#include <string>
#include <vector>

#include "scenes/room.h"

namespace scenes {

/// A plane or nearly plane polygon of a mesh.
struct MeshPolygon {
  Outline outline;
  int part = 0;  ///< as of Body::part_of_face
};

/// A body from a mesh, and what is wrong with it.
struct MeshBody {
  Body body;
  std::vector<std::string> notes;
  std::vector<std::string> faults;  ///< with the coordinates
};

inline constexpr std::size_t kMostMeshFaces = 2000;

/// Welds corners, leaves out what has no area, parts bent quadrilaterals, joins triangles that make
/// a plane polygon, and turns fronts outwards. What is convex and closed hides as a whole, all else
/// face by face.
/// @param two_sided  thin: not closed, reflects on both sides
[[nodiscard]] MeshBody mesh_body(std::string name, const std::vector<MeshPolygon>& polygons,
                                 bool two_sided);

}  // namespace scenes
