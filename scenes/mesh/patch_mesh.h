#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "scenes/room.h"

namespace scenes {

/// The room cut into planar convex patches; plain arrays, one entry per patch.
struct PatchMesh {
  std::vector<std::vector<Eigen::Vector3d>>
      polygon;  ///< counter-clockwise seen from the room, no collinear vertices
  std::vector<Eigen::Vector3d> centre;  ///< centroid of the area
  std::vector<Eigen::Vector3d> normal;  ///< unit, into the room
  std::vector<double> area_m2;
  std::vector<int> surface;  ///< into Room::surfaces; patches of a surface are contiguous
  std::vector<int> plane;    ///< patches with equal numbers lie in one plane and face the same way

  [[nodiscard]] int size() const { return static_cast<int>(area_m2.size()); }
};

/// Where patches are narrower than elsewhere.
enum class Cells {
  at_edges,  ///< half as wide along the edges of floor, ceiling and walls: for constant light
  /// 0.3 as wide along the edges of all faces and around furniture that touches one; cut along the
  /// outline of furniture that is nearer than patch_m, and inside of it: for linear light
  crowded
};

/// Cuts every surface into convex patches with no edge longer than `patch_m`, narrower ones where
/// `cells` says, that follow openings, panels and contact lines of furniture; faces that
/// touch (nearer than 1e-9 m) are removed on both sides. Grids lie along the face's longest edge.
/// @param room  its furniture lies inside and does not overlap, as scenes::read_room ensures
/// @throws std::invalid_argument  if patch_m is not positive or a face is not a simple polygon
/// @throws std::length_error  if patch_m asks for more than 20 million patches
[[nodiscard]] PatchMesh mesh_room(const Room& room, double patch_m, Cells cells = Cells::at_edges);

}  // namespace scenes
