#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/run/room_options.h"
#include "apps/system/output_files.h"
#include "solver/response/room_response.h"

namespace apps {

/// SHA-256 of everything that a room response depends on: geometry, lights, scenarios, views, the
/// reflectances that are not painted, mesh and program version; but no atlas, target or paint.
[[nodiscard]] std::string response_key(const scenes::Room& room, const RoomOptions& options);

/// The response of a room, then the same on patches twice and four times as long, where these cut
/// it another way.
using ResponseOnMeshes = std::vector<solver::ReducedViews>;

/// A JSON file that a later run may read instead of solving.
[[nodiscard]] OutputFile response_file(const std::filesystem::path& path, const std::string& key,
                                       const ResponseOnMeshes& meshes);

/// @throws spectra::FileError  if there is a file that is no room response: it is somebody else's
void require_free_for_response(const std::filesystem::path& path);

/// Nothing if there is no such file, it belongs to another key, or it is damaged.
[[nodiscard]] std::optional<ResponseOnMeshes> load_response(const std::filesystem::path& path,
                                                            const std::string& key);

}  // namespace apps
