#pragma once
#include <string>

#include "scenes/models/building_model.h"

namespace scenes {

/// Reads a Honeybee model (HBJSON): rooms, windows, doors, shades, finishes, sensors.
/// @throws spectra::FileError   if it cannot be read
/// @throws spectra::InputError  with every fault of the file
[[nodiscard]] BuildingModel read_honeybee(const std::string& path);

}  // namespace scenes
