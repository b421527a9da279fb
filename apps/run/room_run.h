#pragma once
#include <chrono>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "appearance/spectra/text/input_error.h"
#include "apps/run/room_options.h"
#include "apps/run/run_record.h"
#include "apps/system/outcome.h"

namespace apps {

/// Seconds of each stage of a run, for run.json.
class StageClock {
 public:
  /// Books the time since the last call, or since the start.
  void stop(const std::string& stage);

  [[nodiscard]] const std::map<std::string, double>& seconds() const { return seconds_; }

  [[nodiscard]] double total_seconds() const;

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::map<std::string, double> seconds_;
};

/// A room on its way through the pipeline: what solve, shift and rank have in common.
struct RoomRun {
  std::string path;
  scenes::Room room;
  Json record;
  StageClock clock;
  solver::RoomTransport transport;
};

/// Reads the room and starts its record.
/// @throws spectra::FileError, spectra::InputError
[[nodiscard]] RoomRun open_room(const std::string& path, const std::string& subcommand,
                                const Json& options, const Session& session);

/// What a room's transport takes, once the room is known to be fit for the job.
/// @throws spectra::FileError  if nothing can be written to `out`
/// @throws spectra::InputError
/// @param views  the points to look at; empty: that of each painted group
[[nodiscard]] solver::TransportOptions transport_options(
    const RoomRun& run, const RoomOptions& options, const std::filesystem::path& out,
    std::vector<solver::ViewedPoint> views = {});

/// Builds mesh, exchange areas and gather rows, once the room is known to be fit for the job.
/// @throws spectra::FileError  if nothing can be written to `out`
/// @throws spectra::InputError, solver::TooLarge
/// @param views  the points to look at; empty: that of each painted group
void prepare(RoomRun& run, const RoomOptions& options, const std::filesystem::path& out,
             std::vector<solver::ViewedPoint> views = {});

/// A fault of a room file that only the subcommand at hand minds.
[[nodiscard]] spectra::InputError room_fault(const RoomRun& run, const std::string& pointer,
                                             const std::string& problem, const std::string& remedy);

/// Calls `look` and gives what it gives.
/// @throws spectra::InputError  if there is no light to view the room by
template <class Look>
auto seeing(const RoomRun& run, const Look& look) {
  try {
    return look();
  } catch (const std::domain_error& error) {
    throw room_fault(run, "/view", error.what(), "look at a surface that gets light");
  }
}

/// How one of the viewed points of a solved room looks.
/// @throws spectra::InputError  if there is no light to view it by
[[nodiscard]] appearance::RoomView view_of(const RoomRun& run, const solver::RoomSolution& solution,
                                           std::size_t viewed = 0);

/// The point of a painted group that is looked at.
/// @throws spectra::InputError  if nothing can be looked at
[[nodiscard]] solver::ViewedPoint viewed_point(const RoomRun& run, std::size_t group = 0);

/// The name of the surface that it lies on.
[[nodiscard]] const std::string& surface_name(const RoomRun& run, const solver::ViewedPoint& at);

/// What a finished run hands to its caller.
struct RunResult {
  Exit exit = Exit::done;
  Json record;       ///< run.json
  Json data;         ///< stdout with --json
  std::string text;  ///< stdout without
};

/// Completes the record, writes the files and run.json after them.
/// @throws spectra::FileError
[[nodiscard]] RunResult finish(RoomRun& run, bool converged, std::vector<OutputFile> files,
                               const std::filesystem::path& out);

/// Prints what was asked for on stdout. @return result.exit
Exit print_result(const RunResult& result, const Session& session);

[[nodiscard]] RunResult run_solve(const std::string& path, const SolveOptions& options,
                                  const std::filesystem::path& out, const Session& session);
[[nodiscard]] RunResult run_rank(const std::string& path, const RankOptions& options,
                                 const std::filesystem::path& out, const Session& session);

}  // namespace apps
