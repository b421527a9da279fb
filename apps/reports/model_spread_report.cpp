#include "apps/reports/model_spread_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "appearance/size_effect.h"
#include "apps/reports/csv.h"
#include "apps/studies/seen.h"

namespace apps {
namespace {

std::vector<std::string> distinct_winners(const ModelSpread& spread) {
  const std::set<std::string> names(spread.winners.begin(), spread.winners.end());
  return {names.begin(), names.end()};
}

}  // namespace

std::string model_spread_csv(const ModelSpread& spread) {
  CsvText csv(
      "paint,choice,asked,white_share,background,size_effect,rank,distance,J,a_C,b_C,C,"
      "h_deg,caution");
  for (const SpreadRow& row : spread.rows) {
    for (std::size_t c = 0; c < spread.choices.all.size(); ++c) {
      const auto& [name, viewing, target] = spread.choices.all[c];
      const paints::ChoiceLook& look = row.looks[c];
      const Reported r(look.correlates);
      const bool fixed = viewing.background == spectra::Background::fixed;
      csv.cell(row.name).cell(name).cell(c == spread.choices.asked ? "yes" : "no");
      csv.cell(viewing.white_share);
      csv.cell(fixed ? fmt::format("{:g}", viewing.background_y)
                     : appearance::to_string(viewing.background));
      csv.cell(viewing.size_effect ? "on" : "off");
      csv.cell(row.ranks.empty() ? std::nullopt : std::optional<double>(row.ranks[c]));
      csv.cell(std::isfinite(look.distance) ? std::optional(look.distance) : std::nullopt);
      csv.cell(r.j).cell(r.a_c).cell(r.b_c).cell(r.c).cell(r.h_deg);
      csv.cell(viewing.size_effect ? appearance::kSizeEffectCaution : "").end_row();
    }
  }
  return csv.take();
}

std::string model_spread_text(const ModelSpread& spread, const std::string& what, std::size_t row) {
  if (row >= spread.rows.size()) return "";
  const auto [white, background, size, undefined] = spread.moves(row);
  std::string text = fmt::format(
      "\nhow to model the eye: the choice of the white moves {} by up to {:.1f}, of the background "
      "by {:.1f}, of the size effect by {:.1f} ({})",
      what, white, background, size, appearance::kSizeEffectCaution);
  if (undefined > 0) {
    text += fmt::format("; CIECAM02 does not define it under {} of {} choices", undefined,
                        spread.choices.all.size());
  }
  const std::vector<std::string> best = distinct_winners(spread);
  if (best.size() == 1) text += fmt::format("; {} is best under every choice", best.front());
  if (best.size() > 1) {
    text += fmt::format("; {} paints are best under some choice: {}", best.size(),
                        fmt::join(best, ", "));
  }
  return text + "\n";
}

Json describe(const ModelSpread& spread) {
  const auto [white, background, size, undefined] = spread.moves();
  Json json{{"white", white},
            {"background", background},
            {"size_effect", size},
            {"undefined", undefined},
            {"size_effect_caution", appearance::kSizeEffectCaution}};
  if (!spread.winners.empty()) json["best_under_some_choice"] = distinct_winners(spread);
  return json;
}

}  // namespace apps
