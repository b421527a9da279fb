#pragma once
#include <string>

#include "scenes/room.h"

namespace scenes {

/// Reads and checks a room file (scenes/README.md).
/// @throws spectra::FileError   if it cannot be read
/// @throws spectra::InputError  with every fault of the file
[[nodiscard]] Room read_room(const std::string& path,
                             const spectra::Grid& grid = spectra::kTransportGrid);

}  // namespace scenes
