#pragma once
#include <cstdint>

#include "solver/rooms/fine_gather.h"
#include "solver/rooms/room_colour.h"
#include "solver/rooms/room_light.h"

namespace solver {

/// The light on the patches that were asked for, where only coarser ones were solved.
struct FineLight {
  scenes::PatchMesh mesh;
  Bands irradiance;               ///< H of each patch, direct light included
  Bands radiosity;                ///< B = S + R H
  Eigen::ArrayXd standard_error;  ///< of H, relative to the patch's strongest band
  double rms_standard_error = 0, largest_standard_error = 0;  ///< over the patches
  int rays_per_patch = 0;
  std::int64_t lost_rays = 0;
  EnergyBalance energy;  ///< of the fine patches: what coarse patches and rays leave open
};

/// @param transport  with fine_patch_m above 0
/// @throws std::invalid_argument  if there are no finer patches than those solved
[[nodiscard]] FineLight fine_light(const scenes::Room& room, const RoomTransport& transport,
                                   const RoomSolution& solution, const FineOptions& options = {});
[[nodiscard]] FineLight fine_light(const scenes::Room& room, const RoomTransport& transport,
                                   const ColourModel& model, const ColourSolution& solution,
                                   const FineOptions& options = {});

}  // namespace solver
