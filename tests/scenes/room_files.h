#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "appearance/spectra/text/input_error.h"
#include "scenes/files/room_json.h"

namespace scenes {

using nlohmann::json;

/// A small room with one of everything; tests change it.
inline json sample_room() {
  return json::parse(R"({
    "roomhue": 1,
    "plan_m": [[0, 0], [5, 0], [5, 4], [0, 4]],
    "wall_names": ["south", "east", "north", "west"],
    "height_m": 2.7,
    "patch_m": 0.5,
    "openings": [
      { "name": "window", "wall": "south", "offset_m": 1.5, "sill_m": 0.9, "width_m": 2.0,
        "height_m": 1.4 }
    ],
    "furniture": [ { "name": "desk", "box_m": { "min": [1, 1, 0], "max": [2, 2, 0.75] } } ],
    "surfaces": { "floor": 0.25, "ceiling": 0.85, "walls": 0.5, "north": 0.6, "desk": 0.4 },
    "lights": [
      { "name": "panel", "panel": { "on": "ceiling", "center_m": [2.5, 2], "size_m": [1.2, 0.6] },
        "spectrum": { "illuminant": "A" }, "flux_lm": 4000 },
      { "name": "sky", "opening": "window", "spectrum": { "illuminant": "D65" },
        "illuminance_lx": 3000 }
    ],
    "receivers": [ { "name": "middle", "at_m": [2.5, 4, 1.35], "normal": [0, -2, 0] } ],
    "view": { "eye_m": [2.5, 0.6, 1.2], "look_at_m": [2.5, 4, 1.35] },
    "paint": { "surfaces": ["walls"], "atlas": "munsell-nickerson",
               "target": { "paint": "munsell-nickerson:231" }, "top": 7 }
  })");
}

/// A folder of this process alone: tests run side by side.
inline const std::string& own_folder() {
  static const std::string kFolder = [] {
    std::string path = testing::TempDir() + "roomhue-XXXXXX";
    if (::mkdtemp(path.data()) == nullptr) throw std::runtime_error("no temporary folder");
    return path + "/";
  }();
  return kFolder;
}

inline std::string write_file(const std::string& name, const std::string& text) {
  const std::string path = own_folder() + name;
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

/// The faults that reading throws; none if it throws nothing.
inline std::vector<spectra::Fault> faults_of(const std::function<void()>& reading) {
  try {
    reading();
  } catch (const spectra::InputError& error) {
    return error.faults();
  }
  return {};
}

inline Room read(const json& room) { return read_room(write_file("room.json", room.dump(1))); }

inline const Surface& surface(const Room& room, const std::string& name) {
  return room.surfaces.at(static_cast<std::size_t>(find_surface(room, name)));
}

}  // namespace scenes
