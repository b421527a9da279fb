#include "scenes/files/room_json.h"

#include <filesystem>

#include "scenes/files/room_reader.h"

namespace scenes {

using spectra::JsonNode;

RoomReader::RoomReader(spectra::JsonFile& file, const spectra::Grid& grid)
    : file_(file),
      curves_(file, grid),
      top_(file.root().object({"$schema",   "roomhue",  "name",   "plan_m",    "wall_names",
                               "height_m",  "ceiling",  "faces",  "patch_m",   "openings",
                               "furniture", "surfaces", "lights", "north_deg", "receivers",
                               "view",      "views",    "paint",  "scenarios", "judge"})) {
  room_.grid = grid;
}

Room RoomReader::read() {
  if (const auto version = top_.need("roomhue")) (void)version->whole_number(1, 1);
  const auto name = top_.find("name");
  room_.name = name ? name->name() : std::filesystem::path(file_.path()).stem().string();
  read_patch_size();
  if (const auto faces = top_.find("faces")) {
    read_faces(*faces);
  } else {
    read_plan();
    read_wall_names();
    read_shell();
  }
  read_north();
  read_openings();
  read_furniture();
  read_lights();
  read_surfaces();
  if (shell_sound_) check_covered();
  read_receivers();
  read_view();
  read_named_views();
  read_paint();
  read_scenarios();
  file_.throw_faults();
  room_.notes.insert(room_.notes.end(), curves_.notes().begin(), curves_.notes().end());
  return std::move(room_);
}

Room read_room(const std::string& path, const spectra::Grid& grid) {
  spectra::JsonFile file = spectra::read_json_file(path);
  return RoomReader(file, grid).read();
}

}  // namespace scenes
