#pragma once
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "appearance/viewing_conditions.h"
#include "apps/run/room_options.h"
#include "apps/run/session.h"
#include "apps/run/solution_columns.h"
#include "apps/system/output_files.h"
#include "solver/rooms/fine_light.h"
#include "solver/rooms/room_light.h"

namespace apps {

/// SHA-256 of a file that has been read without fault, of the files that it names (keys "file" and
/// "atlas") and of an atlas given as a file; each once.
/// @throws spectra::FileError  if one cannot be read
[[nodiscard]] Json hash_inputs(const std::filesystem::path& path, const std::string& atlas);

/// What identifies a run: a folder whose run.json starts with the same members is up to date.
[[nodiscard]] Json run_identity(const std::string& subcommand, const std::filesystem::path& input,
                                const Json& options);

/// The members that every run.json has; `seconds` and the rest follow.
[[nodiscard]] Json begin_record(const Json& identity, const Session& session);

[[nodiscard]] Json describe(const spectra::Grid& grid);
[[nodiscard]] Json describe(const scenes::Room& room);
[[nodiscard]] Json describe(const solver::Plan& plan);
[[nodiscard]] Json describe(const solver::RoomTransport& transport);
[[nodiscard]] Json describe(const solver::RoomSolution& solution, const scenes::Room& room);
[[nodiscard]] Json describe(const solver::RoomSolution& solution, const scenes::Room& room,
                            const SolutionColumns& columns);
/// Noise and energy of the patches that were too many to be solved.
[[nodiscard]] Json describe(const solver::FineLight& fine, const SolutionColumns& columns);
/// What the three numbers were, what is approximate, and what of them is negative.
[[nodiscard]] Json describe(const solver::ColourModel& model,
                            const solver::ColourSolution& solution, const scenes::Room& room);
[[nodiscard]] Json describe(const appearance::RoomView& view, const scenes::Room& room,
                            const solver::ViewedPoint& at);
[[nodiscard]] std::int64_t peak_memory_bytes();

/// run.json, always the last of a folder's files: where it stands, the others stand too.
[[nodiscard]] OutputFile run_json(const std::filesystem::path& folder, const Json& record);

/// Notes and names of written files, on stderr.
void report_notes(const std::vector<std::string>& notes);
void report_written(const std::vector<OutputFile>& files);

}  // namespace apps
