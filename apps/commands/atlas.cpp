#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "apps/commands/commands.h"
#include "apps/pictures/atlas_picture.h"
#include "apps/reports/colour_reports.h"
#include "apps/reports/csv.h"
#include "apps/studies/paint_wish.h"
#include "apps/studies/painted_room.h"
#include "apps/system/terminal.h"
#include "paints/atlas_map.h"

namespace apps {
namespace {

using paints::MappedChip;

/// Correlates of the swatch, of the room and the change, a row for each chip and lighting.
std::string map_csv(const paints::Atlas& atlas, const std::vector<MappedChip>& chips,
                    const std::vector<spectra::LitRoom>& rooms) {
  CsvText csv(
      "paint,scenario,J_swatch,C_swatch,h_deg_swatch,H_swatch,a_C_swatch,b_C_swatch,"
      "J_room,C_room,h_deg_room,H_room,a_C_room,b_C_room,distance,x,y,label,status");
  const auto cells = [&](const appearance::Correlates& correlates) {
    const Reported r(correlates);
    csv.cell(r.j).cell(r.c).cell(r.h_deg).cell(r.hue_quadrature).cell(r.a_c).cell(r.b_c);
  };
  for (const MappedChip& chip : chips) {
    for (std::size_t l = 0; l < rooms.size(); ++l) {
      const paints::SeenPaint& seen = chip.seen[l];
      csv.cell(paint_name(atlas, *chip.paint)).cell(rooms[l].name);
      cells(chip.swatch.correlates);
      cells(seen.correlates);
      csv.cell(chip.defined() ? std::optional(seen.distance) : std::nullopt);
      csv.cell(seen.chromaticity.x).cell(seen.chromaticity.y).cell(chip.paint->label);
      csv.cell(appearance::to_string(seen.correlates.status)).end_row();
    }
  }
  return csv.take();
}

/// To see this, order that.
std::string orders_csv(const paints::Atlas& atlas, const std::vector<MappedChip>& chips,
                       const std::vector<paints::Order>& orders) {
  CsvText csv(
      "wished,order,distance,distance_as_wished,J_wished,a_C_wished,b_C_wished,J,a_C,b_C,"
      "label_wished,label");
  for (const paints::Order& order : orders) {
    const MappedChip &wished = chips[order.wished], &ordered = chips[order.ordered];
    const appearance::Correlates &w = wished.swatch.correlates,
                                 &s = ordered.seen.front().correlates;
    csv.cell(paint_name(atlas, *wished.paint)).cell(paint_name(atlas, *ordered.paint));
    csv.cell(order.distance).cell(wished.seen.front().distance);
    csv.cell(w.lightness).cell(w.a_c).cell(w.b_c).cell(s.lightness).cell(s.a_c).cell(s.b_c);
    csv.cell(wished.paint->label).cell(ordered.paint->label).end_row();
  }
  return csv.take();
}

std::string picture(const std::string& title, const paints::Atlas& atlas,
                    const std::vector<MappedChip>& chips, std::size_t lighting) {
  std::vector<ChipArrow> arrows;
  for (const MappedChip& chip : chips) {
    if (!chip.defined()) continue;
    const appearance::Correlates &swatch = chip.swatch.correlates,
                                 &room = chip.seen[lighting].correlates;
    arrows.push_back({.swatch = {swatch.a_c, swatch.b_c},
                      .room = {room.a_c, room.b_c},
                      .colour = chip.swatch.xyz,
                      .name = paint_name(atlas, *chip.paint)});
  }
  return arrow_picture(title, arrows);
}

/// Means over the chips of how the room changes them, in the first lighting.
Json summary(const std::vector<MappedChip>& chips, const std::vector<paints::Order>& orders) {
  double lightness = 0, chroma = 0, moved = 0, missed = 0;
  std::size_t others = 0;
  for (const paints::Order& order : orders) {
    const MappedChip& chip = chips[order.wished];
    const paints::SeenPaint& seen = chip.seen.front();
    lightness += seen.correlates.lightness - chip.swatch.correlates.lightness;
    chroma += seen.correlates.chroma - chip.swatch.correlates.chroma;
    moved += seen.distance;
    missed += order.distance;
    others += order.ordered != order.wished ? 1 : 0;
  }
  const double n = std::max<double>(1, static_cast<double>(orders.size()));
  return {{"chips", chips.size()},
          {"undefined", chips.size() - orders.size()},
          {"mean_change_J", lightness / n},
          {"mean_change_C", chroma / n},
          {"mean_distance_as_wished", moved / n},
          {"mean_distance_as_ordered", missed / n},
          {"better_ordered_otherwise", others}};
}

std::string summary_text(const Json& s) {
  return table("<>",
               {{"in this room, mean over the chips", ""},
                {"chips (undefined in the model)",
                 fmt::format("{} ({})", s["chips"].get<int>(), s["undefined"].get<int>())},
                {"change of lightness J", fmt::format("{:+.1f}", s["mean_change_J"].get<double>())},
                {"change of chroma C", fmt::format("{:+.1f}", s["mean_change_C"].get<double>())},
                {"distance from the swatch, painted as wished",
                 fmt::format("{:.1f}", s["mean_distance_as_wished"].get<double>())},
                {"distance from the swatch, painted as orders.csv says",
                 fmt::format("{:.1f}", s["mean_distance_as_ordered"].get<double>())},
                {"chips for which another is nearer",
                 fmt::format("{}", s["better_ordered_otherwise"].get<int>())}});
}

}  // namespace

Exit map_atlas(const RankCommand& command, const Session& session) {
  const std::filesystem::path out = command.out;
  const RankOptions& options = command.options;
  RoomRun run = open_room(command.rooms, "atlas", to_json(options), session);
  require_one_group(run);
  const paints::Atlas atlas = paints::load_atlas(
      options.atlas.empty() ? run.room.paint.front().atlas : options.atlas, run.room.grid);
  run.clock.stop("atlas");
  require_painted_view(run);
  PaintedRoom painted(run, options, out, highest_reflectance(atlas, std::nullopt));
  const std::vector<spectra::LitRoom> rooms = painted.rooms();
  const paints::RankingOptions looks{.distance = options.distance,
                                     .viewing = run.room.viewing,
                                     .judgement = run.room.judgement,
                                     .swatch = swatch_of_group(run, painted)};
  const std::vector<MappedChip> chips =
      seeing(run, [&] { return paints::map_atlas(atlas, rooms, looks); });
  const std::vector<paints::Order> orders = paints::orders(chips, rooms, looks);
  run.clock.stop("map");

  std::vector<OutputFile> files{
      {.path = out / "atlas.csv", .text = map_csv(atlas, chips, rooms)},
      {.path = out / "orders.csv", .text = orders_csv(atlas, chips, orders)}};
  for (std::size_t l = 0; l < rooms.size(); ++l) {
    const std::string suffix = rooms.size() > 1 ? fmt::format("-{}", l + 1) : "";
    const std::string title =
        atlas.name + " in " + run.room.name + (rooms[l].name.empty() ? "" : ", " + rooms[l].name);
    files.push_back(
        {.path = out / ("atlas" + suffix + ".svg"), .text = picture(title, atlas, chips, l)});
  }
  for (OutputFile& file : painted.files()) files.push_back(std::move(file));
  run.record["response"] = painted.record();
  run.record["atlas"] = summary(chips, orders);
  if (!chips.empty()) {
    const appearance::RoomView& view = chips.front().seen.front().view;
    run.record["viewing"] = describe(view, run.room, viewed_point(run));
    run.record["viewing"]["paint"] = paint_name(atlas, *chips.front().paint);
    tell_white(run, view);
  }
  RunResult result = finish(run, painted.converged(), std::move(files), out);
  result.text = summary_text(run.record["atlas"]);
  result.data = {{"status", result.record["status"]},
                 {"folder", out.string()},
                 {"atlas", run.record["atlas"]}};
  return print_result(result, session);
}

}  // namespace apps
