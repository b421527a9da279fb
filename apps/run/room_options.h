#pragma once
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "paints/mixing.h"
#include "paints/ranking.h"
#include "solver/rooms/room_light.h"

namespace apps {

using Json = nlohmann::ordered_json;

/// How a room is solved.
struct RoomOptions {
  double patch_m = 0;  ///< 0: the room's own
  solver::Light light = solver::Light::linear;
  solver::RadiosityOptions radiosity;
};

/// How the light in a room is solved.
struct SolveOptions {
  RoomOptions room;
  double tolerance = 0;     ///< of every receiver and viewed point, relative; 0: mesh as given
  bool richardson = false;  ///< extrapolate points to patches of no size
};

/// How error is measured against run time.
struct ConvergenceOptions {
  double patch_m = 0;  ///< of the baseline; 0: the room's own
  solver::Light light = solver::Light::linear;
  double seconds = 120;  ///< after which nothing more is started; the reference may take half of
                         ///< them, by its plan
};

/// How the paints of an atlas are ranked in a room.
struct RankOptions {
  RoomOptions room;
  std::string atlas;     ///< name or file; empty: the room's own
  int top = 0;           ///< 0: the room's own
  int resolve_top = 10;  ///< of the best, as many are checked by full solves
  std::string response;  ///< file of the room response; empty: response.json beside the results
  paints::Windows windows;
  paints::Distance distance = paints::Distance::jab;
  bool robust = false;  ///< order by the largest distance over the choices of the model
};

/// How the paints of an atlas are mixed for a room; of `rank`, windows and distance have no
/// meaning.
struct MixOptions {
  RankOptions rank;
  int bases = 3;    ///< at most so many in a recipe
  double step = 0;  ///< that can be weighed, in parts of 100; 0: any parts
  paints::Saunderson surface;
};

/// Names on the command line and in run.json.
[[nodiscard]] const std::map<std::string, solver::Light>& light_names();
[[nodiscard]] const std::map<std::string, solver::Method>& method_names();
[[nodiscard]] const std::map<std::string, paints::Distance>& distance_names();

[[nodiscard]] Json to_json(const RoomOptions& options);
[[nodiscard]] Json to_json(const SolveOptions& options);
[[nodiscard]] Json to_json(const RankOptions& options);
[[nodiscard]] Json to_json(const MixOptions& options);

}  // namespace apps
