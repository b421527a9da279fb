#pragma once
#include <Eigen/Core>

#include "scenes/mesh/patch_mesh.h"
#include "scenes/room.h"
#include "solver/factors/slope_basis.h"
#include "solver/sensors/gather.h"

namespace solver {

/// What an eye takes in, as solid-angle means of radiosity [Neumann2004] 2.4.
struct ViewRows {
  GatherRow background;  ///< from 1 to 11 degrees off the axis
  GatherRow field;       ///< from 11 to 90 degrees
  GatherRow near_axis;   ///< 0 to 90 degrees, weighted by the cosine with the axis
};

/// By low-discrepancy rays of equal solid angle, kBackgroundRays and kFieldRays of them.
inline constexpr int kBackgroundRays = 4096;
inline constexpr int kFieldRays = 16384;

/// @param bases  of the mesh's patches where light is linear on them; else empty
[[nodiscard]] ViewRows view_rows(const Eigen::Vector3d& eye_m, const Eigen::Vector3d& look_at_m,
                                 const scenes::PatchMesh& mesh,
                                 const std::vector<SlopeBasis>& bases = {});

/// The point that is looked at, from where, and the surface it lies on.
struct ViewedPoint {
  Eigen::Vector3d eye_m, point_m, normal;
  int surface = 0;
};

/// Of one group of painted surfaces: with a view (of the group, or of the room for the first),
/// where the ray from the eye meets the room. Else the free centre of the longest painted wall (if
/// no wall is painted, of the largest painted surface; if nothing is, of the longest wall), from 2
/// m away on its normal or half the room. Whatever the mesh of the solve.
/// @throws std::invalid_argument  if no such point is free
[[nodiscard]] ViewedPoint viewed_point(const scenes::Room& room, std::size_t group = 0);

}  // namespace solver
