#pragma once
#include <cstdint>
#include <string>

#include "scenes/mesh/patch_mesh.h"
#include "scenes/room.h"
#include "solver/rooms/plan.h"

namespace solver {

/// Which patches are solved, and which only get their light from them.
struct MeshChoice {
  scenes::PatchMesh solved;
  double patch_m = 0;  ///< of the solved patches
  FinePlan fine;
  std::string reason;             ///< for coarse patches, where there are any
  std::int64_t memory_bytes = 0;  ///< peak, estimated
};

/// Meshes the room as asked for; where that gives more than kMostSolvedPatches or more than memory
/// holds, coarsely enough for some thousand patches.
/// @throws TooLarge
[[nodiscard]] MeshChoice choose_mesh(const scenes::Room& room, const TransportOptions& options);

}  // namespace solver
