#pragma once
#include <string>

#include "scenes/room.h"
#include "solver/rooms/room_light.h"

/// Rooms in which numbers get hard, and how they are solved. They go through the room reader, as a
/// file would.
namespace stability {

struct BoxSize {
  double x_m = 5, y_m = 4, z_m = 2.7;
};

/// The members of a room file for an empty box, without braces: everything reflects `reflectance`.
[[nodiscard]] std::string box_members(const BoxSize& size, double patch_m, double reflectance);

/// A panel that emits 1 W m^-2 nm^-1, as the member "lights"; `where` is its value of "panel".
[[nodiscard]] std::string panel_member(const std::string& where);

/// @param members  of the JSON object of a room file, but "roomhue"
[[nodiscard]] scenes::Room room_of(const std::string& members);

/// The four rooms of the iterations table, with a panel on the ceiling.
[[nodiscard]] scenes::Room box();
[[nodiscard]] scenes::Room two_rooms();
[[nodiscard]] scenes::Room corridor();
[[nodiscard]] scenes::Room slab();

/// Everything reflects so, lamps too.
[[nodiscard]] scenes::Room uniform(scenes::Room room, double reflectance);

struct Solved {
  solver::RoomTransport transport;
  solver::RoomSolution solution;

  /// W m^-2 nm^-1 at 400 nm, per patch.
  [[nodiscard]] Eigen::ArrayXd irradiance() const {
    return means(solution.radiosity.irradiance).col(0);
  }

  /// The patches' means of a solution, without the slopes.
  [[nodiscard]] solver::Bands means(const solver::Bands& rows) const {
    return rows.topRows(transport.mesh.size());
  }

  [[nodiscard]] double at_receiver(std::size_t k) const {
    return solution.receivers[k].irradiance[0];
  }
};

[[nodiscard]] Solved solve(const scenes::Room& room, double relative_error = 1e-9,
                           solver::Light light = solver::Light::linear);

/// White furnace: surfaces of many reflectances from 0 to 0.9999 that emit S = 1 - rho give B = H =
/// 1 everywhere. The largest error on patches and at receivers.
[[nodiscard]] double furnace_error(scenes::Room room);

/// Area-mean irradiance of a room that reflects rho everywhere is flux / (A (1 - rho)). Its
/// relative error.
[[nodiscard]] double mean_light_error(const Solved& solved, double reflectance);

}  // namespace stability
