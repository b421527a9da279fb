#pragma once
#include <string>

#include "apps/solution_columns.h"
#include "solver/room_light.h"

namespace apps {

/// receivers.csv: irradiance per column, W m^-2 nm^-1 (r, g, b: lm m^-2), and illuminance at each
/// receiver.
[[nodiscard]] std::string receivers_csv(const scenes::Room& room, const SolutionColumns& columns,
                                        const solver::RoomSolution& solution);

/// patches.csv: irradiance H and radiosity B of each patch, in the same units.
[[nodiscard]] std::string patches_csv(const scenes::Room& room, const SolutionColumns& columns,
                                      const scenes::PatchMesh& mesh,
                                      const solver::RadiositySolution& radiosity);

/// [lx]
[[nodiscard]] double illuminance_lx(const SolutionColumns& columns,
                                    const solver::ReceiverLight& light);

}  // namespace apps
