#pragma once
#include <optional>
#include <vector>

#include "appearance/spectra/viewed_light.h"
#include "scenes/room.h"
#include "solver/bounce/radiosity.h"
#include "solver/rooms/transport.h"

namespace solver {

struct EnergyBalance {         ///< W nm^-1 per band
  Eigen::ArrayXd emitted;      ///< sum A (S + D)
  Eigen::ArrayXd absorbed;     ///< sum A (1 - rho) H
  double relative_defect = 0;  ///< |emitted - absorbed| / emitted, summed over bands
};

struct ReceiverLight {
  Eigen::ArrayXd irradiance;         ///< W m^-2 nm^-1
  std::optional<double> mesh_error;  ///< estimated, relative to the strongest band; mesh_study.h
  double solver_error_bound =
      0;  ///< of what the solver left, relative to the strongest band; proven
};

struct RoomSolution {
  RadiositySolution radiosity;
  std::vector<ReceiverLight> receivers;         ///< in the order of Room::receivers
  std::vector<ReceiverLight> viewed;            ///< in the order of RoomTransport::viewed
  std::vector<spectra::Spectrum> reflectances;  ///< per surface, as it was solved
  std::size_t lighting = 0;                     ///< it was solved with
  EnergyBalance energy;
};

/// What a receiver gathers from solved radiosities; `direct` comes from point lights and sun.
[[nodiscard]] ReceiverLight read_light(const GatherRow& row, const Eigen::ArrayXd& direct,
                                       const RadiositySolution& solution);

/// @param area_m2   per patch; of the light, only the patches' means count
/// @param sources   S + D
/// @param absorbed  H - R H
[[nodiscard]] EnergyBalance energy_balance(const Eigen::ArrayXd& area_m2, const Bands& sources,
                                           const Bands& absorbed);

/// Which light and which paints a room is solved with.
struct RoomState {
  std::size_t lighting = 0;               ///< into RoomTransport::lightings
  std::vector<spectra::Spectrum> paints;  ///< of each of Room::paint; empty: the room's own
};

/// @throws std::invalid_argument  if a paint's grid is not the room's, it is not a reflectance, or
/// their number is not that of the groups
[[nodiscard]] RoomSolution solve_room(const scenes::Room& room, const RoomTransport& transport,
                                      const RadiosityOptions& options = {},
                                      const RoomState& state = {});

/// What the eye sees of a solved room, at one of its viewed points.
/// @throws spectra::InputError  if the white is to be read from near-white surfaces and none is in
/// view
[[nodiscard]] spectra::ViewedLight viewed_light(const scenes::Room& room,
                                                const RoomTransport& transport,
                                                const RoomSolution& solution,
                                                std::size_t viewed = 0);

/// Surfaces whose reflectance is at least this in every band count as near-white.
inline constexpr double kNearWhite = 0.6;

}  // namespace solver
