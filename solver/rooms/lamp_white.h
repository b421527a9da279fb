#pragma once
#include <cstddef>

#include "scenes/room.h"
#include "solver/rooms/transport.h"

namespace solver {

/// The light that makes the lamps' part of an adopted white.
struct LampLight {
  spectra::Spectrum light;  ///< W m^-2 nm^-1 on the viewed point, or W nm^-1 into the room
  bool by_flux = false;     ///< no lamp, sun or window sees the point: the light into the room
};

/// Of lamps, sun and windows at a viewed point, before any bounce.
[[nodiscard]] LampLight lamp_light(const scenes::Room& room, const RoomTransport& transport,
                                   std::size_t viewed, std::size_t lighting);

/// Of the cone that takes as much of the view, 0 to 90 degrees around its axis, as the surfaces
/// that share the viewed one's paint; 0 if nothing but the point's own light was asked for.
[[nodiscard]] double painted_angle_deg(const scenes::Room& room, const RoomTransport& transport,
                                       std::size_t viewed);

}  // namespace solver
