#pragma once
#include <string>

#include "solver/room_light.h"

namespace apps {

/// receivers.csv: spectral irradiance, W m^-2 nm^-1, and illuminance at each receiver.
[[nodiscard]] std::string receivers_csv(const scenes::Room& room,
                                        const solver::RoomSolution& solution);

/// patches.csv: irradiance H and radiosity B of each patch, W m^-2 nm^-1.
[[nodiscard]] std::string patches_csv(const scenes::Room& room, const scenes::PatchMesh& mesh,
                                      const solver::RadiositySolution& radiosity);

/// [lx]
[[nodiscard]] double illuminance_lx(const scenes::Room& room, const solver::ReceiverLight& light);

}  // namespace apps
