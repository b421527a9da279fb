#pragma once
#include "scenes/shapes/room_builder.h"
#include "solver/rooms/room_light.h"

namespace solver {

/// Rooms of the battery, made in code: the battery reads no files.

/// An empty rectangular room that reflects nothing.
[[nodiscard]] scenes::RoomBuilder black_box(const Eigen::Vector3d& size_m,
                                            const spectra::Grid& grid = {
                                                .first_nm = 550, .step_nm = 10, .count = 1});

struct SolvedRoom {
  RoomTransport transport;
  RoomSolution solution;

  /// Flux that arrives on a surface, per band.
  [[nodiscard]] Eigen::ArrayXd flux_on(int surface) const;
};

[[nodiscard]] SolvedRoom solved(const scenes::Room& room, Light light = Light::linear);

}  // namespace solver
