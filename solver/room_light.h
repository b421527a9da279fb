#pragma once
#include <vector>

#include "appearance/spectra/viewed_light.h"
#include "scenes/room.h"
#include "solver/radiosity.h"
#include "solver/transport.h"

namespace solver {

struct EnergyBalance {         ///< W nm^-1 per band
  Eigen::ArrayXd emitted;      ///< sum A (S + D)
  Eigen::ArrayXd absorbed;     ///< sum A (1 - rho) H
  double relative_defect = 0;  ///< |emitted - absorbed| / emitted, summed over bands
};

struct ReceiverLight {
  Eigen::ArrayXd irradiance;  ///< W m^-2 nm^-1
  double solver_error_bound =
      0;  ///< of what the solver left, relative to the strongest band; proven
  double visibility_error =
      0;  ///< standard error of sampled visibility, relative to the strongest band
};

struct RoomSolution {
  RadiositySolution radiosity;
  std::vector<ReceiverLight> receivers;         ///< in the order of Room::receivers
  ReceiverLight viewed;                         ///< at the viewed point
  std::vector<spectra::Spectrum> reflectances;  ///< per surface, as it was solved
  EnergyBalance energy;
};

/// What a receiver gathers from solved radiosities; `direct` comes from point lights and sun.
[[nodiscard]] ReceiverLight read_light(const GatherRow& row, const Eigen::ArrayXd& direct,
                                       const RadiositySolution& solution);

/// @param sources   S + D
/// @param absorbed  H - R H
[[nodiscard]] EnergyBalance energy_balance(const Eigen::ArrayXd& area_m2, const Bands& sources,
                                           const Bands& absorbed);

/// Surfaces in `room.paint->surfaces` take `paint` where it is given.
/// @throws std::invalid_argument  if the paint's grid is not the room's, or it is not a reflectance
[[nodiscard]] RoomSolution solve_room(const scenes::Room& room, const RoomTransport& transport,
                                      const RadiosityOptions& options = {},
                                      const spectra::Spectrum* paint = nullptr);

/// What the eye sees of a solved room, at the viewed point.
/// @throws spectra::InputError  if the white is to be read from near-white surfaces and none is in
/// view
[[nodiscard]] spectra::ViewedLight viewed_light(const scenes::Room& room,
                                                const RoomTransport& transport,
                                                const RoomSolution& solution);

/// Surfaces whose reflectance is at least this in every band count as near-white.
inline constexpr double kNearWhite = 0.6;

}  // namespace solver
