#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <variant>

#include "apps/commands/commands.h"
#include "apps/commands/scheme.h"
#include "apps/pictures/model_spread_picture.h"
#include "apps/reports/colour_reports.h"
#include "apps/reports/model_spread_report.h"
#include "apps/studies/look_errors.h"
#include "apps/studies/model_spread.h"
#include "apps/studies/paint_wish.h"
#include "apps/studies/painted_room.h"
#include "apps/studies/resolve.h"
#include "apps/system/terminal.h"
#include "paints/atlas_file.h"

namespace apps {
namespace {

constexpr std::size_t kTableRows = 10;

/// The target's own spectrum, then the `top` best paints, each on the swatch and in the room, in
/// the first lighting.
std::vector<Shift> shifts_of(const RoomRun& run, const spectra::LitRoom& room,
                             const paints::Ranking& ranking, const paints::Atlas& atlas, int top,
                             const appearance::SwatchCondition& swatch) {
  const std::string& surface = surface_name(run, viewed_point(run));
  const scenes::TargetColour& target = *run.room.paint.front().target;
  std::vector<Shift> shifts;
  if (const auto* reflectance = std::get_if<spectra::Spectrum>(&target.colour)) {
    const appearance::RoomView view =
        appearance::view_of_room(room.view(*reflectance), run.room.viewing);
    shifts.push_back({.paint = target.name,
                      .surface = surface,
                      .swatch = seen_on_swatch(*reflectance, swatch),
                      .room = seen_in_room(view)});
  }
  for (int i = 0; i < std::min(top, static_cast<int>(ranking.paints.size())); ++i) {
    const paints::RankedPaint& ranked = ranking.paints[static_cast<std::size_t>(i)];
    shifts.push_back({.paint = paint_name(atlas, *ranked.paint),
                      .surface = surface,
                      .reconstructed = atlas.reconstructed,
                      .swatch = seen_on_swatch(ranked.paint->reflectance, swatch),
                      .room = {ranked.seen.front().view.sample, ranked.seen.front().correlates}});
  }
  return shifts;
}

std::vector<Winner> winners_of(const paints::Ranking& ranking) {
  std::vector<Winner> winners;
  for (const paints::RankedPaint& p : ranking.paints) {
    winners.push_back({.paints = {p.paint->reflectance}, .distance = p.distance});
  }
  return winners;
}

std::string error_text(const RankingErrors& errors, std::size_t i) {
  return errors.of_paint.empty() ? "-" : fmt::format("{:.3f}", errors.of_paint[i].distance);
}

/// Who may in truth be the best.
std::string ties_text(const RankingErrors& errors, std::size_t count) {
  const auto listed = static_cast<std::ptrdiff_t>(std::min(count, errors.ties_with.size()));
  const auto ties = std::count(errors.ties_with.begin(), errors.ties_with.begin() + listed, 1);
  if (errors.of_paint.empty()) return "longer patches cut this room no other way: no mesh error\n";
  if (ties == 0) return "error: what the mesh leaves of the distance; the best paint is settled\n";
  return fmt::format(
      "error: what the mesh leaves of the distance; {} of the paints listed may be "
      "as near as the first (ties_with 1)\n",
      ties);
}

/// The last `count` shifts are those of the best paints.
std::string best_table(const paints::Ranking& ranking, const std::vector<Shift>& shifts,
                       const RankingErrors& errors, std::size_t count) {
  std::vector<std::vector<std::string>> rows{{"rank", "paint", "label", "distance", "error", "J",
                                              "a_C", "b_C", "chroma swatch -> room",
                                              "hue swatch -> room"}};
  for (std::size_t i = 0; i < std::min(count, kTableRows); ++i) {
    const paints::RankedPaint& ranked = ranking.paints[i];
    const appearance::Correlates& seen = ranked.seen.front().correlates;
    const Shift& shift = shifts[shifts.size() - count + i];
    rows.push_back({fmt::format("{}", i + 1), shift.paint, ranked.paint->label,
                    fmt::format("{:.2f}", ranked.distance), error_text(errors, i),
                    fmt::format("{:.1f}", seen.lightness), fmt::format("{:.1f}", seen.a_c),
                    fmt::format("{:.1f}", seen.b_c), chroma_arrow(shift), hue_arrow(shift)});
  }
  return table("><<>>>>>>>", rows) + ties_text(errors, count);
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

/// Of the viewing condition with the best paint.
Json describe(const RankingErrors& errors) {
  if (errors.of_paint.empty()) return {};
  const LookError& e = errors.of_paint.front();
  return {{"Y_b", e.background_y}, {"L_A_cd_m2", e.adapting_luminance_cd_m2}, {"white", e.white}};
}

/// Of the listed paints, those whose look differs least between the lightings.
Json most_constant(const paints::Ranking& ranking, const paints::Atlas& atlas, int top) {
  constexpr std::size_t kNamed = 5;
  const auto listed = std::min(static_cast<std::size_t>(top), ranking.paints.size());
  std::vector<const paints::RankedPaint*> paints;
  for (std::size_t i = 0; i < listed; ++i) paints.push_back(&ranking.paints[i]);
  std::ranges::stable_sort(paints, {}, &paints::RankedPaint::inconstancy);
  Json list = Json::array();
  for (std::size_t i = 0; i < std::min(kNamed, paints.size()); ++i) {
    list.push_back({{"paint", paint_name(atlas, *paints[i]->paint)},
                    {"inconstancy", paints[i]->inconstancy},
                    {"distance", paints[i]->distance}});
  }
  return list;
}

std::string constancy_text(const Json& constant) {
  std::string text = "\nof these, the looks that change least from lighting to lighting:\n";
  for (const Json& paint : constant) {
    text +=
        fmt::format("  {}  changes by {:.2f}, distance {:.2f}\n", paint["paint"].get<std::string>(),
                    paint["inconstancy"].get<double>(), paint["distance"].get<double>());
  }
  return text;
}

void talk_about(const paints::Ranking& ranking, const paints::Atlas& atlas) {
  if (atlas.percent) report_notes({"the atlas gives percent; divided by 100"});
  report_notes(atlas.notes);
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
  if (run.room.paint.size() > 1) return rank_schemes(run, options, out);
  const scenes::TargetColour& target = target_of(run);
  require_wish(run);
  const paints::Atlas atlas = paints::load_atlas(
      options.atlas.empty() ? run.room.paint.front().atlas : options.atlas, run.room.grid);
  run.clock.stop("atlas");
  require_painted_view(run);

  PaintedRoom painted(run, options, out, highest_reflectance(atlas, target));
  const std::vector<spectra::LitRoom> rooms = painted.rooms();
  const auto here = light_here(run, painted);
  const appearance::SwatchCondition swatch = swatch_of(run, target, run.room.viewing, here);
  const paints::Target wish = wished(run, target, swatch);
  const int top = options.top > 0 ? options.top : run.room.paint.front().top;
  const auto kept = static_cast<std::size_t>(std::max(top, options.resolve_top));
  const paints::RankingOptions how{.windows = options.windows,
                                   .distance = options.distance,
                                   .viewing = run.room.viewing,
                                   .judgement = run.room.judgement,
                                   .top = options.robust ? atlas.paints.size() : kept,
                                   .swatch = swatch};
  paints::Ranking ranking = seeing(run, [&] { return paints::rank(atlas, wish, rooms, how); });
  run.clock.stop("rank");
  const ModelChoices choices = model_choices(run.room.viewing, [&](const auto& viewing) {
    return wished(run, target, swatch_of(run, target, viewing, here));
  });
  const RankedSpread spread = ranked_spread(
      run, paints::within_windows(atlas, wish, {.windows = options.windows, .swatch = swatch}),
      rooms, options.distance, choices,
      [&](const paints::Paint& p) { return paint_name(atlas, p); });
  if (options.robust) order_robustly(ranking, spread.ranked, kept);
  run.clock.stop("model spread");
  const RankingErrors errors = seeing(
      run, [&] { return ranking_errors(ranking, wish, painted.rooms_of_longer_patches(), how); });
  run.clock.stop("mesh error");
  const Resolved resolved =
      resolve(run, painted, winners_of(ranking), {{.atlas = &atlas, .target = wish}}, options);
  run.clock.stop("resolve");
  talk_about(ranking, atlas);

  const std::vector<Shift> shifts = shifts_of(run, rooms.front(), ranking, atlas, top, swatch);
  run.record["ranking"] = describe_ranking(ranking, atlas, wish);
  if (!ranking.paints.empty()) {
    const appearance::RoomView& view = ranking.paints.front().seen.front().view;
    run.record["viewing"] = describe(view, run.room, viewed_point(run));
    run.record["viewing"]["mesh_error"] = describe(errors);
    tell_white(run, view);
  }
  run.record["ranking"]["resolved"] = resolved.record("paints");
  run.record["response"] = painted.record();
  const Json constant = most_constant(ranking, atlas, top);
  if (rooms.size() > 1) run.record["ranking"]["most_constant"] = constant;
  run.clock.stop("report");

  std::vector<OutputFile> files{
      {.path = out / "ranking.csv",
       .text = ranking_csv(ranking, atlas, wish, top, resolved.distance, errors)},
      {.path = out / "shift.csv", .text = shift_csv(shifts)}};
  if (rooms.size() > 1) {
    files.push_back(
        {.path = out / "scenarios.csv", .text = scenarios_csv(ranking, atlas, rooms, top)});
  }
  run.record["model_spread"] = describe(spread.told);
  for (OutputFile& file : model_spread_files(out, run.room.name, spread.told)) {
    files.push_back(std::move(file));
  }
  for (OutputFile& file : painted.files()) files.push_back(std::move(file));
  RunResult result = finish(run, painted.converged(), std::move(files), out);
  const auto count = std::min(static_cast<std::size_t>(top), ranking.paints.size());
  result.text = best_table(ranking, shifts, errors, count);
  if (rooms.size() > 1) result.text += constancy_text(constant);
  result.text += model_spread_text(spread.told, "the best paint");
  result.data = {{"status", result.record["status"]},
                 {"folder", out.string()},
                 {"target", result.record["ranking"]["target"]},
                 {"rejected_by_windows", ranking.rejected},
                 {"undefined", ranking.undefined},
                 {"paints", best_list(ranking, shifts, count)},
                 {"model_spread", run.record["model_spread"]}};
  if (rooms.size() > 1) result.data["most_constant"] = constant;
  return result;
}

Exit rank_room(const RankCommand& command, const Session& session) {
  return print_result(run_rank(command.rooms, command.options, command.out, session), session);
}

}  // namespace apps
