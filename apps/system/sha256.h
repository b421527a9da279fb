#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace apps {

/// SHA-256 of a file's bytes [FIPS180], 64 lower-case hexadecimal digits.
/// @throws spectra::FileError  if it cannot be read
[[nodiscard]] std::string sha256_of_file(const std::filesystem::path& path);

/// The same of a text.
[[nodiscard]] std::string sha256_of(std::string_view text);

}  // namespace apps
