#include "apps/commands/scheme.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/pictures/model_spread_picture.h"
#include "apps/reports/colour_reports.h"
#include "apps/reports/csv.h"
#include "apps/reports/model_spread_report.h"
#include "apps/studies/model_spread.h"
#include "apps/studies/paint_wish.h"
#include "apps/studies/painted_room.h"
#include "apps/studies/resolve.h"
#include "apps/studies/scheme_search.h"
#include "apps/system/terminal.h"
#include "paints/scheme.h"

namespace apps {
namespace {

constexpr std::size_t kTableRows = 10;

std::string guarantee(const paints::SchemeRanking& ranking) {
  if (ranking.exhaustive) return fmt::format("all {} schemes were compared", ranking.combinations);
  return fmt::format(
      "of {} schemes, none that differs from the best in {} of its paints is nearer; nothing is "
      "known of the others",
      ranking.combinations, ranking.differing == 1 ? "one" : "one or two");
}

std::string schemes_csv(const RoomRun& run, const SchemeGroups& groups,
                        const paints::SchemeRanking& ranking, const std::vector<double>& solved) {
  CsvText csv;
  csv.cell("rank").cell("distance");
  for (const scenes::PaintTask& group : run.room.paint) {
    for (const char* what : {"paint", "distance", "J", "a_C", "b_C", "C", "h_deg", "H"}) {
      csv.cell(fmt::format("{} {}", group.name, what));
    }
  }
  csv.cell("distance_solved").end_row();
  for (std::size_t i = 0; i < ranking.schemes.size(); ++i) {
    const paints::Scheme& scheme = ranking.schemes[i];
    csv.cell(static_cast<int>(i) + 1).cell(scheme.distance);
    for (std::size_t g = 0; g < scheme.paints.size(); ++g) {
      const paints::SeenPaint& seen = scheme.seen[g].front();
      const appearance::Correlates& k = seen.correlates;
      csv.cell(paint_name(groups.atlases[g], *scheme.paints[g])).cell(seen.distance);
      csv.cell(k.lightness).cell(k.a_c).cell(k.b_c).cell(k.chroma).cell(k.hue_deg);
      csv.cell(k.hue_quadrature);
    }
    csv.cell(i < solved.size() ? std::optional(solved[i]) : std::nullopt).end_row();
  }
  return csv.take();
}

std::vector<Winner> winners_of(const paints::SchemeRanking& ranking) {
  std::vector<Winner> winners;
  for (const paints::Scheme& scheme : ranking.schemes) {
    winners.push_back({.distance = scheme.distance});
    for (const paints::Paint* paint : scheme.paints) {
      winners.back().paints.push_back(paint->reflectance);
    }
  }
  return winners;
}

std::string best_table(const RoomRun& run, const SchemeGroups& groups,
                       const paints::SchemeRanking& ranking) {
  std::vector<std::vector<std::string>> rows{{"rank", "distance"}};
  std::string alignment = "<>";
  for (const scenes::PaintTask& group : run.room.paint) {
    rows.front().push_back(group.name);
    rows.front().push_back("its distance");
    alignment += "<>";
  }
  for (std::size_t i = 0; i < std::min(kTableRows, ranking.schemes.size()); ++i) {
    const paints::Scheme& scheme = ranking.schemes[i];
    rows.push_back({fmt::format("{}", i + 1), fmt::format("{:.2f}", scheme.distance)});
    for (std::size_t g = 0; g < scheme.paints.size(); ++g) {
      rows.back().push_back(paint_name(groups.atlases[g], *scheme.paints[g]));
      rows.back().push_back(fmt::format("{:.2f}", scheme.seen[g].front().distance));
    }
  }
  return table(alignment, rows);
}

std::vector<Shift> shifts_of(const RoomRun& run, const SchemeGroups& groups,
                             const paints::Scheme& scheme) {
  std::vector<Shift> shifts;
  for (std::size_t g = 0; g < scheme.paints.size(); ++g) {
    const paints::SeenPaint& seen = scheme.seen[g].front();
    shifts.push_back({.paint = paint_name(groups.atlases[g], *scheme.paints[g]),
                      .surface = surface_name(run, viewed_point(run, g)),
                      .reconstructed = groups.atlases[g].reconstructed,
                      .swatch = seen_on_swatch(scheme.paints[g]->reflectance, groups.swatches[g]),
                      .room = {seen.view.sample, seen.correlates}});
  }
  return shifts;
}

/// The paints of the best scheme under every choice of the model, each group as its own viewer sees
/// it.
ModelSpread spread_of(const RoomRun& run, const PaintedRoom& painted, const SchemeGroups& groups,
                      const paints::SchemeRanking& ranking, paints::Distance distance,
                      const std::vector<std::optional<spectra::ViewedLight>>& here) {
  ModelSpread spread;
  if (ranking.schemes.empty()) return spread;
  const std::vector<const paints::Paint*>& best = ranking.schemes.front().paints;
  std::vector<spectra::Spectrum> paints;
  for (const paints::Paint* paint : best) paints.push_back(paint->reflectance);
  for (std::size_t g = 0; g < best.size(); ++g) {
    spread.choices = model_choices(run.room.viewing, [&](const auto& viewing) {
      const scenes::TargetColour& target = target_of(run, g);
      return wished(run, target, swatch_of(run, target, viewing, here[g]), g);
    });
    const int group = static_cast<int>(g);
    spread.rows.push_back(spread_row(run, paint_name(groups.atlases[g], *best[g]), paints[g],
                                     painted.rooms(group, group, paints), spread.choices,
                                     distance));
  }
  return spread;
}

Json scheme_list(const SchemeGroups& groups, const paints::SchemeRanking& ranking) {
  Json list = Json::array();
  for (const paints::Scheme& scheme : ranking.schemes) {
    Json paints = Json::array();
    for (std::size_t g = 0; g < scheme.paints.size(); ++g) {
      paints.push_back(paint_name(groups.atlases[g], *scheme.paints[g]));
    }
    list.push_back({{"rank", list.size() + 1}, {"distance", scheme.distance}, {"paints", paints}});
  }
  return list;
}

}  // namespace

RunResult rank_schemes(RoomRun& run, const RankOptions& options, const std::filesystem::path& out) {
  const auto& [lightness, chroma, hue_deg] = options.windows;
  if (lightness || chroma || hue_deg) {
    throw room_fault(run, "/paint", "names several groups, and windows are for one",
                     "leave out --max-dJ, --max-dC and --max-dh");
  }
  if (options.robust) {
    throw room_fault(run, "/paint", "names several groups, and --robust is for one",
                     "leave out --robust");
  }
  SchemeGroups groups = scheme_groups(run, options.atlas);
  run.clock.stop("atlas");
  PaintedRoom painted(run, options, out, groups.highest_reflectance);
  const auto here = set_targets(run, painted, groups);
  const int top = options.top > 0 ? options.top : run.room.paint.front().top;
  const paints::SchemeRanking ranking =
      search_schemes(run, painted, groups, options.distance, static_cast<std::size_t>(top));
  run.clock.stop("rank");
  const Resolved resolved = resolve(run, painted, winners_of(ranking), groups.groups, options);
  run.clock.stop("resolve");

  run.record["response"] = painted.record();
  run.record["schemes"] = {{"combinations", ranking.combinations},
                           {"exhaustive", ranking.exhaustive},
                           {"guarantee", guarantee(ranking)},
                           {"resolved", resolved.record("schemes")}};
  const ModelSpread spread = spread_of(run, painted, groups, ranking, options.distance, here);
  run.clock.stop("model spread");
  std::vector<OutputFile> files{
      {.path = out / "schemes.csv", .text = schemes_csv(run, groups, ranking, resolved.distance)}};
  if (!ranking.schemes.empty()) {
    files.push_back({.path = out / "shift.csv",
                     .text = shift_csv(shifts_of(run, groups, ranking.schemes.front()))});
    run.record["model_spread"] = describe(spread);
    for (OutputFile& file : model_spread_files(out, run.room.name, spread)) {
      files.push_back(std::move(file));
    }
  }
  for (OutputFile& file : painted.files()) files.push_back(std::move(file));
  RunResult result = finish(run, painted.converged(), std::move(files), out);
  result.text = best_table(run, groups, ranking) + guarantee(ranking) + "\n";
  for (std::size_t g = 0; g < spread.rows.size(); ++g) {
    result.text += model_spread_text(spread, "\"" + run.room.paint[g].name + "\"", g);
  }
  result.data = {{"status", result.record["status"]},
                 {"folder", out.string()},
                 {"guarantee", guarantee(ranking)},
                 {"schemes", scheme_list(groups, ranking)}};
  return result;
}

}  // namespace apps
