#include <fmt/format.h>

#include <algorithm>

#include "apps/commands/commands.h"
#include "apps/pictures/model_spread_picture.h"
#include "apps/reports/colour_reports.h"
#include "apps/reports/csv.h"
#include "apps/reports/inverse_report.h"
#include "apps/reports/model_spread_report.h"
#include "apps/studies/model_spread.h"
#include "apps/studies/paint_wish.h"
#include "apps/studies/painted_room.h"
#include "paints/atlas_file.h"

namespace apps {
namespace {

/// The wish, once per lighting.
std::vector<paints::WishInLight> wishes_in(const PaintedRoom& painted, const paints::Target& wish) {
  std::vector<paints::WishInLight> wishes;
  for (spectra::RoomResponseSlope& room : painted.slopes()) {
    wishes.push_back({.room = std::move(room), .target = wish});
  }
  return wishes;
}

/// Aims off by what the response gets wrong, until full solves meet the wish.
InverseRun aimed(const RoomRun& run, PaintedRoom& painted, const paints::Target& wish) {
  constexpr double kEnough = 1e-7;  // in J, a_C, b_C
  constexpr int kMaxRounds = 5;
  std::vector<paints::WishInLight> wishes = wishes_in(painted, wish);
  const std::vector<spectra::LitRoom> solved = painted.solved_rooms();
  InverseRun result;
  while (true) {
    result.answer = paints::inverse_colour(wishes, {.viewing = run.room.viewing});
    result.seen = paints::look(result.answer.reflectance, wish, solved, paints::Distance::jab,
                               run.room.viewing);
    double missed = 0;
    for (const paints::SeenPaint& seen : result.seen) missed = std::max(missed, seen.distance);
    ++result.rounds;
    if (!result.answer.exact || missed <= kEnough || result.rounds == kMaxRounds) return result;
    for (std::size_t l = 0; l < wishes.size(); ++l) {
      paints::Target& aim = wishes[l].target;
      aim.lightness -= result.seen[l].correlates.lightness - wish.lightness;
      aim.a_c -= result.seen[l].correlates.a_c - wish.a_c;
      aim.b_c -= result.seen[l].correlates.b_c - wish.b_c;
    }
  }
}

}  // namespace

Exit invert_room(const RankCommand& command, const Session& session) {
  const std::filesystem::path out = command.out;
  const RankOptions& options = command.options;
  RoomRun run = open_room(command.rooms, "inverse", to_json(options), session);
  require_one_group(run);
  const scenes::TargetColour& target = target_of(run);
  require_wish(run);
  require_painted_view(run);
  const scenes::PaintTask& task = run.room.paint.front();
  const paints::Atlas atlas =
      paints::load_atlas(options.atlas.empty() ? task.atlas : options.atlas, run.room.grid);
  run.clock.stop("atlas");

  PaintedRoom painted(run, options, out, highest_reflectance(atlas, target));
  const auto here = light_here(run, painted);
  const auto wish_under = [&](const spectra::ViewingChoices& viewing) {
    return wished(run, target, swatch_of(run, target, viewing, here));
  };
  const paints::Target wish = wish_under(run.room.viewing);
  const InverseRun inverse = seeing(run, [&] { return aimed(run, painted, wish); });
  run.clock.stop("inverse");
  const std::vector<spectra::LitRoom> rooms = painted.rooms();
  const int top = options.top > 0 ? options.top : task.top;
  const paints::RankingOptions how{.distance = options.distance,
                                   .viewing = run.room.viewing,
                                   .judgement = run.room.judgement,
                                   .top = static_cast<std::size_t>(top)};
  const paints::Ranking ranking =
      seeing(run, [&] { return paints::rank(atlas, wish, rooms, how); });
  const RankingErrors errors = seeing(
      run, [&] { return ranking_errors(ranking, wish, painted.rooms_of_longer_patches(), how); });
  run.clock.stop("rank");
  const ModelChoices choices = model_choices(run.room.viewing, wish_under);
  RankedSpread spread =
      ranked_spread(run, paints::within_windows(atlas, wish, {}), rooms, options.distance, choices,
                    [&](const paints::Paint& p) { return paint_name(atlas, p); });
  spread.told.rows.insert(
      spread.told.rows.begin(),
      spread_row(run, "inverse", inverse.answer.reflectance, rooms, choices, options.distance));
  run.clock.stop("model spread");

  run.record["model_spread"] = describe(spread.told);
  run.record["inverse"] = describe(inverse, wish);
  const appearance::RoomView& view = inverse.seen.front().view;
  run.record["viewing"] = describe(view, run.room, viewed_point(run));
  tell_white(run, view);
  run.record["response"] = painted.record();
  std::vector<OutputFile> files{
      {.path = out / "reflectance.csv",
       .text = reflectances_csv({{"inverse", inverse.answer.reflectance}})},
      {.path = out / "inverse.csv", .text = bands_csv(inverse.answer)},
      {.path = out / "appearance.csv", .text = appearance_csv(inverse, rooms, wish)},
      {.path = out / "ranking.csv", .text = ranking_csv(ranking, atlas, wish, top, {}, errors)}};
  for (OutputFile& file : model_spread_files(out, run.room.name, spread.told)) {
    files.push_back(std::move(file));
  }
  for (OutputFile& file : painted.files()) files.push_back(std::move(file));
  RunResult result = finish(run, painted.converged(), std::move(files), out);
  result.text = inverse_text(inverse, rooms, ranking, atlas) +
                model_spread_text(spread.told, "the look of this reflectance");
  result.data = result.record["inverse"];
  result.data["status"] = result.record["status"];
  result.data["folder"] = out.string();
  result.data["model_spread"] = run.record["model_spread"];
  return print_result(result, session);
}

}  // namespace apps
