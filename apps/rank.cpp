#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <variant>

#include "apps/commands.h"
#include "apps/painted_room.h"
#include "paints/atlas_file.h"

namespace apps {
namespace {

constexpr std::size_t kTableRows = 10;

const scenes::TargetColour& target_of(const RoomRun& run) {
  if (!run.room.paint || !run.room.paint->target) {
    throw room_fault(run, "/paint/target", "is missing, and rank needs it",
                     "say which colour is wished, e.g. { \"paint\": \"munsell-nickerson:231\" }");
  }
  return *run.room.paint->target;
}

paints::Target wished(const RoomRun& run, const scenes::TargetColour& target) {
  if (const auto* reflectance = std::get_if<spectra::Spectrum>(&target.colour)) {
    const appearance::Correlates correlates = seen_on_swatch(*reflectance).correlates;
    if (!correlates.status.all_defined()) {
      throw room_fault(run, "/paint/target", "CIECAM02 does not define how this swatch looks",
                       "choose a less saturated target");
    }
    return paints::target_of(correlates);
  }
  const auto& jch = std::get<Eigen::Vector3d>(target.colour);
  return paints::target_of(
      appearance::LightnessChromaHue{.lightness = jch[0], .chroma = jch[1], .hue_deg = jch[2]});
}

void require_painted_view(const RoomRun& run) {
  const solver::ViewedPoint at = viewed_point(run);
  const std::vector<int>& painted = run.room.paint->surfaces;
  if (std::find(painted.begin(), painted.end(), at.surface) == painted.end()) {
    throw room_fault(run, "/view",
                     fmt::format("looks at \"{}\", which is not painted", surface_name(run, at)),
                     "look at one of paint.surfaces, or leave the view out");
  }
}

/// @throws spectra::InputError  if the room leaves the viewer without light
paints::Ranking rank_in(PaintedRoom& painted, const RoomRun& run, const paints::Atlas& atlas,
                        const paints::Target& wish, const RankOptions& options) {
  try {
    return paints::rank(
        atlas, wish, [&](const spectra::Spectrum& paint) { return painted.view(paint); },
        {.windows = options.windows, .distance = options.distance, .viewing = run.room.viewing});
  } catch (const std::domain_error& error) {
    throw room_fault(run, "/view", error.what(), "look at a surface that gets light");
  }
}

/// The target's own spectrum, then the `top` best paints, each on the swatch and in the room.
std::vector<Shift> shifts_of(const RoomRun& run, PaintedRoom& painted,
                             const paints::Ranking& ranking, const paints::Atlas& atlas, int top) {
  const std::string& surface = surface_name(run, run.transport.viewed);
  const scenes::TargetColour& target = *run.room.paint->target;
  std::vector<Shift> shifts;
  if (const auto* reflectance = std::get_if<spectra::Spectrum>(&target.colour)) {
    const appearance::RoomView view = view_of(run, painted.solve(*reflectance));
    shifts.push_back({.paint = target.name,
                      .surface = surface,
                      .swatch = seen_on_swatch(*reflectance),
                      .room = seen_in_room(view)});
  }
  for (int i = 0; i < std::min(top, static_cast<int>(ranking.paints.size())); ++i) {
    const paints::RankedPaint& ranked = ranking.paints[static_cast<std::size_t>(i)];
    shifts.push_back({.paint = paint_name(atlas, *ranked.paint),
                      .surface = surface,
                      .reconstructed = atlas.reconstructed,
                      .swatch = seen_on_swatch(ranked.paint->reflectance),
                      .room = {ranked.view.sample, ranked.correlates}});
  }
  return shifts;
}

/// The last `count` shifts are those of the best paints.
std::string best_table(const paints::Ranking& ranking, const std::vector<Shift>& shifts,
                       std::size_t count) {
  std::vector<std::vector<std::string>> rows{{"rank", "paint", "label", "distance", "J", "a_C",
                                              "b_C", "chroma swatch -> room",
                                              "hue swatch -> room"}};
  for (std::size_t i = 0; i < std::min(count, kTableRows); ++i) {
    const paints::RankedPaint& ranked = ranking.paints[i];
    const Shift& shift = shifts[shifts.size() - count + i];
    rows.push_back(
        {fmt::format("{}", i + 1), shift.paint, ranked.paint->label,
         fmt::format("{:.2f}", ranked.distance), fmt::format("{:.1f}", ranked.correlates.lightness),
         fmt::format("{:.1f}", ranked.correlates.a_c), fmt::format("{:.1f}", ranked.correlates.b_c),
         chroma_arrow(shift), hue_arrow(shift)});
  }
  return table("><<>>>>>>", rows);
}

Json best_list(const paints::Ranking& ranking, const std::vector<Shift>& shifts,
               std::size_t count) {
  const Json all = shift_list(shifts);
  Json list = Json::array();
  for (std::size_t i = 0; i < count; ++i) {
    const paints::RankedPaint& ranked = ranking.paints[i];
    Json entry{{"rank", i + 1}, {"label", ranked.paint->label}, {"distance", ranked.distance}};
    entry.update(all[all.size() - count + i]);
    list.push_back(entry);
  }
  return list;
}

Json describe_ranking(const paints::Ranking& ranking, const paints::Atlas& atlas,
                      const paints::Target& target) {
  Json best;
  if (!ranking.paints.empty()) {
    const paints::RankedPaint& first = ranking.paints.front();
    best = {{"paint", paint_name(atlas, *first.paint)}, {"distance", first.distance}};
  }
  return {{"atlas",
           {{"name", atlas.name},
            {"source", atlas.source},
            {"paints", atlas.paints.size()},
            {"reconstructed", atlas.reconstructed},
            {"percent", atlas.percent}}},
          {"target", {{"J", target.lightness}, {"a_C", target.a_c}, {"b_C", target.b_c}}},
          {"rejected_by_windows", ranking.rejected},
          {"undefined", ranking.undefined},
          {"best", best}};
}

/// How the room with the best paint was solved and viewed.
void record_best(RoomRun& run, PaintedRoom& painted, const paints::RankedPaint& best) {
  run.record["solution"] = describe(painted.solve(best.paint->reflectance), run.room);
  run.record["viewing"] = describe(best.view, run.room, run.transport.viewed);
}

void talk_about(const paints::Ranking& ranking, const paints::Atlas& atlas) {
  if (atlas.percent) report_notes({"the atlas gives percent; divided by 100"});
  if (atlas.reconstructed) {
    report_notes({"the atlas's spectra are reconstructed from colours, not measured"});
  }
  if (ranking.rejected > 0) {
    report_notes({fmt::format("{} of {} paints rejected by the windows", ranking.rejected,
                              atlas.paints.size())});
  }
  if (!ranking.undefined.empty()) {
    report_notes({fmt::format("{} paints left out: CIECAM02 does not define how they look here",
                              ranking.undefined.size())});
  }
}

}  // namespace

RunResult run_rank(const std::string& path, const RankOptions& options,
                   const std::filesystem::path& out, const Session& session) {
  RoomRun run = open_room(path, "rank", to_json(options), session);
  const scenes::TargetColour& target = target_of(run);
  const paints::Target wish = wished(run, target);
  const paints::Atlas atlas = paints::load_atlas(
      options.atlas.empty() ? run.room.paint->atlas : options.atlas, run.room.grid);
  run.clock.stop("atlas");
  require_painted_view(run);
  prepare(run, options.room, out);

  PaintedRoom painted(run, options.room.radiosity, static_cast<int>(atlas.paints.size()));
  const paints::Ranking ranking = rank_in(painted, run, atlas, wish, options);
  run.clock.stop("rank");
  talk_about(ranking, atlas);

  const int top = options.top > 0 ? options.top : run.room.paint->top;
  const std::vector<Shift> shifts = shifts_of(run, painted, ranking, atlas, top);
  run.record["ranking"] = describe_ranking(ranking, atlas, wish);
  if (!ranking.paints.empty()) record_best(run, painted, ranking.paints.front());
  run.record["ranking"]["solver"] = painted.record();
  run.clock.stop("report");

  RunResult result =
      finish(run, painted.converged(),
             {{.path = out / "ranking.csv", .text = ranking_csv(ranking, atlas, wish, top)},
              {.path = out / "shift.csv", .text = shift_csv(shifts)}},
             out);
  const auto count = std::min(static_cast<std::size_t>(top), ranking.paints.size());
  result.text = best_table(ranking, shifts, count);
  result.data = {{"status", result.record["status"]},
                 {"folder", out.string()},
                 {"target", result.record["ranking"]["target"]},
                 {"rejected_by_windows", ranking.rejected},
                 {"undefined", ranking.undefined},
                 {"paints", best_list(ranking, shifts, count)}};
  return result;
}

Exit rank_room(const RankCommand& command, const Session& session) {
  return print_result(run_rank(command.rooms, command.options, command.out, session), session);
}

}  // namespace apps
