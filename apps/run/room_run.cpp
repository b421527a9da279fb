#include "apps/run/room_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "appearance/size_effect.h"
#include "appearance/spectra/text/json_reader.h"
#include "apps/system/terminal.h"
#include "scenes/files/room_json.h"

namespace apps {
namespace {

/// The part of the file that the pointer names, or as much of the way there as the file has.
spectra::JsonNode node_at(spectra::JsonFile& file, std::string_view pointer) {
  spectra::JsonNode node = file.root();
  while (!pointer.empty()) {
    pointer.remove_prefix(1);  // the slash
    const std::string_view token = pointer.substr(0, pointer.find('/'));
    pointer.remove_prefix(token.size());
    std::optional<spectra::JsonNode> next;
    std::size_t index = 0;
    if (node.is(spectra::JsonNode::Kind::object)) {
      next = node.any_object().find(token);
    } else if (node.is(spectra::JsonNode::Kind::list) &&
               std::from_chars(token.begin(), token.end(), index).ec == std::errc{}) {
      const std::vector<spectra::JsonNode> entries = node.list();
      if (index < entries.size()) next = entries[index];
    }
    if (!next) break;
    node = *next;
  }
  return node;
}

/// Line and column of a fault in the file as it is now; none if it can no longer be read.
void place(spectra::Fault& fault) {
  try {
    spectra::JsonFile file = spectra::read_json_file(fault.file);
    node_at(file, fault.pointer).fault("", "");
    file.throw_faults();
  } catch (const spectra::InputError& error) {
    fault.line = error.faults().front().line;
    fault.column = error.faults().front().column;
  } catch (const spectra::FileError&) {
    return;
  }
}

/// A last column for tables of looks that rest on constants which could not be verified.
void add_caution(OutputFile& file) {
  const std::string end = "\r\n";
  const std::string header = file.text.substr(0, file.text.find(end));
  const auto has = [&](const char* column) { return header.find(column) != header.npos; };
  const bool of_looks = file.path.extension() == ".csv" && (has(",J") || has(",distance"));
  if (!of_looks || has("caution")) return;
  std::string marked;
  for (std::size_t at = 0; at < file.text.size();) {
    const std::size_t stop = file.text.find(end, at);
    marked += file.text.substr(at, stop - at) + "," +
              (at == 0 ? "caution" : appearance::kSizeEffectCaution) + end;
    at = stop == file.text.npos ? file.text.size() : stop + end.size();
  }
  file.text = std::move(marked);
}

}  // namespace

void StageClock::stop(const std::string& stage) {
  const auto now = std::chrono::steady_clock::now();
  seconds_[stage] += std::chrono::duration<double>(now - last_).count();
  last_ = now;
}

double StageClock::total_seconds() const {
  double total = 0;
  for (const auto& [stage, seconds] : seconds_) total += seconds;
  return total;
}

RoomRun open_room(const std::string& path, const std::string& subcommand, const Json& options,
                  const Session& session) {
  RoomRun run{.path = path, .room = {}, .record = {}, .clock = {}, .transport = {}};
  run.room = scenes::read_room(path);
  run.clock.stop("read");
  run.record = begin_record(run_identity(subcommand, path, options), session);
  run.record["room"] = describe(run.room);
  run.record["grid"] = describe(run.room.grid);
  report_notes(run.room.notes);
  return run;
}

solver::TransportOptions transport_options(const RoomRun& run, const RoomOptions& options,
                                           const std::filesystem::path& out,
                                           std::vector<solver::ViewedPoint> views) {
  require_writable(out);
  const bool eye = !views.empty() || run.room.view || !run.room.paint.empty();
  for (std::size_t g = views.size(); g < std::max<std::size_t>(1, run.room.paint.size()); ++g) {
    views.push_back(viewed_point(run, g));  // if nothing can be looked at, say so before long work
  }
  return {.patch_m = options.patch_m,
          .light = options.light,
          .views = std::move(views),
          .skip = options.radiosity.skip,
          .eye = eye};
}

void prepare(RoomRun& run, const RoomOptions& options, const std::filesystem::path& out,
             std::vector<solver::ViewedPoint> views) {
  run.transport =
      solver::prepare_transport(run.room, transport_options(run, options, out, std::move(views)));
  for (std::size_t r = 0; r < run.room.receivers.size(); ++r) {
    const double defect = run.transport.receivers[r].gather.closure_defect;
    if (defect < 1e-3) continue;
    tell("note: {}: what it sees of all patches misses 1 by {:.2g} and is scaled\n",
         run.room.receivers[r].name, defect);
  }
  run.clock.stop("transport");
  run.record["transport"] = describe(run.transport);
}

spectra::InputError room_fault(const RoomRun& run, const std::string& pointer,
                               const std::string& problem, const std::string& remedy) {
  spectra::Fault fault{.file = run.path,
                       .line = 0,
                       .column = 0,
                       .pointer = pointer,
                       .problem = problem,
                       .remedy = remedy};
  place(fault);
  return spectra::InputError({fault});
}

appearance::RoomView view_of(const RoomRun& run, const solver::RoomSolution& solution,
                             std::size_t viewed) {
  return seeing(run, [&] {
    return appearance::view_of_room(solver::viewed_light(run.room, run.transport, solution, viewed),
                                    run.room.viewing);
  });
}

solver::ViewedPoint viewed_point(const RoomRun& run, std::size_t group) {
  try {
    return solver::viewed_point(run.room, group);
  } catch (const std::invalid_argument& error) {
    throw room_fault(run, "/view", error.what(), "give a view that meets a painted surface");
  }
}

const std::string& surface_name(const RoomRun& run, const solver::ViewedPoint& at) {
  return run.room.surfaces[static_cast<std::size_t>(at.surface)].name;
}

RunResult finish(RoomRun& run, bool converged, std::vector<OutputFile> files,
                 const std::filesystem::path& out) {
  Json& record = run.record;
  record["status"] = converged ? "done" : "not converged";
  record["seconds"] = run.clock.seconds();
  record["seconds"]["total"] = run.clock.total_seconds();
  record["seconds"]["transport_stages"] = run.transport.seconds;
  record["peak_memory_bytes"] = peak_memory_bytes();
  record["outputs"] = Json::array();
  for (const OutputFile& file : files) record["outputs"].push_back(file.path.filename().string());
  if (run.room.viewing.size_effect) std::ranges::for_each(files, add_caution);
  files.push_back(run_json(out, record));
  write_files(files);
  report_written(files);
  if (!converged) {
    tell("not converged: the outputs are marked in run.json; see its error bounds\n");
  }
  return {.exit = converged ? Exit::done : Exit::not_converged,
          .record = record,
          .data = {},
          .text = {}};
}

Exit print_result(const RunResult& result, const Session& session) {
  if (!session.json) {
    put(result.text);
    return result.exit;
  }
  Json data = result.data;
  const Json room = result.record.value("room", Json::object());
  if (const Json notes = room.value("notes", Json::array()); !notes.empty()) data["notes"] = notes;
  put(data.dump(2) + "\n");
  return result.exit;
}

}  // namespace apps
