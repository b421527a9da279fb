#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
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

/// A surface that can hide others: furniture faces always, walls only where the plan is not convex.
/// Triangles of the closed boundary, for ray tests.
struct Occluders {
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;
};

/// Cuts every surface into patches no longer than `patch_m` on an edge. Patch edges follow
/// openings, panels and the contact lines of furniture exactly; faces that touch each other are
/// removed on both sides.
/// @throws std::invalid_argument  if patch_m is not positive
[[nodiscard]] PatchMesh mesh_room(const Room& room, double patch_m);

/// Whole faces (walls, floor, ceiling, furniture), not patches: what rays are tested against.
[[nodiscard]] Occluders occluders(const Room& room);

}  // namespace scenes
