#include "solver/rooms/daylight_hours.h"

#include <tbb/parallel_for.h>

#include "solver/bounce/radiosity.h"
#include "solver/exchange/exchange.h"
#include "solver/sources/direct_light.h"

namespace solver {
namespace {

using Eigen::Index;

scenes::Room without_light(scenes::Room room) {
  for (scenes::Surface& s : room.surfaces) s.exitance.values.setZero();
  room.point_lights.clear();
  room.suns.clear();
  room.skies.clear();
  room.luminaires.clear();
  return room;
}

/// Per row of the exchange.
Bands reflectances(const scenes::Room& room, const RoomTransport& transport) {
  Bands all(transport.exchange.rows(), room.grid.count);
  for (Index row = 0; row < all.rows(); ++row) {
    const auto patch = static_cast<std::size_t>(row % transport.mesh.size());
    const auto surface = static_cast<std::size_t>(transport.mesh.surface[patch]);
    all.row(row) = room.surfaces[surface].reflectance.values.transpose();
  }
  return all;
}

}  // namespace

DaylightHours::DaylightHours(const scenes::Room& room, const RoomTransport& transport,
                             const RadiosityOptions& options)
    : dark_(without_light(room)),
      transport_(transport),
      visibility_(room, transport.mesh),
      facets_(facets_of(transport.mesh)) {
  if (transport.exchange.modes > 1) bases_ = slope_bases(facets_);
  const Bands reflectance = reflectances(room, transport);
  const Reflector reflector(reflectance);
  const Eigen::ArrayXd& area_m2 = transport.exchange.area_m2;
  const Bands none = Bands::Zero(reflectance.rows(), reflectance.cols());
  for (const ReceiverRow& row : transport.receivers) {
    const Bands v = (row.gather.weights.array() / area_m2).replicate(1, reflectance.cols());
    const RadiositySolution solution =
        solve_radiosity(transport.exchange, reflectance * v, none, reflector, options);
    converged_ = converged_ && solution.converged;
    response_.push_back(reflectance * ((v + solution.irradiance).colwise() * area_m2));
  }
}

std::vector<HourOfLight> DaylightHours::of(const scenes::WeatherSky& over, std::size_t first,
                                           std::size_t end) const {
  std::vector<HourOfLight> hours(end - first);
  tbb::parallel_for(first, end, [&](std::size_t hour) {
    const scenes::SkyOfHour sky = scenes::sky_of_hour(dark_.grid, over, hour);
    hours[hour - first] = {.hour = hour,
                           .azimuth_deg = sky.azimuth_deg,
                           .altitude_deg = sky.altitude_deg,
                           .defined = sky.defined,
                           .daylight = sky.sky.has_value(),
                           .irradiance = at(sky, over.sun >= 0)};
  });
  return hours;
}

Bands DaylightHours::at(const scenes::SkyOfHour& hour, bool with_sun) const {
  Bands irradiance = Bands::Zero(static_cast<Index>(response_.size()), dark_.grid.count);
  if (!hour.sky) return irradiance;
  scenes::Room room = dark_;
  room.skies = {*hour.sky};
  if (with_sun) {
    room.suns = {{.name = "sun",
                  .azimuth_deg = hour.azimuth_deg,
                  .altitude_deg = hour.altitude_deg,
                  .normal_irradiance = hour.beam}};
  }
  const DirectSources sources(room, visibility_);
  const Bands direct = sources.on_patches(transport_.mesh, facets_, bases_).irradiance;
  for (std::size_t r = 0; r < response_.size(); ++r) {
    const scenes::Receiver& at = dark_.receivers[r];
    irradiance.row(static_cast<Index>(r)) =
        (response_[r] * direct).colwise().sum() +
        sources.at_point(at.at_m, at.normal.normalized()).transpose();
  }
  return irradiance;
}

}  // namespace solver
