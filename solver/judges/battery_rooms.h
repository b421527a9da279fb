#pragma once
#include "scenes/room.h"
#include "solver/rooms/room_light.h"

namespace solver {

/// Rooms of the battery, made in code: the battery reads no files.

/// The surfaces that the plan, openings, panels and furniture of a room make, in the order of
/// Room::surfaces; dark, with one reflectance for all.
void add_surfaces(scenes::Room& room, double reflectance);

/// An empty rectangular room that reflects nothing, one band; patches of `patch_m`.
[[nodiscard]] scenes::Room black_box(const Eigen::Vector3d& size_m, double patch_m);

/// Adds a square lamp in the middle of the ceiling, before add_surfaces.
void add_ceiling_panel(scenes::Room& room, double edge_m);

struct SolvedRoom {
  RoomTransport transport;
  RoomSolution solution;

  /// Flux that arrives on a surface, per band.
  [[nodiscard]] Eigen::ArrayXd flux_on(int surface) const;
};

[[nodiscard]] SolvedRoom solved(const scenes::Room& room, Light light = Light::linear);

}  // namespace solver
