#pragma once
#include <string>
#include <vector>

#include "apps/run/room_options.h"
#include "apps/studies/measured_rooms.h"
#include "apps/system/output_files.h"

namespace apps {

/// What was computed beside what was measured and seen.
struct Measured {
  MeasuredBox box;
  std::vector<SeenDirections> rooms;
};

/// The box by shape, and whether each published direction comes out under each choice.
[[nodiscard]] std::string measured_text(const Measured& measured);
[[nodiscard]] Json describe(const Measured& measured);

/// measured_box.csv and measured_rooms.csv
[[nodiscard]] std::vector<OutputFile> measured_files(const std::filesystem::path& out,
                                                     const Measured& measured);

}  // namespace apps
