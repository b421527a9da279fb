#pragma once
#include "apps/run/room_run.h"

namespace apps {

/// rank where several groups are painted: schemes.csv, shift.csv of the best one, run.json.
[[nodiscard]] RunResult rank_schemes(RoomRun& run, const RankOptions& options,
                                     const std::filesystem::path& out);

}  // namespace apps
