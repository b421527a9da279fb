#include "apps/commands/painted_pictures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/pictures/picture_sheet.h"
#include "apps/pictures/pixel_font.h"
#include "apps/reports/colour_reports.h"
#include "apps/studies/repaint.h"
#include "apps/studies/scheme_search.h"
#include "solver/rooms/room_picture.h"

namespace apps {
namespace {

/// A room as the eye sees it that is adapted to it.
PngPicture seen_room(const RoomRun& run, const scenes::Room& room, const solver::Camera& camera,
                     const solver::PictureOptions& options, const PictureCommand& command,
                     int threads) {
  const LitPicture lit = lit_picture(run, room, command);
  const solver::RoomPicture picture(room, run.transport, lit.solution, camera, options);
  const RoomImage image = take_picture(picture, camera.width(), camera.height(), room.grid);
  const appearance::Display display(lit.view.conditions, command.headroom);
  return seen_picture(image, display, lit.view.white_luminance_cd_m2, command.bits, threads).png;
}

/// The wished colours, one above the other, as they look.
PngPicture swatches(const std::vector<paints::Target>& wishes, const appearance::Display& display,
                    int width, int height, int bits) {
  PngPicture png{.width = width, .height = height, .bits = bits};
  png.samples.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const auto count = static_cast<int>(wishes.size());
  for (int g = 0; g < count; ++g) {
    const paints::Target& wish = wishes[static_cast<std::size_t>(g)];
    const double hue_deg = std::atan2(wish.b_c, wish.a_c) * 180 / std::numbers::pi;
    const Eigen::Vector3d srgb =
        display.show_look({wish.lightness, std::hypot(wish.a_c, wish.b_c), hue_deg}).srgb;
    fill(png, 0, g * height / count, width, (g + 1) * height / count - g * height / count, srgb);
  }
  return png;
}

}  // namespace

PaintSearch search_paints(RoomRun run, const PictureCommand& command, std::size_t count) {
  if (run.room.paint.empty()) {
    throw room_fault(run, "/paint", "is missing, and there is no best paint without it",
                     "name the surfaces and a target");
  }
  const RankOptions options{.room = command.options, .resolve_top = 0};
  SchemeGroups groups = scheme_groups(run, options.atlas);
  PaintedRoom painted(run, options, command.out, groups.highest_reflectance);
  (void)set_targets(run, painted, groups);
  const paints::SchemeRanking ranking =
      search_schemes(run, painted, groups, options.distance, count);
  PaintSearch search{.converged = painted.converged(), .files = painted.files()};
  search.record = Json::array();
  for (const paints::SchemeGroup& group : groups.groups) search.wishes.push_back(group.target);
  for (const paints::Scheme& scheme : ranking.schemes) {
    BestPaints best;
    std::vector<std::string> names;
    for (std::size_t g = 0; g < scheme.paints.size(); ++g) {
      best.paints.push_back(scheme.paints[g]->reflectance);
      names.push_back(paint_name(groups.atlases[g], *scheme.paints[g]));
    }
    best.caption = fmt::format("{} ({:.2f})", fmt::join(names, " + "), scheme.distance);
    search.record.push_back({{"paints", names}, {"distance", scheme.distance}});
    search.best.push_back(std::move(best));
  }
  if (search.best.empty()) {
    throw room_fault(run, "/paint", "has no paint of which the model says how it looks here",
                     "take another atlas");
  }
  return search;
}

LitPicture lit_picture(const RoomRun& run, const scenes::Room& room,
                       const PictureCommand& command) {
  LitPicture lit{.solution = solver::solve_room(room, run.transport, command.options.radiosity)};
  lit.view = seeing(run, [&] {
    return appearance::view_of_room(solver::viewed_light(room, run.transport, lit.solution),
                                    room.viewing);
  });
  return lit;
}

PngPicture before_after(const RoomRun& run, const scenes::Room& before,
                        const solver::Camera& camera, const solver::PictureOptions& options,
                        const PngPicture& best, const PaintSearch& search,
                        const appearance::Display& display, const PictureCommand& command,
                        int threads) {
  return picture_sheet(
      {{.picture = seen_room(run, before, camera, options, command, threads), .caption = "now"},
       {.picture =
            swatches(search.wishes, display, std::max(1, best.width / 4), best.height, best.bits),
        .caption = "as wished"},
       {.picture = best, .caption = "best: " + search.best.front().caption}},
      3);
}

PngPicture contact_sheet(const RoomRun& run, const PaintSearch& search,
                         const solver::Camera& camera, const solver::PictureOptions& options,
                         const PictureCommand& command, int threads) {
  std::vector<SheetCell> cells;
  for (const BestPaints& best : search.best) {
    cells.push_back({.picture = seen_room(run, painted(run.room, best.paints), camera, options,
                                          command, threads),
                     .caption = fmt::format("{}. {}", cells.size() + 1, best.caption)});
  }
  const double across = std::ceil(std::sqrt(static_cast<double>(cells.size())));
  return picture_sheet(cells, static_cast<std::size_t>(across));
}

}  // namespace apps
