#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "apps/commands/commands.h"
#include "apps/reports/colour_reports.h"
#include "apps/reports/csv.h"
#include "apps/studies/paint_wish.h"
#include "apps/studies/painted_room.h"
#include "apps/system/terminal.h"
#include "paints/base_file.h"
#include "paints/recipes.h"

namespace apps {
namespace {

constexpr std::size_t kTableRows = 10;
constexpr double kWhole = 100;  // parts of a recipe

/// What the recipes are made of, looked for and compared with.
struct Mixing {
  paints::Ingredients ingredients;
  paints::Target wish;
  paints::Ranking single;  ///< the paints as they come
  paints::Recipes found;

  [[nodiscard]] double best_single() const { return single.paints.front().distance; }
};

std::string base_name(const Mixing& mixing, int base) {
  const auto& bases = mixing.ingredients.set.bases;
  return paint_name(mixing.ingredients.atlas,
                    {.name = bases[static_cast<std::size_t>(base)].name, .reflectance = {}});
}

std::string recipe_name(std::size_t place) { return fmt::format("recipe {}", place + 1); }

/// Every pair of bases is looked at, about 9 us of a core each.
void require_few(const std::string& atlas, const paints::Ingredients& all,
                 const MixOptions& options) {
  constexpr std::size_t kMost = 5000;
  constexpr double kPairSeconds = 9e-6;
  const std::size_t n = all.set.bases.size();
  if (n <= kMost || options.bases < 2) return;
  const auto pairs = static_cast<double>(n) * static_cast<double>(n - 1) / 2;
  throw spectra::InputError(
      {{atlas, 0, 0, "",
        fmt::format("{} paints make {:.0f} pairs, about {:.0f} minutes of one core", n, pairs,
                    pairs * kPairSeconds / 60),
        fmt::format("give at most {}, or take --bases 1", kMost)}});
}

paints::Ingredients ingredients_of(const RoomRun& run, const MixOptions& options) {
  const std::string& atlas =
      options.rank.atlas.empty() ? run.room.paint.front().atlas : options.rank.atlas;
  paints::Ingredients all = paints::load_ingredients(atlas, options.surface, run.room.grid);
  require_few(atlas, all, options);
  if (all.set.bases.empty()) {
    throw room_fault(run, "/paint/atlas", "holds no paint that could be mixed",
                     "choose another atlas, or a smaller k1 for --saunderson");
  }
  if (!all.set.left_out.empty()) {
    report_notes({fmt::format("{} paints are too dark in some band to be mixed: {}",
                              all.set.left_out.size(), fmt::join(all.set.left_out, ", "))});
  }
  return all;
}

/// @throws spectra::InputError  if the room leaves the viewer without light
void search(Mixing& mixing, const RoomRun& run, const PaintedRoom& painted, std::size_t count,
            const MixOptions& options, int threads) {
  seeing(run, [&] {
    mixing.single = paints::rank(mixing.ingredients.atlas, mixing.wish, {painted.rooms().front()},
                                 {.viewing = run.room.viewing});
    mixing.found = paints::find_recipes(
        mixing.ingredients.set, mixing.wish, painted.slopes().front(),
        {.bases = options.bases,
         .units = options.step > 0 ? static_cast<int>(std::lround(kWhole / options.step)) : 0,
         .count = count,
         .viewing = run.room.viewing,
         .threads = threads});
  });
  if (mixing.single.paints.empty() || mixing.found.recipes.empty()) {
    throw room_fault(run, "/paint/atlas", "holds no paint whose appearance CIECAM02 defines here",
                     "choose another atlas");
  }
}

std::string recipes_csv(const Mixing& mixing) {
  CsvText csv(
      "rank,recipe,bases,distance,gain,J,a_C,b_C,C,h_deg,H,dJ,da_C,db_C,x,y,base_1,parts_1,base_2,"
      "parts_2,base_3,parts_3,base_4,parts_4,hue_composition,status");
  const paints::Target& wish = mixing.wish;
  for (std::size_t i = 0; i < mixing.found.recipes.size(); ++i) {
    const paints::Recipe& recipe = mixing.found.recipes[i];
    const appearance::Correlates& k = recipe.correlates;
    const auto [x, y] = spectra::chromaticity(recipe.view.sample);
    csv.cell(static_cast<int>(i + 1)).cell(recipe_name(i));
    csv.cell(static_cast<int>(recipe.bases.size()));
    csv.cell(recipe.distance).cell(mixing.best_single() - recipe.distance);
    csv.cell(k.lightness).cell(k.a_c).cell(k.b_c);
    csv.cell(k.chroma).cell(k.hue_deg).cell(k.hue_quadrature);
    csv.cell(k.lightness - wish.lightness).cell(k.a_c - wish.a_c).cell(k.b_c - wish.b_c);
    csv.cell(x).cell(y);
    for (std::size_t b = 0; b < 4; ++b) {
      const bool used = b < recipe.bases.size();
      csv.cell(used ? base_name(mixing, recipe.bases[b]) : "");
      csv.cell(used ? std::optional(kWhole * recipe.parts[static_cast<Eigen::Index>(b)])
                    : std::nullopt);
    }
    csv.cell(appearance::hue_composition(k.hue_quadrature));
    csv.cell(appearance::to_string(k.status)).end_row();
  }
  return csv.take();
}

/// An atlas of the mixtures.
std::string mixtures_csv(const Mixing& mixing) {
  std::vector<std::pair<std::string, spectra::Spectrum>> mixtures;
  for (std::size_t i = 0; i < mixing.found.recipes.size(); ++i) {
    mixtures.emplace_back(recipe_name(i), mixing.found.recipes[i].reflectance);
  }
  return reflectances_csv(mixtures);
}

std::string formula(const Mixing& mixing, const paints::Recipe& recipe) {
  std::string text;
  for (std::size_t b = 0; b < recipe.bases.size(); ++b) {
    text += fmt::format("{}{:.4g} {}", b > 0 ? " + " : "",
                        kWhole * recipe.parts[static_cast<Eigen::Index>(b)],
                        base_name(mixing, recipe.bases[b]));
  }
  return text;
}

std::string recipes_table(const Mixing& mixing) {
  std::vector<std::vector<std::string>> rows{
      {"rank", "parts of 100", "distance", "gain", "J", "a_C", "b_C"}};
  const auto& recipes = mixing.found.recipes;
  for (std::size_t i = 0; i < std::min(kTableRows, recipes.size()); ++i) {
    const appearance::Correlates& k = recipes[i].correlates;
    rows.push_back({fmt::format("{}", i + 1), formula(mixing, recipes[i]),
                    fmt::format("{:.3f}", recipes[i].distance),
                    fmt::format("{:.3f}", mixing.best_single() - recipes[i].distance),
                    fmt::format("{:.1f}", k.lightness), fmt::format("{:.1f}", k.a_c),
                    fmt::format("{:.1f}", k.b_c)});
  }
  const paints::RankedPaint& single = mixing.single.paints.front();
  return table("><>>>>>", rows) + fmt::format("best single paint: {}, distance {:.3f}\n",
                                              paint_name(mixing.ingredients.atlas, *single.paint),
                                              single.distance);
}

Json recipe_list(const Mixing& mixing) {
  Json list = Json::array();
  for (std::size_t i = 0; i < mixing.found.recipes.size(); ++i) {
    const paints::Recipe& recipe = mixing.found.recipes[i];
    Json parts = Json::array();
    for (std::size_t b = 0; b < recipe.bases.size(); ++b) {
      parts.push_back({{"paint", base_name(mixing, recipe.bases[b])},
                       {"parts", kWhole * recipe.parts[static_cast<Eigen::Index>(b)]}});
    }
    list.push_back({{"rank", i + 1},
                    {"distance", recipe.distance},
                    {"gain", mixing.best_single() - recipe.distance},
                    {"J", recipe.correlates.lightness},
                    {"a_C", recipe.correlates.a_c},
                    {"b_C", recipe.correlates.b_c},
                    {"parts", parts}});
  }
  return list;
}

Json describe_mixing(const Mixing& mixing, const MixOptions& options) {
  const paints::Ingredients& all = mixing.ingredients;
  const paints::RecipeSearch& search = mixing.found.search;
  const paints::RankedPaint& single = mixing.single.paints.front();
  const paints::Recipe& best = mixing.found.recipes.front();
  return {{"atlas",
           {{"name", all.atlas.name},
            {"source", all.atlas.source},
            {"bases", all.set.bases.size()},
            {"left_out", all.set.left_out},
            {"reconstructed", all.atlas.reconstructed}}},
          {"theory", all.two_constant ? "two-constant" : "single-constant"},
          {"k1", options.surface.k1},
          {"k2", options.surface.k2},
          {"target",
           {{"J", mixing.wish.lightness}, {"a_C", mixing.wish.a_c}, {"b_C", mixing.wish.b_c}}},
          {"best_single",
           {{"paint", paint_name(all.atlas, *single.paint)}, {"distance", single.distance}}},
          {"best", {{"parts", formula(mixing, best)}, {"distance", best.distance}}},
          {"search",
           {{"pairs", search.pairs},
            {"triples", search.triples},
            {"triples_examined", search.triples_examined},
            {"pieces_cut", search.pieces_cut},
            {"unresolved", search.unresolved},
            {"global_triples", search.global_triples},
            {"tolerance", search.tolerance}}}};
}

/// The best recipe by a full solve: what the response got wrong about it.
void check_best(RoomRun& run, PaintedRoom& painted, const Mixing& mixing) {
  const paints::Recipe& best = mixing.found.recipes.front();
  const solver::RoomSolution solution = painted.solve({best.reflectance});
  const Seen seen = seen_in_room(view_of(run, solution));
  const appearance::Correlates &p = seen.correlates, &q = best.correlates;
  run.record["mixing"]["best"]["differs_from_full_solve"] =
      std::hypot(p.lightness - q.lightness, p.a_c - q.a_c, p.b_c - q.b_c);
  run.record["solution"] = describe(solution, run.room);
  run.record["viewing"] = describe(best.view, run.room, viewed_point(run));
  tell_white(run, best.view);
}

}  // namespace

Exit mix_room(const MixCommand& command, const Session& session) {
  const MixOptions& options = command.options;
  const std::filesystem::path out = command.out;
  RoomRun run = open_room(command.room, "mix", to_json(options), session);
  require_one_group(run);
  const scenes::TargetColour& target = target_of(run);
  Mixing mixing{.ingredients = ingredients_of(run, options), .wish = {}};
  require_wish(run);
  run.clock.stop("atlas");
  require_painted_view(run);

  PaintedRoom painted(run, options.rank, out,
                      highest_reflectance(mixing.ingredients.atlas, target));
  if (!run.room.scenarios.empty()) {
    report_notes(
        {fmt::format("mixing for the first lighting, \"{}\"", painted.lightings().front().name)});
  }
  mixing.wish =
      wished(run, target, swatch_of(run, target, run.room.viewing, light_here(run, painted)));
  const int top = options.rank.top > 0 ? options.rank.top : run.room.paint.front().top;
  search(mixing, run, painted, static_cast<std::size_t>(top), options, thread_count(session));
  run.clock.stop("mix");
  run.record["mixing"] = describe_mixing(mixing, options);
  check_best(run, painted, mixing);
  run.record["response"] = painted.record();
  run.clock.stop("check");

  std::vector<OutputFile> files{{.path = out / "recipes.csv", .text = recipes_csv(mixing)},
                                {.path = out / "mixtures.csv", .text = mixtures_csv(mixing)}};
  for (OutputFile& file : painted.files()) files.push_back(std::move(file));
  RunResult result = finish(run, painted.converged(), std::move(files), out);
  result.text = recipes_table(mixing);
  result.data = {{"status", result.record["status"]},
                 {"folder", out.string()},
                 {"target", result.record["mixing"]["target"]},
                 {"best_single", result.record["mixing"]["best_single"]},
                 {"recipes", recipe_list(mixing)}};
  return print_result(result, session);
}

}  // namespace apps
