#pragma once
#include <string>

#include "scenes/luminaires/luminaire.h"

namespace scenes {

/// Reads a photometric file by the end of its name: .ies or .ldt.
/// @throws spectra::FileError   if it cannot be read
/// @throws spectra::InputError  with every fault of the file, each with line and column
[[nodiscard]] Luminaire read_luminaire(const std::string& path);

}  // namespace scenes
