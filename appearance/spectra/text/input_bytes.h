#pragma once
#include <cstddef>
#include <string>

namespace spectra {

/// All bytes of an input file.
/// @param remedy  what to do if it is larger than `most_bytes`
/// @throws FileError   if it cannot be read, or is no file: a folder, or a pipe or device, which
/// might never end
/// @throws InputError  if it is larger
[[nodiscard]] std::string read_input(const std::string& path, std::size_t most_bytes,
                                     const std::string& remedy);

}  // namespace spectra
