#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "appearance/spectra/photometry.h"
#include "appearance/spectra/text/json_reader.h"
#include "apps/commands/commands.h"
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
PictureCommand sized(PictureCommand command) {
  if (command.draft && command.width > kDraftWidth) {
    command.height = std::max(1, command.height * kDraftWidth / command.width);
    command.width = kDraftWidth;
  }
  return command;
}

}  // namespace

Exit take_pictures(const PictureCommand& asked, const Session& session) {
  const PictureCommand command = sized(asked);
  const std::filesystem::path out = command.out;
  RoomRun run = open_room(command.room, "picture", to_json(command), session);
  require_memory(command, run.room);
  const double fov_deg = choose_view(run, command);
  run.record["paints"] = repaint(run, command.paints);
  const solver::ViewedPoint viewed = viewed_point(run);
  prepare(run, command.options, out, {viewed});
  const solver::RoomSolution solution =
      solver::solve_room(run.room, run.transport, command.options.radiosity);
  run.clock.stop("solve");
  run.record["solution"] = describe(solution, run.room);
  const appearance::RoomView view = view_of(run, solution);
  run.record["viewing"] = describe(view, run.room, viewed);

  const solver::PictureOptions options = command.draft ? kDraft : solver::PictureOptions{};
  const solver::Camera camera(viewed.eye_m, viewed.point_m, fov_deg, command.width, command.height);
  const solver::RoomPicture picture(run.room, run.transport, solution, camera, options);
  run.clock.stop("reflected light");
  const solver::PictureCheck check = picture.check(command.draft ? kDraftChecks : kCheckedPixels);
  run.clock.stop("check");
  const int threads = thread_count(session);
  SpectralExr exr({.width = command.width,
                   .height = command.height,
                   .grid = run.room.grid,
                   .numbers = numbers_of(command),
                   .threads = threads,
                   .attributes = provenance(run, check)});
  const RoomImage image = take_picture(picture, command.width, command.height, run.room.grid, exr);
  run.clock.stop("pixels");
  const double white_cd_m2 = view.illuminance_lx / std::numbers::pi;
  const Photograph photo = photograph(image, white_cd_m2, command.bits, threads);
  const SeenPicture seen =
      seen_picture(image, appearance::Display(view.conditions, command.headroom),
                   view.white_luminance_cd_m2, command.bits, threads);
  run.clock.stop("colours");
  run.record["picture"] = {{"size", {command.width, command.height}},
                           {"fov_deg", fov_deg},
                           {"eye_m", {viewed.eye_m.x(), viewed.eye_m.y(), viewed.eye_m.z()}},
                           {"reflected_light", describe(picture, check, options)},
                           {"photograph", describe(photo)},
                           {"seen", describe(seen, command.headroom)},
                           {"left_out", left_out(run.room)}};
  std::vector<OutputFile> files{{.path = out / "room.exr", .text = exr.file()},
                                {.path = out / "photograph.png", .text = png_file(photo.png)},
                                {.path = out / "seen.png", .text = png_file(seen.png)}};
  const std::vector<std::pair<std::string, std::string>> told = provenance(run, check);
  const auto add_map = [&](const Quantity& quantity, const Eigen::ArrayXf& values) {
    const std::string name = quantity.name;
    files.push_back({.path = out / (name + ".png"),
                     .text = png_file(false_colours(image.width, image.height, values, quantity))});
    files.push_back({.path = out / (name + ".exr"),
                     .text = scalar_exr(image.width, image.height, values, told)});
  };
  add_map({.name = "luminance", .unit = "cd/m2"}, image.xyz.col(1));
  add_map({.name = "illuminance", .unit = "lx"}, image.illuminance_lx);
  run.clock.stop("files");
  RunResult result = finish(run, solution.radiosity.converged, std::move(files), out);
  result.data = {{"status", result.record["status"]},
                 {"folder", out.string()},
                 {"picture", run.record["picture"]}};
  return print_result(result, session);
}

}  // namespace apps
