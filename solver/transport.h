#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenes/patch_mesh.h"
#include "scenes/room.h"
#include "solver/eye.h"
#include "solver/gather.h"
#include "solver/radiosity.h"

namespace solver {

/// How many threads the solver uses from now on; results do not depend on it.
/// @throws std::invalid_argument  unless threads >= 1
void set_threads(int threads);

/// What a scene does not need and is therefore left out, and why.
struct Omission {
  std::string what, why;
  double saved_seconds = 0;  ///< of one core, rough
};

/// Patches that are too many for exchange areas of their own: their light is gathered from coarser
/// ones that are solved (fine_light.h).
struct FinePlan {
  double patch_m = 0;        ///< 0: there are none, the solved patches are those asked for
  std::int64_t patches = 0;  ///< estimated from areas
};

/// Above this number of patches coarser ones are solved.
inline constexpr int kMostSolvedPatches = 30000;

/// Made before anything is computed; what it leaves out changes no result beyond rounding, unless
/// there are fine patches.
struct Plan {
  int patches = 0;     ///< that are solved
  double patch_m = 0;  ///< their longest edge
  FinePlan fine;
  std::int64_t pairs = 0;             ///< of patches that face each other
  std::int64_t occludable_pairs = 0;  ///< of those, pairs that something might stand between
  int bands = 0;                      ///< that carry light
  int solved_bands = 0;  ///< of those, the ones whose solution is not another's times a number
  std::int64_t memory_bytes = 0;  ///< peak, estimated
  double expected_seconds = 0;    ///< of one core, rough
  std::vector<Omission> left_out;
};

/// The memory that this process may still take, bytes.
[[nodiscard]] std::int64_t available_memory_bytes();

/// A job cannot fit: exit code 3, with the size and the patch size that would fit.
class TooLarge : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct TransportOptions {
  double patch_m = 0;                   ///< 0: the room's own
  std::vector<ViewedPoint> views;       ///< empty: the viewed point of each painted group
  int rays = 64;                        ///< for a pair of patches, if the first 16 disagree
  int lamp_rays = 256;                  ///< for a pair with a lamp
  std::int64_t memory_limit_bytes = 0;  ///< 0: what the machine has free
  bool skip = true;                     ///< leave out what the scene does not need
  /// False: of viewed points the irradiance alone, not what else the eye takes in.
  bool eye = true;
};

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

/// A point of a surface that somebody looks at.
struct ViewedWall {
  ViewedPoint at;
  ReceiverRow row;  ///< its irradiance
  ViewRows view;    ///< what else the eye takes in
};

/// The plan of prepare_transport. Pairs are counted exactly up to some thousand patches, beyond
/// that from a sample of rows.
/// @throws TooLarge
[[nodiscard]] Plan make_plan(const scenes::Room& room, const TransportOptions& options = {});

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

/// @throws TooLarge
[[nodiscard]] RoomTransport prepare_transport(const scenes::Room& room,
                                              const TransportOptions& options = {});

}  // namespace solver
