#include "solver/rooms/lamp_white.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "appearance/spectra/photometry.h"

namespace solver {

LampLight lamp_light(const scenes::Room& room, const RoomTransport& transport, std::size_t viewed,
                     std::size_t lighting) {
  const ReceiverRow& row = transport.viewed.at(viewed).row;
  const Lighting& lit = transport.lightings.at(lighting);
  const Eigen::VectorXd direct = lit.emission.matrix().transpose() * row.gather.weights;
  LampLight lamps{.light = {room.grid, direct.array() + row.direct[lighting]}};
  if (spectra::luminous(lamps.light) > 0) return lamps;
  const int patches = transport.mesh.size();
  const Eigen::VectorXd flux = (lit.emission + lit.direct).topRows(patches).matrix().transpose() *
                               transport.exchange.area_m2.head(patches).matrix();
  return {.light = {room.grid, flux.array()}, .by_flux = true};
}

double painted_angle_deg(const scenes::Room& room, const RoomTransport& transport,
                         std::size_t viewed) {
  constexpr double kDegree = std::numbers::pi / 180;
  const ViewedWall& wall = transport.viewed.at(viewed);
  const Eigen::VectorXd& ring = wall.view.background.weights;
  const Eigen::VectorXd& field = wall.view.field.weights;
  if (ring.size() == 0) return 0;
  const int group = scenes::paint_group(room, wall.at.surface);
  double of_ring = 0, of_field = 0;
  for (int p = 0; p < transport.mesh.size(); ++p) {
    const int s = transport.mesh.surface[static_cast<std::size_t>(p)];
    if (s != wall.at.surface && (group < 0 || scenes::paint_group(room, s) != group)) continue;
    of_ring += ring[p];
    of_field += field[p];
  }
  const double cos_1 = std::cos(kDegree), cos_11 = std::cos(11 * kDegree);
  // Solid angles over 2 pi; the innermost degree is the viewed point's own.
  const double share = (1 - cos_1) + (cos_1 - cos_11) * of_ring + cos_11 * of_field;
  return 2 * std::acos(std::clamp(1 - share, 0.0, 1.0)) / kDegree;
}

}  // namespace solver
