#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "apps/commands/commands.h"
#include "apps/reports/csv.h"
#include "apps/run/room_run.h"
#include "apps/system/terminal.h"
#include "scenes/files/room_json.h"

namespace apps {
namespace {

namespace fs = std::filesystem;

/// A room of the batch and what came of it.
struct BatchRoom {
  fs::path room, folder;
  std::string status = "waiting";  ///< done, unchanged, not converged, failed, waiting
  Outcome outcome;
  Json record;  ///< its run.json, if it has one
};

std::vector<fs::path> rooms_in_folder(const fs::path& folder) {
  std::vector<fs::path> rooms;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().extension() == ".json") {
      rooms.push_back(entry.path());
    }
  }
  std::sort(rooms.begin(), rooms.end());
  return rooms;
}

/// One path per line, relative to the list's own folder; empty lines and lines with # are skipped.
std::vector<fs::path> rooms_in_list(const fs::path& list) {
  std::ifstream file(list);
  if (!file) throw spectra::FileError(fmt::format("{}: cannot be read", list.string()));
  std::vector<fs::path> rooms;
  for (std::string line; std::getline(file, line);) {
    line.erase(line.find_last_not_of(" \t\r") + 1);
    if (!line.empty() && line.front() != '#') rooms.push_back(list.parent_path() / line);
  }
  return rooms;
}

/// A folder per room, named by its stem; a second room of that name gets "-2".
std::vector<BatchRoom> plan_batch(const RankCommand& command) {
  const fs::path out = command.out;
  const bool is_folder = fs::is_directory(command.rooms);
  std::vector<BatchRoom> batch;
  std::set<std::string> taken{"summary.csv"};
  for (const fs::path& room :
       is_folder ? rooms_in_folder(command.rooms) : rooms_in_list(command.rooms)) {
    std::string name = room.stem().string();
    for (int n = 2; !taken.insert(name).second; ++n) {
      name = fmt::format("{}-{}", room.stem().string(), n);
    }
    batch.push_back({.room = room, .folder = out / name, .outcome = {}, .record = {}});
  }
  return batch;
}

/// Rank where the room has a target, else solve.
/// @throws spectra::FileError, spectra::InputError
bool wants_rank(const fs::path& path) {
  const scenes::Room room = scenes::read_room(path.string());
  return std::ranges::any_of(room.paint, [](const auto& p) { return p.target.has_value(); });
}

/// What a record says at a JSON pointer; null if it says nothing there.
Json member(const Json& record, const char* pointer) {
  const Json::json_pointer at(pointer);
  return record.contains(at) ? record[at] : Json();
}

/// The room's run.json, if it tells of the same inputs, options and version and all is there.
Json finished_record(const BatchRoom& room, const Json& identity) {
  std::ifstream file(room.folder / "run.json");
  Json record = Json::parse(file, nullptr, /*allow_exceptions=*/false);
  if (!record.is_object() || member(record, "/status") != "done") return {};
  for (const auto& [key, value] : identity.items()) {
    if (!record.contains(key) || record[key] != value) return {};
  }
  for (const Json& output : member(record, "/outputs")) {
    if (!output.is_string() || !fs::exists(room.folder / output.get<std::string>())) return {};
  }
  return record;
}

void run_room(BatchRoom& room, const RankOptions& options, const Session& session) {
  room.outcome = guarded([&] {
    const bool rank = wants_rank(room.room);
    const Json options_record =
        rank ? to_json(options) : to_json(SolveOptions{.room = options.room});
    const Json identity = run_identity(rank ? "rank" : "solve", room.room, options_record);
    room.record = finished_record(room, identity);
    if (!room.record.is_null()) {
      room.status = "unchanged";
      return Exit::done;
    }
    const RunResult result =
        rank ? run_rank(room.room.string(), options, room.folder, session)
             : run_solve(room.room.string(), {.room = options.room}, room.folder, session);
    room.record = result.record;
    room.status = result.record["status"].get<std::string>();
    return result.exit;
  });
  if (!room.outcome.message.empty()) {
    room.status = "failed";
    tell("{}\n", room.outcome.message);
  }
}

std::string best_paint(const BatchRoom& room) {
  const Json paint = member(room.record, "/ranking/best/paint");
  return paint.is_string() ? paint.get<std::string>() : "";
}

std::optional<double> number(const BatchRoom& room, const char* pointer) {
  const Json value = member(room.record, pointer);
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

/// The faults of a file, each on a line of its own, as one line.
std::string one_line(const std::string& message) {
  std::string line;
  for (const char c : message) line += c == '\n' ? std::string(" | ") : std::string(1, c);
  return line;
}

std::string summary_csv(const std::vector<BatchRoom>& batch) {
  CsvText csv("room,status,exit_code,message,paint,distance,seconds,folder");
  for (const BatchRoom& room : batch) {
    csv.cell(room.room.string()).cell(room.status);
    csv.cell(static_cast<int>(room.outcome.exit)).cell(one_line(room.outcome.message));
    csv.cell(best_paint(room)).cell(number(room, "/ranking/best/distance"));
    csv.cell(number(room, "/seconds/total")).cell(room.folder.string()).end_row();
  }
  return csv.take();
}

Json summary_list(const std::vector<BatchRoom>& batch) {
  Json list = Json::array();
  for (const BatchRoom& room : batch) {
    list.push_back({{"room", room.room.string()},
                    {"status", room.status},
                    {"exit_code", static_cast<int>(room.outcome.exit)},
                    {"message", room.outcome.message},
                    {"best", member(room.record, "/ranking/best")},
                    {"folder", room.folder.string()}});
  }
  return list;
}

}  // namespace

Exit batch_rooms(const RankCommand& command, const Session& session) {
  std::vector<BatchRoom> batch = plan_batch(command);
  if (batch.empty()) {
    throw spectra::InputError({{.file = command.rooms,
                                .line = 0,
                                .column = 0,
                                .pointer = "",
                                .problem = "names no room",
                                .remedy = "give a folder with *.json or a list of paths"}});
  }
  require_writable(command.out);
  const fs::path summary = fs::path(command.out) / "summary.csv";
  for (BatchRoom& room : batch) {
    tell("{}\n", room.room.string());
    run_room(room, command.options, session);
    if (room.status != "unchanged") write_files({{.path = summary, .text = summary_csv(batch)}});
  }
  write_files({{.path = summary, .text = summary_csv(batch)}});

  std::vector<std::vector<std::string>> rows{{"room", "status", "best paint", "folder"}};
  for (const BatchRoom& room : batch) {
    rows.push_back({room.room.string(), room.status, best_paint(room), room.folder.string()});
  }
  put(session.json ? summary_list(batch).dump(2) + "\n" : table("<<<<", rows));
  const bool failed = std::any_of(batch.begin(), batch.end(), [](const BatchRoom& room) {
    return room.outcome.exit != Exit::done;
  });
  return failed ? Exit::batch_failures : Exit::done;
}

}  // namespace apps
