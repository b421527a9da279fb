#include "solver/room_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "appearance/spectra/input_error.h"

namespace solver {
namespace {

using Eigen::ArrayXd;
using spectra::Spectrum;

bool takes_paint(const scenes::Room& room, int surface) {
  return room.paint &&
         std::ranges::find(room.paint->surfaces, surface) != room.paint->surfaces.end();
}

/// The reflectance of every surface, with the paint on those that take it.
std::vector<Spectrum> surface_reflectances(const scenes::Room& room, const Spectrum* paint) {
  std::vector<Spectrum> reflectances;
  for (int s = 0; s < static_cast<int>(room.surfaces.size()); ++s) {
    const bool painted = paint != nullptr && takes_paint(room, s);
    reflectances.push_back(painted ? *paint
                                   : room.surfaces[static_cast<std::size_t>(s)].reflectance);
  }
  return reflectances;
}

/// Irradiance of the near-white surfaces in view, those near the axis counting more
/// [Neumann2004] 3.6.
ArrayXd white_of_surfaces(const scenes::Room& room, const RoomTransport& t,
                          const RoomSolution& solution) {
  Eigen::VectorXd weight = t.view.near_axis.weights;
  for (int p = 0; p < t.mesh.size(); ++p) {
    const int s = t.mesh.surface[static_cast<std::size_t>(p)];
    const Spectrum& reflectance = solution.reflectances[static_cast<std::size_t>(s)];
    if (!(reflectance.values >= kNearWhite).all()) weight[p] = 0;
  }
  if (!(weight.sum() > 0)) {
    throw spectra::InputError(
        {{.file = room.name,
          .pointer = "/view/white",
          .problem = fmt::format("no surface in view reflects {} in every band", kNearWhite),
          .remedy = "take \"white\": \"ideal\""}});
  }
  return (weight.transpose() * solution.radiosity.irradiance.matrix()).transpose().array() /
         weight.sum();
}

}  // namespace

ReceiverLight read_light(const GatherRow& row, const ArrayXd& direct,
                         const RadiositySolution& solution) {
  const Bands& b = solution.radiosity;
  ReceiverLight light;
  light.irradiance = (row.weights.transpose() * b.matrix()).transpose().array() + direct;
  const double strongest = light.irradiance.maxCoeff();
  if (!(strongest > 0)) return light;
  const ArrayXd sampled =
      (row.standard_error.array().square().matrix().transpose() * b.square().matrix())
          .transpose()
          .array()
          .sqrt();
  light.visibility_error = sampled.maxCoeff() / strongest;
  for (const BandReport& band : solution.bands) {
    light.solver_error_bound =
        std::max(light.solver_error_bound, row.norm * band.norm_error_bound / strongest);
  }
  return light;
}

EnergyBalance energy_balance(const ArrayXd& area_m2, const Bands& sources, const Bands& absorbed) {
  const auto flux = [&](const Bands& density) -> ArrayXd {
    return (area_m2.matrix().transpose() * density.matrix()).transpose().array();
  };
  EnergyBalance energy{.emitted = flux(sources), .absorbed = flux(absorbed)};
  const double emitted = energy.emitted.sum();
  if (emitted > 0)
    energy.relative_defect = (energy.emitted - energy.absorbed).abs().sum() / emitted;
  return energy;
}

RoomSolution solve_room(const scenes::Room& room, const RoomTransport& transport,
                        const RadiosityOptions& options, const Spectrum* paint) {
  if (paint != nullptr && !(paint->grid == room.grid)) {
    throw std::invalid_argument("the paint is not on the room's grid");
  }
  const std::vector<Spectrum> reflectances = surface_reflectances(room, paint);
  Bands reflectance(transport.mesh.size(), room.grid.count);
  for (int p = 0; p < transport.mesh.size(); ++p) {
    const int s = transport.mesh.surface[static_cast<std::size_t>(p)];
    reflectance.row(p) = reflectances[static_cast<std::size_t>(s)].values.transpose();
  }
  RoomSolution solution{.radiosity = solve_radiosity(transport.exchange, transport.emission,
                                                     transport.direct, reflectance, options)};
  for (const ReceiverRow& row : transport.receivers) {
    solution.receivers.push_back(read_light(row.gather, row.direct, solution.radiosity));
  }
  solution.viewed =
      read_light(transport.viewed_row.gather, transport.viewed_row.direct, solution.radiosity);
  solution.reflectances = reflectances;
  solution.energy =
      energy_balance(transport.exchange.area_m2, transport.emission + transport.direct,
                     (1 - reflectance) * solution.radiosity.irradiance);
  return solution;
}

spectra::ViewedLight viewed_light(const scenes::Room& room, const RoomTransport& transport,
                                  const RoomSolution& solution) {
  const RadiositySolution& light = solution.radiosity;
  const auto on_grid = [&](ArrayXd values) { return Spectrum{room.grid, std::move(values)}; };
  const auto seen = [&](const GatherRow& row) {
    return on_grid((row.weights.transpose() * light.radiosity.matrix()).transpose().array());
  };
  const ArrayXd& irradiance = solution.viewed.irradiance;
  const auto viewed = static_cast<std::size_t>(transport.viewed.surface);
  const scenes::Surface& surface = room.surfaces[viewed];
  const Spectrum& reflectance = solution.reflectances[viewed];
  return {.sample = on_grid(surface.exitance.values + reflectance.values * irradiance),
          .background = seen(transport.view.background),
          .field = seen(transport.view.field),
          .white = room.viewing.white == spectra::ReferenceWhite::ideal
                       ? on_grid(irradiance)
                       : on_grid(white_of_surfaces(room, transport, solution))};
}

}  // namespace solver
