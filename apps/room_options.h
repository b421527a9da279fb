#pragma once
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "paints/ranking.h"
#include "solver/room_light.h"

namespace apps {

using Json = nlohmann::ordered_json;

/// How a room is solved.
struct RoomOptions {
  double patch_m = 0;  ///< 0: the room's own
  solver::RadiosityOptions radiosity;
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
};

/// Names on the command line and in run.json.
[[nodiscard]] const std::map<std::string, solver::Method>& method_names();
[[nodiscard]] const std::map<std::string, paints::Distance>& distance_names();

[[nodiscard]] Json to_json(const RoomOptions& options);
[[nodiscard]] Json to_json(const RankOptions& options);

}  // namespace apps
