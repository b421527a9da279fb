#pragma once
#include <string>

#include "apps/run/solution_columns.h"
#include "apps/system/output_files.h"
#include "solver/rooms/room_light.h"

namespace apps {

/// receivers.csv: irradiance per column, W m^-2 nm^-1 (r, g, b: lm m^-2), and illuminance at each
/// receiver.
[[nodiscard]] std::string receivers_csv(const scenes::Room& room, const SolutionColumns& columns,
                                        const solver::RoomSolution& solution);

/// The light of patches that were solved, or gathered from coarser ones.
struct PatchLight {
  const scenes::PatchMesh& mesh;
  const solver::Bands &irradiance, &radiosity;
  const Eigen::ArrayXd* standard_error = nullptr;  ///< of the irradiance, where it was sampled
};

/// patches.csv: irradiance H and radiosity B of each patch, in the same units, some rows at a time.
void write_patches_csv(const scenes::Room& room, const SolutionColumns& columns,
                       const PatchLight& light, const TextSink& sink);

/// [lx]
[[nodiscard]] double illuminance_lx(const SolutionColumns& columns,
                                    const solver::ReceiverLight& light);

}  // namespace apps
