#include "apps/command_line/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <sstream>

#include "appearance/spectra/bilinear.h"
#include "appearance/spectra/lamp_choice.h"
#include "apps/command_line/option_checks.h"
#include "apps/system/terminal.h"

namespace apps {
namespace {

constexpr int kMostPixels = 1'000'000;  ///< along an edge

void add_patch_option(CLI::App& command, RoomOptions& options) {
  command
      .add_option(
          "--patch-m", options.patch_m,
          "longest patch edge in m with constant light; linear light takes edges 2.5 times as "
          "long "
          "(default: the room's)")
      ->check(kPositive);
  command
      .add_option("--light", options.light,
                  "what light is on a patch: linear (default), or constant, with more error at the "
                  "same cost")
      ->transform(CLI::CheckedTransformer(light_names()).description("LIGHT"));
}

void add_error_option(CLI::App& command, RoomOptions& options) {
  command
      .add_option("--relative-error", options.radiosity.relative_error,
                  "bound on the RMS error of each band's irradiance, relative (default 1e-6)")
      ->check(kPositive);
}

void add_options(CLI::App& command, RoomOptions& options) {
  add_patch_option(command, options);
  add_error_option(command, options);
  command
      .add_option("--method", options.radiosity.method,
                  "auto (default: cg where it applies, else bicgstab), cg, jacobi, gauss-seidel, "
                  "progressive, direct or bicgstab")
      ->transform(CLI::CheckedTransformer(method_names()).description("METHOD"));
  command.add_flag(
      "!--no-skip", options.radiosity.skip,
      "compute also what the plan finds that the scene does not need; slower, same result");
}

void add_mesh_options(CLI::App& command, SolveOptions& options) {
  command
      .add_option(
          "--tolerance", options.tolerance,
          "choose mesh, rays and solver so that receivers and viewed points are right within "
          "this, relative")
      ->check(CLI::Range(1e-6, 0.5))
      ->excludes("--patch-m")
      ->excludes("--relative-error");
  command
      .add_flag("--richardson", options.richardson,
                "with --light constant: extrapolate receivers and viewed points to patches of "
                "no size")
      ->excludes("--tolerance");
}

/// What every look at the paints of an atlas in a room takes.
void add_atlas_options(CLI::App& command, RankOptions& options) {
  add_options(command, options.room);
  command.add_option("--atlas", options.atlas,
                     "atlas by name, or a file of paints (default: the room's)");
  command.add_option("--response", options.response,
                     "file of the room response, read if it fits the room, else written (default: "
                     "response.json in the folder)");
}

void add_top_option(CLI::App& command, RankOptions& options) {
  command
      .add_option("--top", options.top, "how many of the best are written (default: the room's)")
      ->check(CLI::Range(1, 1000000));
}

void add_distance_option(CLI::App& command, RankOptions& options) {
  command
      .add_option("--distance", options.distance,
                  "jab (default: Euclidean in J, a_C, b_C) or cam02-ucs")
      ->transform(CLI::CheckedTransformer(distance_names()).description("SPACE"));
}

void add_options(CLI::App& command, RankOptions& options) {
  add_atlas_options(command, options);
  add_top_option(command, options);
  add_distance_option(command, options);
  command
      .add_option("--resolve-top", options.resolve_top,
                  "how many of the best are checked by full solves (default 10)")
      ->check(CLI::Range(0, 1000000));
  command
      .add_option("--max-dJ", options.windows.lightness,
                  "leave out paints whose swatch differs more than this in lightness")
      ->check(kPositive);
  command.add_flag("--robust", options.robust,
                   "order by the largest distance over the choices of white, background and size");
  command.add_option("--max-dC", options.windows.chroma, "the same in chroma")->check(kPositive);
  command.add_option("--max-dh", options.windows.hue_deg, "the same in hue, degrees")
      ->check(kPositive);
}

void add_progressive_options(CLI::App& command, RoomOptions& options) {
  command.add_flag("--ambient", options.radiosity.ambient,
                   "with --method progressive: add an estimate of the light that is still unshot");
  command.add_flag("--overshoot", options.radiosity.overshoot,
                   "with --method progressive: patches shoot also what they are expected to get");
}

/// Three numbers in place of spectra, and only the methods that suit them.
void add_colour_option(CLI::App& command, SolveCommand& solve) {
  command.add_option_function<std::string>(
      "--colour",
      [&solve](const std::string& text) {
        if (text == "spectral") return;
        try {
          solve.colour = solver::colour_model(text);
        } catch (const std::invalid_argument& error) {
          throw CLI::ValidationError("--colour", error.what());
        }
      },
      "spectral (default), or three numbers: rgb[:SPACE], bilinear[:SET[:alpha=r,g,b]], "
      "display[:MODE]");
  command.parse_complete_callback([&solve] {
    const solver::RadiosityOptions& radiosity = solve.options.room.radiosity;
    const solver::Method method = radiosity.method;
    if ((radiosity.ambient || radiosity.overshoot) && method != solver::Method::progressive) {
      throw CLI::ValidationError(radiosity.ambient ? "--ambient" : "--overshoot",
                                 "needs --method progressive");
    }
    if (solve.options.richardson && solve.options.room.light != solver::Light::constant) {
      throw CLI::ValidationError("--richardson",
                                 "needs --light constant: it counts on an error "
                                 "that falls as the square of the patch size");
    }
    if (solve.colour &&
        (method == solver::Method::conjugate_gradients || method == solver::Method::progressive ||
         method == solver::Method::direct)) {
      throw CLI::ValidationError("--method",
                                 "three numbers want auto, jacobi, gauss-seidel or bicgstab");
    }
    if (solve.colour && (solve.options.tolerance > 0 || solve.options.richardson)) {
      throw CLI::ValidationError("--colour",
                                 "--tolerance and --richardson are for spectra: leave one out");
    }
  });
}

void add_options(CLI::App& command, MixOptions& options) {
  add_atlas_options(command, options.rank);
  add_top_option(command, options.rank);
  command.add_option("--bases", options.bases, "most paints in a recipe, 1 to 4 (default 3)")
      ->check(CLI::Range(1, 4));
  command
      .add_option("--step", options.step,
                  "what can be weighed, in parts of 100 (default: any parts)")
      ->check(kStep);
  command
      .add_option_function<std::vector<double>>(
          "--saunderson",
          [&options](const std::vector<double>& k) { options.surface = {.k1 = k[0], .k2 = k[1]}; },
          "K1,K2: light thrown back by the film's surface from outside, as far as it was measured, "
          "and from within (default 0,0: no correction)")
      ->expected(2)
      ->delimiter(',')
      ->check(kShare);
}

void add_out(CLI::App& command, std::string& out,
             const std::string& what = "folder for the results") {
  command.add_option("--out", out, what)->required()->check(kNamed);
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
  add_options(solve.app(), solved->options.room);
  add_progressive_options(solve.app(), solved->options.room);
  add_mesh_options(solve.app(), solved->options);
  add_colour_option(solve.app(), *solved);

  Subcommand daylight(program, "daylight",
                      "The light at receivers hour by hour of a weather file: daylight.csv, "
                      "daylight_summary.csv",
                      "scenes/rooms/day.json --out out/day");
  const auto hours = daylight.runs(daylight_hours, line);
  daylight.app()
      .add_option("ROOM", hours->room, "room file with a sky from a weather file")
      ->required();
  add_out(daylight.app(), hours->out);
  add_options(daylight.app(), hours->options);
  daylight.app()
      .add_option_function<std::vector<int>>(
          "--hours",
          [hours = &*hours](const std::vector<int>& ends) {
            hours->hours = {ends[0], ends[1]};
          },
          "FIRST,LAST hour of the file, from 1 (default: all)")
      ->expected(2)
      ->delimiter(',')
      ->check(CLI::Range(1, 10000000));

  Subcommand shift(program, "shift",
                   "Each painted surface as on the swatch and as in the room: shift.csv",
                   "scenes/rooms/office.json --out out/office");
  const auto shifted = shift.runs(shift_room, line);
  shift.app().add_option("ROOM", shifted->room, "room file with paint.surfaces")->required();
  add_out(shift.app(), shifted->out);
  add_options(shift.app(), shifted->options);

  Subcommand compare(program, "compare",
                     "The room by spectra, by three numbers and by spectra made up from RGB: "
                     "compare.csv, methods.csv, summary.md",
                     "scenes/rooms/office.json --out out/compare");
  const auto compared = compare.runs(compare_room, line);
  compare.app().add_option("ROOM", compared->room, "room file")->required();
  add_out(compare.app(), compared->out);
  add_patch_option(compare.app(), compared->options);
  add_error_option(compare.app(), compared->options);

  Subcommand convergence(program, "convergence",
                         "Error against run time, one factor at a time: methods and tolerances, "
                         "patch sizes, ray counts, bands: convergence.csv, convergence.svg, "
                         "iterations.svg, summary.txt",
                         "scenes/rooms/box.json --out out/convergence");
  const auto measured = convergence.runs(measure_room, line);
  convergence.app().add_option("ROOM", measured->room, "room file")->required();
  add_out(convergence.app(), measured->out);
  convergence.app()
      .add_option("--patch-m", measured->options.patch_m,
                  "longest patch edge of the baseline in m (default: the room's)")
      ->check(kPositive);
  convergence.app()
      .add_option("--seconds", measured->options.seconds,
                  "time to be spent (default 120): half for the reference, as planned for one "
                  "core, half for the runs")
      ->check(kPositive);
}

void add_rank_commands(CLI::App& program, CommandLine& line) {
  Subcommand rank(program, "rank",
                  "Paints by how near they look in the room to the target on the swatch",
                  "scenes/rooms/office.json --top 30 --out out/office");
  const auto ranked = rank.runs(rank_room, line);
  rank.app().add_option("ROOM", ranked->rooms, "room file with paint.target")->required();
  add_out(rank.app(), ranked->out);
  add_options(rank.app(), ranked->options);

  Subcommand atlas(program, "atlas",
                   "A whole atlas on the swatch and in the room, and what to order to see a chip: "
                   "atlas.csv, orders.csv, atlas.svg",
                   "scenes/rooms/office.json --out out/office");
  const auto mapped = atlas.runs(map_atlas, line);
  atlas.app().add_option("ROOM", mapped->rooms, "room file with paint.surfaces")->required();
  add_out(atlas.app(), mapped->out);
  add_atlas_options(atlas.app(), mapped->options);
  add_distance_option(atlas.app(), mapped->options);

  Subcommand mix(program, "mix",
                 "Mixtures of the atlas's paints by how near they look in the room to the target: "
                 "recipes.csv, mixtures.csv",
                 "scenes/rooms/office.json --bases 3 --step 0.5 --out out/mix");
  const auto mixed = mix.runs(mix_room, line);
  mix.app().add_option("ROOM", mixed->room, "room file with paint.target")->required();
  add_out(mix.app(), mixed->out);
  add_options(mix.app(), mixed->options);

  Subcommand inverse(program, "inverse",
                     "The smoothest reflectance that looks in the room exactly like the target on "
                     "the swatch, in every scenario, or the nearest: reflectance.csv, inverse.csv, "
                     "appearance.csv; and the paints nearest to it: ranking.csv",
                     "scenes/rooms/office.json --out out/inverse");
  const auto inverted = inverse.runs(invert_room, line);
  inverse.app().add_option("ROOM", inverted->rooms, "room file with paint.target")->required();
  add_out(inverse.app(), inverted->out);
  add_atlas_options(inverse.app(), inverted->options);
  add_top_option(inverse.app(), inverted->options);

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

  Subcommand paints(program, "paints",
                    "What is in a file of paints: how it was read, X, Y, Z, L*, a*, b*, LRV; and "
                    "the same in another format",
                    "shop.csv --out shop.gpl");
  const auto listed = paints.runs(list_paints, line);
  paints.app()
      .add_option(
          "FILE", listed->in,
          "CSV, CxF3, CGATS or QTX; FILE?KEY=VALUE,... chooses where it leaves two readings")
      ->required();
  paints.app().add_option("--out", listed->out, "write them as .csv, .cxf, .ase or .gpl");

  Subcommand lamp(program, "lamp",
                  "What is in a photometric file: flux by zones, efficacy, beam and field angles, "
                  "size; and a polar diagram",
                  "lamp.ies --out lamp.svg");
  const auto described = lamp.runs(describe_lamp, line);
  lamp.app().add_option("FILE", described->in, "IES LM-63 (.ies) or EULUMDAT (.ldt)")->required();
  lamp.app().add_option("--out", described->out, "the polar diagram, .svg");

  Subcommand lamps(program, "lamps",
                   "The measured lamps, nearest first to what is on a box; or what colour the "
                   "lamps of a file of yours have",
                   "--kind LED --cct 2700 --ra 90 --top 5");
  const auto wanted = lamps.runs(tell_lamps, line);
  lamps.app().add_option("FILE", wanted->in,
                         "spectra: columns of text, CSV, CGATS, TM-27 or TM-33");
  lamps.app()
      .add_option("--kind", wanted->kind, "kind of lamp")
      ->check(CLI::IsMember(spectra::lamp_kinds()));
  lamps.app().add_option("--cct", wanted->cct_K, "colour temperature, K")->check(kPositive);
  lamps.app().add_option("--ra", wanted->ra, "colour rendering")->check(CLI::Range(0.0, 100.0));
  lamps.app().add_option("--r9", wanted->r9, "rendering of red")->check(CLI::Range(-400.0, 100.0));
  lamps.app()
      .add_option("--top", wanted->top, "how many (default: all)")
      ->check(CLI::Range(1, 1000));

  Subcommand sky(program, "sky",
                 "An hour of a weather file: where the sun stands, how bright sun and sky are, and "
                 "the light for a room file",
                 "--epw berlin.epw --hour 4092");
  const auto hour = sky.runs(describe_sky, line);
  sky.app().add_option("--epw", hour->weather, "EnergyPlus weather file")->required();
  sky.app()
      .add_option("--hour", hour->hour, "of the year, from 1")
      ->required()
      ->check(CLI::Range(1, 10000000));

  Subcommand import(program, "import",
                    "A room file from a room of a building model (Honeybee's HBJSON)",
                    "house.hbjson --room Kitchen --out kitchen.json");
  const auto imported = import.runs(import_model, line);
  import.app().add_option("MODEL", imported->in, "model file")->required();
  import.app().add_option("--room", imported->rooms,
                          "identifier or name of a room; several are joined where they are open "
                          "to each other (default: the only one)");
  import.app()
      .add_option("--sky-lx", imported->sky_lx,
                  "illuminance of windows from outside, lx: the model has no lamps (default 5000)")
      ->check(CLI::Range(1e-3, 1e6));
  add_out(import.app(), imported->out, "room file to be written");

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

/// Three numbers with commas between them.
template <typename Value>
CLI::Option* add_colour(CLI::App& command, const std::string& name, Value& colour,
                        const std::string& what) {
  return command.add_option(name, colour, what)->delimiter(',')->check(kNotNegative);
}

CLI::Option* add_set_option(CLI::App& command, std::string& set) {
  return command
      .add_option("--set", set,
                  fmt::format("coefficients of the bilinear product: {} (default {})",
                              fmt::join(spectra::bilinear_set_names(), ", "), set))
      ->check(CLI::IsMember(spectra::bilinear_set_names()).description("SET"));
}

/// "1280x960"
void set_size(const std::string& text, PictureCommand& picture) {
  std::istringstream in(text);
  char x = 0;
  const bool read = in >> picture.width >> x >> picture.height && x == 'x' && in.peek() == EOF;
  const bool sound = picture.width > 0 && picture.height > 0 && picture.width <= kMostPixels &&
                     picture.height <= kMostPixels;
  if (!read || !sound) {
    throw CLI::ValidationError(
        "--size",
        fmt::format("\"{}\": give WIDTHxHEIGHT in pixels, each from 1 to {}", text, kMostPixels));
  }
}

void add_picture_command(CLI::App& program, CommandLine& line) {
  Subcommand picture(
      program, "picture",
      "The room as a picture: room.exr (spectra), photograph.png, seen.png; in false "
      "colours luminance and illuminance",
      "scenes/rooms/office.json --out out/office --size 640x480");
  const auto taken = picture.runs(take_pictures, line);
  CLI::App& app = picture.app();
  app.add_option("ROOM", taken->room, "room file")->required();
  add_out(app, taken->out);
  app.add_option_function<std::string>(
      "--size", [taken](const std::string& text) { set_size(text, *taken); },
      "WIDTHxHEIGHT in pixels (default 1280x960)");
  app.add_option("--fov-deg", taken->fov_deg,
                 "horizontal field of view (default: the view's, else 60)")
      ->check(within(1, 150));
  app.add_option("--view", taken->view, "name in the room's \"views\" (default: its \"view\")");
  auto* paint =
      app.add_option("--paint", taken->paints,
                     "GROUP=PAINT: a painted group of the room with a paint of its atlas");
  app.add_flag(
         "--best", taken->best,
         "with the best paints, as rank finds them; and before_after.png: now, the wish, best")
      ->excludes(paint);
  app.add_option("--contact-sheet", taken->contact_sheet,
                 "contact_sheet.png: the room in each of so many of the best paints")
      ->check(CLI::Range(1, 100));
  app.add_flag(
      "--draft", taken->draft,
      "for a first look: at most 320 pixels across, reflected light gathered at few points");
  app.add_option("--headroom", taken->headroom,
                 "how many times lighter than the room's white the white of seen.png is (default "
                 "10/9: white walls keep the tinge of the light)")
      ->check(within(1, 100));
  app.add_option("--bits", taken->bits, "of a sample of a PNG: 8 (default) or 16")
      ->check(CLI::IsMember({8, 16}));
  app.add_flag("--half", taken->half, "room.exr in half floats: for looking, not for measuring");
  add_options(app, taken->options);
}

void add_picture_commands(CLI::App& program, CommandLine& line) {
  add_picture_command(program, line);
  Subcommand relight(program, "relight",
                     "A picture in OpenEXR under another light [Granier2004]: R, G, B divided by "
                     "the colour of one light, times that of another; all else is kept",
                     "sky.exr evening.exr --from 0.4,0.9,1.0 --to 1.0,0.9,0.1");
  const auto relit = relight.runs(relight_picture, line);
  relight.app().add_option("IN", relit->in, "OpenEXR picture with R, G, B")->required();
  relight.app().add_option("OUT", relit->out, "the same under the other light")->required();
  add_colour(relight.app(), "--from", relit->from, "r,g,b of the light it was taken in")
      ->required();
  add_colour(relight.app(), "--to", relit->to, "r,g,b of the other light")->required();
  auto* classical = relight.app().add_flag("--classical", relit->classical,
                                           "component by component, for comparison");
  add_set_option(relight.app(), relit->set)->excludes(classical);

  Subcommand shader(program, "shader",
                    "The bilinear product as a function in the shading language of OpenGL ES",
                    "--set srgb");
  const auto printed = shader.runs(print_shader, line);
  add_set_option(shader.app(), printed->set);
  add_colour(shader.app(), "--alpha", printed->alpha, "r,g,b: share of other products, from 0");
}

void add_verify_command(CLI::App& program, CommandLine& line) {
  Subcommand verify(program, "verify",
                    "Is the engine right on this machine? Cases with closed forms, each with its "
                    "error; exit code 7 if one fails",
                    "--out out/verify");
  const auto verified = verify.runs(verify_engine, line);
  verify.app().add_option("--out", verified->out,
                          "folder for verify.csv (default: nothing is written)");
  verify.app().add_flag("--measured{scenes/measured}", verified->measured,
                        "compare with measured rooms instead (=FOLDER, default scenes/measured)");
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
  program.add_option("--threads", line.session.threads, "how many threads (default: one per core)")
      ->check(CLI::Range(1, 4096));
  program.footer(
      "Exit codes: 0 done, 1 our bug, 2 usage, 3 invalid input, 4 file cannot be read or written,\n"
      "5 not converged, 6 some rooms of a batch failed, 7 a self-check failed,\n"
      "130 interrupted.\n"
      "Help on a subcommand: roomhue rank --help");
  add_room_commands(program, line);
  add_rank_commands(program, line);
  add_file_commands(program, line);
  add_picture_commands(program, line);
  add_verify_command(program, line);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream data, talk;
    line.exit = program.exit(error, data, talk) == 0 ? Exit::done : Exit::usage;
    tell(talk.str());
    put(data.str());
    line.job = nullptr;
  }
  return line;
}

}  // namespace apps
