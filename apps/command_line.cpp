#include "apps/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>  // seconds of compile time: included here and nowhere else
#include <cmath>
#include <memory>

namespace apps {
namespace {

/// Unlike CLI::PositiveNumber, refuses nan and infinity too.
const CLI::Validator kPositive(
    [](const std::string& text) {
      double value = 0;
      const bool good = CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value > 0;
      return good ? std::string() : text + " is no number above 0";
    },
    "ABOVE 0");

void add_patch_option(CLI::App& command, RoomOptions& options) {
  command.add_option("--patch-m", options.patch_m, "longest patch edge in m (default: the room's)")
      ->check(kPositive);
}

void add_options(CLI::App& command, RoomOptions& options) {
  add_patch_option(command, options);
  command
      .add_option("--method", options.radiosity.method,
                  "cg (default), jacobi, gauss-seidel, progressive or direct")
      ->transform(CLI::CheckedTransformer(method_names()).description("METHOD"));
  command
      .add_option("--relative-error", options.radiosity.relative_error,
                  "bound on the RMS error of each band's irradiance, relative (default 1e-6)")
      ->check(kPositive);
}

void add_atlas_options(CLI::App& command, RankOptions& options) {
  add_options(command, options.room);
  command.add_option("--atlas", options.atlas,
                     "atlas by name, or a CSV file (default: the room's)");
  command
      .add_option("--top", options.top, "how many of the best are written (default: the room's)")
      ->check(CLI::Range(1, 1000000));
  command.add_option("--response", options.response,
                     "file of the room response, read if it fits the room, else written (default: "
                     "response.json in the folder)");
}

void add_options(CLI::App& command, RankOptions& options) {
  add_atlas_options(command, options);
  command
      .add_option("--resolve-top", options.resolve_top,
                  "how many of the best are checked by full solves (default 10)")
      ->check(CLI::Range(0, 1000000));
  command
      .add_option("--max-dJ", options.windows.lightness,
                  "leave out paints whose swatch differs more than this in lightness")
      ->check(kPositive);
  command.add_option("--max-dC", options.windows.chroma, "the same in chroma")->check(kPositive);
  command.add_option("--max-dh", options.windows.hue_deg, "the same in hue, degrees")
      ->check(kPositive);
  command
      .add_option("--distance", options.distance,
                  "jab (default: Euclidean in J, a_C, b_C) or cam02-ucs")
      ->transform(CLI::CheckedTransformer(distance_names()).description("SPACE"));
}

void add_out(CLI::App& command, std::string& out,
             const std::string& what = "folder for the results") {
  command.add_option("--out", out, what)->required();
}

/// A subcommand with its help; once it is parsed, `line.job` calls `run` with what was given.
class Subcommand {
 public:
  Subcommand(CLI::App& program, const std::string& name, const std::string& what,
             const std::string& example)
      : app_(program.add_subcommand(name, what)) {
    app_->footer("Example: roomhue " + name + " " + example);
  }

  template <typename Command>
  std::shared_ptr<Command> runs(Exit (*run)(const Command&, const Session&), CommandLine& line) {
    auto command = std::make_shared<Command>();
    app_->callback([command, run, &line] {
      line.job = [command, run](const Session& session) { return run(*command, session); };
    });
    return command;
  }

  CLI::App& app() { return *app_; }

 private:
  CLI::App* app_;
};

void add_room_commands(CLI::App& program, CommandLine& line) {
  Subcommand check(program, "check",
                   "Is the room file right, and what would solving it take? Writes nothing",
                   "scenes/rooms/office.json --patch-m 0.2");
  const auto checked = check.runs(check_room, line);
  check.app().add_option("ROOM", checked->room, "room file")->required();
  add_patch_option(check.app(), checked->options);

  Subcommand solve(program, "solve", "The light in a room: receivers.csv, patches.csv, run.json",
                   "scenes/rooms/box.json --out out/box");
  const auto solved = solve.runs(solve_room, line);
  solve.app().add_option("ROOM", solved->room, "room file")->required();
  add_out(solve.app(), solved->out);
  add_options(solve.app(), solved->options);

  Subcommand shift(program, "shift",
                   "Each painted surface as on the swatch and as in the room: shift.csv",
                   "scenes/rooms/office.json --out out/office");
  const auto shifted = shift.runs(shift_room, line);
  shift.app().add_option("ROOM", shifted->room, "room file with paint.surfaces")->required();
  add_out(shift.app(), shifted->out);
  add_options(shift.app(), shifted->options);
}

void add_rank_commands(CLI::App& program, CommandLine& line) {
  Subcommand rank(program, "rank",
                  "Paints by how near they look in the room to the target on the swatch",
                  "scenes/rooms/office.json --top 30 --out out/office");
  const auto ranked = rank.runs(rank_room, line);
  rank.app().add_option("ROOM", ranked->rooms, "room file with paint.target")->required();
  add_out(rank.app(), ranked->out);
  add_options(rank.app(), ranked->options);

  Subcommand inverse(program, "inverse",
                     "The smoothest reflectance that looks in the room exactly like the target on "
                     "the swatch, in every scenario, or the nearest: reflectance.csv, inverse.csv, "
                     "appearance.csv; and the paints nearest to it: ranking.csv",
                     "scenes/rooms/office.json --out out/inverse");
  const auto inverted = inverse.runs(invert_room, line);
  inverse.app().add_option("ROOM", inverted->rooms, "room file with paint.target")->required();
  add_out(inverse.app(), inverted->out);
  add_atlas_options(inverse.app(), inverted->options);

  Subcommand batch(program, "batch",
                   "Many rooms, a folder each and summary.csv; goes on past bad rooms, resumes",
                   "scenes/rooms --out out/all");
  const auto batched = batch.runs(batch_rooms, line);
  batch.app()
      .add_option("ROOMS", batched->rooms, "folder of *.json, or a list with a path per line")
      ->required();
  add_out(batch.app(), batched->out);
  add_options(batch.app(), batched->options);
}

void add_file_commands(CLI::App& program, CommandLine& line) {
  Subcommand appearance(program, "appearance", "CIECAM02 for a table of colours",
                        "colours.csv --out correlates.csv");
  const auto table = appearance.runs(convert_table, line);
  appearance.app()
      .add_option("IN", table->in,
                  "CSV with the columns X,Y,Z,Xw,Yw,Zw,L_A,Y_b,F,c,N_c; others are kept")
      ->required();
  appearance.app().add_flag("--inverse", table->inverse, "J,C,h_deg in, X,Y,Z appended");
  add_out(appearance.app(), table->out, "CSV with the correlates appended");

  Subcommand cube(program, "cube", "Closed form of six faces at 1 nm [Neumann2004]: radiosity.csv",
                  "scenes/rooms/closed_form/cube.json --out out/cube");
  const auto faces = cube.runs(solve_cube, line);
  cube.app().add_option("FILE", faces->in, "cube file")->required();
  add_out(cube.app(), faces->out);

  Subcommand brick(program, "brick",
                   "Closed form of a furnished brick with a window at 1 nm: radiosity.csv",
                   "scenes/rooms/closed_form/brick.json --out out/brick");
  const auto parts = brick.runs(solve_brick, line);
  brick.app().add_option("FILE", parts->in, "brick file")->required();
  add_out(brick.app(), parts->out);
}

}  // namespace

CommandLine parse_command_line(int argc, const char* const* argv) {
  CommandLine line{.session = {.command_line = {argv, argv + argc}}, .job = {}};
  CLI::App program("Which paint will look, on this wall, in this room, like the swatch?",
                   "roomhue");
  program.fallthrough();
  program.require_subcommand(1);
  program.set_version_flag("--version", "roomhue " ROOMHUE_VERSION);
  program.add_flag("--json", line.session.json, "data on stdout as JSON");
  program.add_option("--threads", line.threads, "how many threads (default: one per core)")
      ->check(CLI::Range(1, 4096));
  program.footer(
      "Exit codes: 0 done, 1 our bug, 2 usage, 3 invalid input, 4 file cannot be read or written,\n"
      "5 not converged, 6 some rooms of a batch failed, 130 interrupted.\n"
      "Help on a subcommand: roomhue rank --help");
  add_room_commands(program, line);
  add_rank_commands(program, line);
  add_file_commands(program, line);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    line.exit = program.exit(error) == 0 ? Exit::done : Exit::usage;
    line.job = nullptr;
  }
  return line;
}

}  // namespace apps
