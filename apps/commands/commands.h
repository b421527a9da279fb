#pragma once
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "appearance/display.h"
#include "apps/run/room_options.h"
#include "apps/run/session.h"
#include "apps/system/outcome.h"
#include "solver/rooms/room_colour.h"

namespace apps {

struct RoomCommand {
  std::string room, out;
  RoomOptions options;
};

struct ConvergenceCommand {
  std::string room, out;
  ConvergenceOptions options;
};

struct SolveCommand {
  std::string room, out;
  SolveOptions options;
  std::optional<solver::ColourModel> colour;  ///< none: spectra
};

struct RankCommand {
  std::string rooms, out;  ///< one room file; for batch a folder or a list of them
  RankOptions options;
};

struct MixCommand {
  std::string room, out;
  MixOptions options;
};

struct FileCommand {
  std::string in, out;
  bool inverse = false;  ///< appearance only
};

struct DaylightCommand {
  std::string room, out;
  RoomOptions options;
  std::optional<std::pair<int, int>> hours;  ///< first and last, from 1; none: the whole file
};

struct LampsCommand {
  std::string in;    ///< a file of spectra; empty: the measured lamps
  std::string kind;  ///< empty: all
  std::optional<double> cct_K, ra, r9;
  int top = 0;  ///< 0: all
};

struct SkyCommand {
  std::string weather;  ///< an .epw file
  int hour = 1;         ///< of it, from 1
};

using Colour = std::array<double, 3>;  ///< red, green, blue

struct ImportCommand {
  std::string in, out;
  std::vector<std::string> rooms;  ///< identifiers or names; none: the only one
  double sky_lx = 5000;            ///< on windows from outside
};

struct RelightCommand {
  std::string in, out;
  Colour from{}, to{};
  std::string set = "granier-iso";
  bool classical = false;
};

struct ShaderCommand {
  std::string set = "granier-iso";
  std::optional<Colour> alpha;
};

struct PictureCommand {
  std::string room, out;
  RoomOptions options;
  int width = 1280, height = 960;
  double fov_deg = 0;               ///< horizontal; 0: the view's, else 60
  std::string view;                 ///< name in the room's views; empty: its view
  std::vector<std::string> paints;  ///< GROUP=PAINT
  bool best = false;                ///< with the best paints of each group's atlas
  int contact_sheet = 0;            ///< of so many of the best; 0: none
  bool draft = false;
  double headroom = appearance::Display::kHeadroom;
  int bits = 8;       ///< of a PNG's sample
  bool half = false;  ///< numbers of the spectral picture
};

struct VerifyCommand {
  std::string out;       ///< folder; empty: nothing is written
  std::string measured;  ///< folder of the measured rooms to compare with; empty: closed forms
};

Exit check_room(const RoomCommand& command, const Session& session);
Exit solve_room(const SolveCommand& command, const Session& session);
Exit shift_room(const RoomCommand& command, const Session& session);
Exit compare_room(const RoomCommand& command, const Session& session);
Exit measure_room(const ConvergenceCommand& command, const Session& session);
Exit rank_room(const RankCommand& command, const Session& session);
Exit map_atlas(const RankCommand& command, const Session& session);
Exit mix_room(const MixCommand& command, const Session& session);
Exit invert_room(const RankCommand& command, const Session& session);
Exit batch_rooms(const RankCommand& command, const Session& session);
Exit convert_table(const FileCommand& command, const Session& session);
Exit list_paints(const FileCommand& command, const Session& session);
Exit tell_lamps(const LampsCommand& command, const Session& session);
Exit describe_lamp(const FileCommand& command, const Session& session);
Exit daylight_hours(const DaylightCommand& command, const Session& session);
Exit describe_sky(const SkyCommand& command, const Session& session);
Exit import_model(const ImportCommand& command, const Session& session);
Exit solve_cube(const FileCommand& command, const Session& session);
Exit solve_brick(const FileCommand& command, const Session& session);
Exit relight_picture(const RelightCommand& command, const Session& session);
Exit take_pictures(const PictureCommand& command, const Session& session);
Exit print_shader(const ShaderCommand& command, const Session& session);
Exit verify_engine(const VerifyCommand& command, const Session& session);
Exit compare_measured(const VerifyCommand& command, const Session& session);

}  // namespace apps
