#include "solver/rooms/room_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "appearance/spectra/text/input_error.h"
#include "solver/rooms/lamp_white.h"

namespace solver {
namespace {

using Eigen::ArrayXd;
using spectra::Spectrum;

/// The reflectance of every surface, with the paints on those that take them.
std::vector<Spectrum> surface_reflectances(const scenes::Room& room,
                                           const std::vector<Spectrum>& paints) {
  std::vector<Spectrum> reflectances;
  for (int s = 0; s < static_cast<int>(room.surfaces.size()); ++s) {
    const int group = paints.empty() ? -1 : scenes::paint_group(room, s);
    reflectances.push_back(group >= 0 ? paints[static_cast<std::size_t>(group)]
                                      : room.surfaces[static_cast<std::size_t>(s)].reflectance);
  }
  return reflectances;
}

/// Irradiance of the near-white surfaces in view, those near the axis counting more
/// [Neumann2004] 3.6.
ArrayXd white_of_surfaces(const scenes::Room& room, const RoomTransport& t,
                          const RoomSolution& solution, const ViewedWall& wall) {
  Eigen::VectorXd weight = wall.view.near_axis.weights;
  for (Eigen::Index row = 0; row < weight.size(); ++row) {
    const int s = t.mesh.surface[static_cast<std::size_t>(row % t.mesh.size())];
    const Spectrum& reflectance = solution.reflectances[static_cast<std::size_t>(s)];
    if (!(reflectance.values >= kNearWhite).all()) weight[row] = 0;
  }
  const double share = weight.head(t.mesh.size()).sum();
  if (!(share > 0)) {
    throw spectra::InputError(
        {{.file = room.name,
          .pointer = "/view/white",
          .problem = fmt::format("no surface in view reflects {} in every band", kNearWhite),
          .remedy = "take \"white\": \"ideal\""}});
  }
  return (weight.transpose() * solution.radiosity.irradiance.matrix()).transpose().array() / share;
}

}  // namespace

ReceiverLight read_light(const GatherRow& row, const ArrayXd& direct,
                         const RadiositySolution& solution) {
  const Bands& b = solution.radiosity;
  ReceiverLight light;
  light.irradiance = (row.weights.transpose() * b.matrix()).transpose().array() + direct;
  const double strongest = light.irradiance.maxCoeff();
  if (!(strongest > 0)) return light;
  for (const BandReport& band : solution.bands) {
    light.solver_error_bound =
        std::max(light.solver_error_bound, row.norm * band.norm_error_bound / strongest);
  }
  return light;
}

EnergyBalance energy_balance(const ArrayXd& area_m2, const Bands& sources, const Bands& absorbed) {
  const auto flux = [&](const Bands& density) -> ArrayXd {
    return (area_m2.matrix().transpose() * density.topRows(area_m2.size()).matrix())
        .transpose()
        .array();
  };
  EnergyBalance energy{.emitted = flux(sources), .absorbed = flux(absorbed)};
  const double emitted = energy.emitted.sum();
  if (emitted > 0)
    energy.relative_defect = (energy.emitted - energy.absorbed).abs().sum() / emitted;
  return energy;
}

RoomSolution solve_room(const scenes::Room& room, const RoomTransport& transport,
                        const RadiosityOptions& options, const RoomState& state) {
  if (!state.paints.empty() && state.paints.size() != room.paint.size()) {
    throw std::invalid_argument(
        fmt::format("{} paints for {} groups of surfaces", state.paints.size(), room.paint.size()));
  }
  for (const Spectrum& paint : state.paints) {
    if (!(paint.grid == room.grid)) {
      throw std::invalid_argument("the paint is not on the room's grid");
    }
  }
  const std::vector<Spectrum> reflectances = surface_reflectances(room, state.paints);
  Bands reflectance(transport.exchange.rows(), room.grid.count);
  for (int row = 0; row < transport.exchange.rows(); ++row) {
    const int s = transport.mesh.surface[static_cast<std::size_t>(row % transport.mesh.size())];
    reflectance.row(row) = reflectances[static_cast<std::size_t>(s)].values.transpose();
  }
  const Lighting& light = transport.lightings.at(state.lighting);
  RoomSolution solution{.radiosity = solve_radiosity(transport.exchange, light.emission,
                                                     light.direct, reflectance, options)};
  for (const ReceiverRow& row : transport.receivers) {
    solution.receivers.push_back(
        read_light(row.gather, row.direct[state.lighting], solution.radiosity));
  }
  for (const ViewedWall& wall : transport.viewed) {
    solution.viewed.push_back(
        read_light(wall.row.gather, wall.row.direct[state.lighting], solution.radiosity));
  }
  solution.reflectances = reflectances;
  solution.lighting = state.lighting;
  solution.energy = energy_balance(transport.exchange.area_m2.head(transport.mesh.size()),
                                   light.emission + light.direct,
                                   (1 - reflectance) * solution.radiosity.irradiance);
  return solution;
}

spectra::ViewedLight viewed_light(const scenes::Room& room, const RoomTransport& transport,
                                  const RoomSolution& solution, std::size_t viewed) {
  const RadiositySolution& light = solution.radiosity;
  const ViewedWall& wall = transport.viewed.at(viewed);
  const auto on_grid = [&](ArrayXd values) { return Spectrum{room.grid, std::move(values)}; };
  const auto seen = [&](const GatherRow& row, const ArrayXd& sky) {
    return on_grid((row.weights.transpose() * light.radiosity.matrix()).transpose().array() + sky);
  };
  const ArrayXd& irradiance = solution.viewed[viewed].irradiance;
  const ArrayXd& reflectance =
      solution.reflectances[static_cast<std::size_t>(wall.at.surface)].values;
  const auto patch = std::ranges::find(transport.mesh.surface, wall.at.surface);
  const ArrayXd exitance =
      transport.lightings[solution.lighting].emission.row(patch - transport.mesh.surface.begin());
  LampLight lamps = lamp_light(room, transport, viewed, solution.lighting);
  return {.sample = on_grid(exitance + reflectance * irradiance),
          .background = seen(wall.view.background, wall.sky[solution.lighting].background),
          .field = seen(wall.view.field, wall.sky[solution.lighting].field),
          .white = room.viewing.white == spectra::ReferenceWhite::ideal
                       ? on_grid(irradiance)
                       : on_grid(white_of_surfaces(room, transport, solution, wall)),
          .lamps = std::move(lamps.light),
          .lamps_by_flux = lamps.by_flux,
          .angle_deg = painted_angle_deg(room, transport, viewed)};
}

}  // namespace solver
