#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "appearance/spectra/photometry.h"
#include "appearance/spectra/text/json_reader.h"
#include "apps/commands/commands.h"
#include "apps/commands/painted_pictures.h"
#include "apps/pictures/false_colour.h"
#include "apps/pictures/room_image.h"
#include "apps/run/room_run.h"
#include "apps/studies/repaint.h"
#include "apps/system/sha256.h"
#include "apps/system/terminal.h"
#include "solver/rooms/room_picture.h"

namespace apps {
namespace {

constexpr double kFieldOfView_deg = 60;
constexpr int kCheckedPixels = 512, kDraftChecks = 64, kDraftWidth = 320;
constexpr solver::PictureOptions kDraft{.tolerance = 0.1, .coarse_m = 2, .coarse_pixels = 24};

Json to_json(const PictureCommand& command) {
  Json json = to_json(command.options);
  json["size"] = {command.width, command.height};
  json["fov_deg"] = command.fov_deg > 0 ? Json(command.fov_deg) : Json();
  json["view"] = command.view.empty() ? Json() : Json(command.view);
  json["paint"] = command.paints;
  json["best"] = command.best;
  json["contact_sheet"] = command.contact_sheet;
  json["draft"] = command.draft;
  json["headroom"] = command.headroom;
  json["bits"] = command.bits;
  json["half"] = command.half;
  return json;
}

ExrNumbers numbers_of(const PictureCommand& command) {
  return command.half ? ExrNumbers::half : ExrNumbers::floats;
}

/// @throws solver::TooLarge
void require_memory(const PictureCommand& command, const scenes::Room& room) {
  constexpr double kGiB = 1 << 30;
  const std::int64_t need = picture_bytes(command.width, command.height, room.grid.count,
                                          numbers_of(command)),
                     free = solver::available_memory_bytes();
  if (need <= free) return;
  throw solver::TooLarge(fmt::format(
      "--size {}x{}: the picture takes {:.3g} GiB of memory, and {:.3g} GiB are free; about {:.0f} "
      "pixels would fit",
      command.width, command.height, static_cast<double>(need) / kGiB,
      static_cast<double>(free) / kGiB,
      static_cast<double>(free) / static_cast<double>(need) * command.width * command.height));
}

/// The room's own view becomes the one that is asked for. @return its field of view
double choose_view(RoomRun& run, const PictureCommand& command) {
  double fov_deg = 0;
  if (!command.view.empty()) {
    const auto view = std::ranges::find(run.room.views, command.view, &scenes::NamedView::name);
    if (view == run.room.views.end()) {
      std::vector<std::string> names;
      for (const scenes::NamedView& v : run.room.views) names.push_back(v.name);
      throw room_fault(run, "/views", fmt::format("has no view \"{}\"", command.view),
                       names.empty() ? "add it, with eye_m and look_at_m"
                                     : "take " + spectra::alternatives(names));
    }
    run.room.view = view->view;
    if (!run.room.paint.empty()) run.room.paint.front().view.reset();  // it would win
    fov_deg = view->fov_deg;
  }
  if (command.fov_deg > 0) fov_deg = command.fov_deg;
  return fov_deg > 0 ? fov_deg : kFieldOfView_deg;
}

/// Text for the headers of pictures.
std::vector<std::pair<std::string, std::string>> provenance(const RoomRun& run,
                                                            const solver::PictureCheck& check) {
  return {
      {"software", "roomhue " ROOMHUE_VERSION},
      {"room", run.room.name},
      {"roomSha256", sha256_of_file(run.path)},
      {"comments",
       "Spectral radiance per nm (W m^-2 sr^-1 nm^-1), sampled every 10 nm; each band is 10 nm "
       "wide. Box filter."},
      {"errorOfReflectedLight", fmt::format("{:.2g} RMS, {:.2g} at most, relative, at {} pixels",
                                            check.rms, check.largest, check.pixels)}};
}

Json describe(const solver::RoomPicture& picture, const solver::PictureCheck& check,
              const solver::PictureOptions& options) {
  return {{"tolerance", options.tolerance},
          {"nodes", picture.nodes()},
          {"largest_error_left_between_nodes", picture.largest_left()},
          {"compared_with_gathering",
           {{"pixels", check.pixels},
            {"rms_relative_error", check.rms},
            {"largest_relative_error", check.largest},
            {"share_above_2_percent", check.share_above_2_percent}}}};
}

Json describe(const Photograph& photo) {
  return {{"balance", "D65, no adaptation"},
          {"exposure_per_cd_m2", photo.exposure},
          {"white_at_viewed_point_Y", 0.8},
          {"desaturated_pixels", photo.desaturated},
          {"white_pixels", photo.white}};
}

Json describe(const SeenPicture& seen, double headroom) {
  return {{"display", "sRGB, white 80 cd/m2, room light 64 lx, L_A 16 cd/m2, Y_b 20, D 1"},
          {"headroom", headroom},
          {"lighter_than_display_pixels", seen.too_light},
          {"reduced_chroma_pixels", seen.less_chroma},
          {"largest_reduction_of_C", seen.largest_reduction},
          {"undefined_pixels", seen.undefined}};
}

/// What pictures do not show.
Json left_out(const scenes::Room& room) {
  Json list = Json::array();
  if (!room.point_lights.empty()) list.push_back("point lamps themselves are not drawn");
  if (!room.luminaires.empty()) list.push_back("the bodies of luminaires are not drawn");
  if (!room.suns.empty()) list.push_back("the sun's disc is not drawn");
  if (room.viewing.size_effect) list.push_back("seen.png is without the size effect");
  return list;
}

/// A draft is small, whatever is asked for.
PictureCommand sized(PictureCommand command, bool draft) {
  if (draft && command.width > kDraftWidth) {
    command.height = std::max(1, command.height * kDraftWidth / command.width);
    command.width = kDraftWidth;
  }
  return command;
}

solver::PictureOptions options_of(const PictureCommand& command) {
  return command.draft ? kDraft : solver::PictureOptions{};
}

/// The picture of the room as it is painted, and how it was taken.
struct Shot {
  RoomImage image;
  std::string exr;  ///< room.exr
  std::vector<std::pair<std::string, std::string>> told;
};

Shot take_shot(RoomRun& run, const LitPicture& lit, const solver::Camera& camera,
               const solver::PictureOptions& options, const PictureCommand& command, int threads) {
  const solver::RoomPicture picture(run.room, run.transport, lit.solution, camera, options);
  run.clock.stop("reflected light");
  const solver::PictureCheck check = picture.check(command.draft ? kDraftChecks : kCheckedPixels);
  run.clock.stop("check");
  run.record["picture"]["reflected_light"] = describe(picture, check, options);
  Shot shot{.told = provenance(run, check)};
  SpectralExr exr({.width = command.width,
                   .height = command.height,
                   .grid = run.room.grid,
                   .numbers = numbers_of(command),
                   .threads = threads,
                   .attributes = shot.told});
  shot.image = take_picture(picture, command.width, command.height, run.room.grid, &exr);
  shot.exr = exr.file();
  run.clock.stop("pixels");
  return shot;
}

/// The files of a shot; those in colours are described in the record.
std::vector<OutputFile> shot_files(RoomRun& run, Shot shot, const LitPicture& lit,
                                   const PictureCommand& command, int threads, SeenPicture& seen) {
  const std::filesystem::path out = command.out;
  const spectra::Spectrum light{run.room.grid, lit.solution.viewed.front().irradiance};
  const Photograph photo =
      photograph(shot.image, spectra::luminous(light) / std::numbers::pi, command.bits, threads);
  seen = seen_picture(shot.image, appearance::Display(lit.view.conditions, command.headroom),
                      lit.view.white_luminance_cd_m2, command.bits, threads);
  run.record["picture"]["photograph"] = describe(photo);
  run.record["picture"]["seen"] = describe(seen, command.headroom);
  std::vector<OutputFile> files{{.path = out / "room.exr", .text = std::move(shot.exr)},
                                {.path = out / "photograph.png", .text = png_file(photo.png)},
                                {.path = out / "seen.png", .text = png_file(seen.png)}};
  const auto add_map = [&](const Quantity& quantity, const Eigen::ArrayXf& values) {
    const auto& [width, height, xyz, illuminance_lx] = shot.image;
    files.push_back({.path = out / (quantity.name + ".png"),
                     .text = png_file(false_colours(width, height, values, quantity))});
    files.push_back({.path = out / (quantity.name + ".exr"),
                     .text = scalar_exr(width, height, values, shot.told)});
  };
  add_map({.name = "luminance", .unit = "cd/m2"}, shot.image.xyz.col(1));
  add_map({.name = "illuminance", .unit = "lx"}, shot.image.illuminance_lx);
  run.clock.stop("colours");
  return files;
}

/// Where the camera stands, and what it looks at.
struct Stand {
  solver::ViewedPoint viewed;
  double fov_deg = 0;

  [[nodiscard]] solver::Camera camera(int width, int height) const {
    return {viewed.eye_m, viewed.point_m, fov_deg, width, height};
  }
};

Json describe(const Stand& stand, const PictureCommand& command, const scenes::Room& room) {
  const Eigen::Vector3d& eye = stand.viewed.eye_m;
  return {{"size", {command.width, command.height}},
          {"fov_deg", stand.fov_deg},
          {"eye_m", {eye.x(), eye.y(), eye.z()}},
          {"left_out", left_out(room)}};
}

/// before_after.png and contact_sheet.png, as far as they are asked for.
std::vector<OutputFile> sheets(const RoomRun& run, const scenes::Room& before, const Stand& stand,
                               const LitPicture& lit, const SeenPicture& seen,
                               const PaintSearch& search, const PictureCommand& command,
                               int threads) {
  const std::filesystem::path out = command.out;
  std::vector<OutputFile> files = search.files;
  if (command.best) {
    const PngPicture sheet = before_after(
        run, before, stand.camera(command.width, command.height), options_of(command), seen.png,
        search, appearance::Display(lit.view.conditions, command.headroom), command, threads);
    files.push_back({.path = out / "before_after.png", .text = png_file(sheet)});
  }
  if (command.contact_sheet > 0) {
    const PictureCommand small = sized(command, true);
    const PngPicture sheet = contact_sheet(run, search, stand.camera(small.width, small.height),
                                           kDraft, command, threads);
    files.push_back({.path = out / "contact_sheet.png", .text = png_file(sheet)});
  }
  return files;
}

std::string summary(const Json& picture) {
  const Json& error = picture["reflected_light"]["compared_with_gathering"];
  return fmt::format(
      "{} x {} pixels; interpolated light is off by {:.2g} % RMS, {:.2g} % at most\n"
      "photograph: {} pixels desaturated, {} of them white\n"
      "seen: {} pixels lighter than the display, chroma reduced in {}, undefined {}\n",
      picture["size"][0].get<int>(), picture["size"][1].get<int>(),
      100 * error["rms_relative_error"].get<double>(),
      100 * error["largest_relative_error"].get<double>(),
      picture["photograph"]["desaturated_pixels"].get<std::int64_t>(),
      picture["photograph"]["white_pixels"].get<std::int64_t>(),
      picture["seen"]["lighter_than_display_pixels"].get<std::int64_t>(),
      picture["seen"]["reduced_chroma_pixels"].get<std::int64_t>(),
      picture["seen"]["undefined_pixels"].get<std::int64_t>());
}

}  // namespace

Exit take_pictures(const PictureCommand& asked, const Session& session) {
  const PictureCommand command = sized(asked, asked.draft);
  RoomRun run = open_room(command.room, "picture", to_json(command), session);
  require_memory(command, run.room);
  Json painted_as = repaint(run, command.paints);
  std::optional<PaintSearch> search;
  if (command.best || command.contact_sheet > 0) {
    search =
        search_paints(run, command, static_cast<std::size_t>(std::max(1, command.contact_sheet)));
    run.record["best_paints"] = search->record;
    run.clock.stop("search");
  }
  Stand stand{.viewed = {}, .fov_deg = choose_view(run, command)};
  stand.viewed = viewed_point(run);
  const scenes::Room before = run.room;
  if (command.best) {
    run.room = painted(run.room, search->best.front().paints);
    painted_as = search->record.front();
  }
  run.record["paints"] = painted_as;
  prepare(run, command.options, command.out, {stand.viewed});
  const LitPicture lit = lit_picture(run, run.room, command);
  run.clock.stop("solve");
  run.record["solution"] = describe(lit.solution, run.room);
  run.record["viewing"] = describe(lit.view, run.room, stand.viewed);
  run.record["picture"] = describe(stand, command, run.room);

  const int threads = thread_count(session);
  SeenPicture seen;
  std::vector<OutputFile> files =
      shot_files(run,
                 take_shot(run, lit, stand.camera(command.width, command.height),
                           options_of(command), command, threads),
                 lit, command, threads, seen);
  if (search) {
    for (OutputFile& file : sheets(run, before, stand, lit, seen, *search, command, threads)) {
      files.push_back(std::move(file));
    }
    run.clock.stop("sheets");
  }
  const bool converged = lit.solution.radiosity.converged && (!search || search->converged);
  RunResult result = finish(run, converged, std::move(files), command.out);
  result.text = summary(run.record["picture"]);
  result.data = {{"status", result.record["status"]},
                 {"folder", command.out},
                 {"picture", run.record["picture"]}};
  return print_result(result, session);
}

}  // namespace apps
