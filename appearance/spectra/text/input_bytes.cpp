#include "appearance/spectra/text/input_bytes.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <system_error>

#include "appearance/spectra/text/input_error.h"

namespace spectra {
namespace {

/// Why a path leads to nothing that can be read to its end; empty if it does.
std::string reason_against(const std::string& path) {
  std::error_code error;
  const auto type = std::filesystem::status(path, error).type();
  using Type = std::filesystem::file_type;
  if (error == std::errc::too_many_symbolic_link_levels) return "its links go round in a circle";
  if (type == Type::not_found) return "there is no such file";
  if (type == Type::directory) return "it is a folder";
  if (type == Type::fifo || type == Type::socket) {
    return "it is a pipe, which may never end; write what it gives to a file first";
  }
  if (type == Type::character || type == Type::block) return "it is a device, not a file";
  return type == Type::regular ? "" : "it is no file that can be opened";
}

}  // namespace

std::string read_input(const std::string& path, std::size_t most_bytes, const std::string& remedy) {
  const std::string reason = reason_against(path);
  if (!reason.empty()) throw FileError(fmt::format("{}: cannot be read: {}", path, reason));
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(fmt::format("{}: cannot be read: it may not be opened", path));
  std::string bytes, block(std::size_t{1} << 16, '\0');
  while (file && bytes.size() <= most_bytes) {
    file.read(block.data(), static_cast<std::streamsize>(block.size()));
    bytes.append(block, 0, static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad()) throw FileError(fmt::format("{}: cannot be read: the disk gives an error", path));
  if (bytes.size() > most_bytes) {
    throw InputError({{.file = path,
                       .problem = fmt::format("the file is larger than {} MiB", most_bytes >> 20U),
                       .remedy = remedy}});
  }
  return bytes;
}

}  // namespace spectra
