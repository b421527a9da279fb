#pragma once
#include <string>
#include <vector>

#include "apps/outcome.h"
#include "apps/room_options.h"

namespace apps {

/// What all subcommands share.
struct Session {
  std::vector<std::string> command_line;
  bool json = false;  ///< data on stdout as JSON
};

struct RoomCommand {
  std::string room, out;
  RoomOptions options;
};

struct RankCommand {
  std::string rooms, out;  ///< one room file; for batch a folder or a list of them
  RankOptions options;
};

struct FileCommand {
  std::string in, out;
  bool inverse = false;  ///< appearance only
};

Exit check_room(const RoomCommand& command, const Session& session);
Exit solve_room(const RoomCommand& command, const Session& session);
Exit shift_room(const RoomCommand& command, const Session& session);
Exit rank_room(const RankCommand& command, const Session& session);
Exit invert_room(const RankCommand& command, const Session& session);
Exit batch_rooms(const RankCommand& command, const Session& session);
Exit convert_table(const FileCommand& command, const Session& session);
Exit solve_cube(const FileCommand& command, const Session& session);
Exit solve_brick(const FileCommand& command, const Session& session);

}  // namespace apps
