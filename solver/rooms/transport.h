#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenes/mesh/patch_mesh.h"
#include "scenes/room.h"
#include "solver/bounce/radiosity_system.h"
#include "solver/rooms/plan.h"
#include "solver/sensors/eye.h"
#include "solver/sensors/gather.h"

namespace solver {

/// How many threads the solver uses from now on; results do not depend on it.
/// @throws std::invalid_argument  unless threads >= 1
void set_threads(int threads);

/// A point where light is read, and how.
struct ReceiverRow {
  GatherRow gather;
  std::vector<Eigen::ArrayXd> direct;  ///< from point lights and sun, per lighting, W m^-2 nm^-1
};

/// What one lighting brings into the room, patch x band.
struct Lighting {
  std::string name;           ///< of the scenario; empty: all lights as they are
  Bands emission;             ///< S
  Bands direct;               ///< D
  double direct_scaling = 0;  ///< how much the flux of point lights and sun had to be mended
};

/// What an eye takes in of the sky: means as in ViewRows, pi times radiance, W m^-2 nm^-1.
struct SeenSky {
  Eigen::ArrayXd background, field;
};

/// A point of a surface that somebody looks at.
struct ViewedWall {
  ViewedPoint at;
  ReceiverRow row;           ///< its irradiance
  ViewRows view;             ///< what else the eye takes in
  std::vector<SeenSky> sky;  ///< and through openings, per lighting
};

/// Everything about a room that does not depend on reflectances. Built once per geometry and its
/// lightings.
struct RoomTransport {
  scenes::PatchMesh mesh;  ///< that is solved
  ExchangeAreas exchange;
  std::vector<Lighting> lightings;     ///< all lights as they are, then each of Room::scenarios
  std::vector<ReceiverRow> receivers;  ///< in the order of Room::receivers
  std::vector<ViewedWall> viewed;  ///< as asked for; by default one per group of painted surfaces
  Plan plan;
  std::map<std::string, double> seconds;                                   ///< per stage
  double closure_defect = 0, reciprocity_defect = 0, largest_scaling = 0;  ///< of `exchange`
};

/// The plan of prepare_transport. Pairs are counted exactly up to some thousand patches, beyond
/// that from a sample of rows.
/// @throws TooLarge
[[nodiscard]] Plan make_plan(const scenes::Room& room, const TransportOptions& options = {});

/// @throws TooLarge
[[nodiscard]] RoomTransport prepare_transport(const scenes::Room& room,
                                              const TransportOptions& options = {});

}  // namespace solver
