#include "apps/studies/model_spread.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace apps {
namespace {

constexpr double kHalf = 0.5, kFixedY = 20;
constexpr int kListed = 10;

bool same(const spectra::ViewingChoices& p, const spectra::ViewingChoices& q) {
  const bool fixed = p.background == spectra::Background::fixed;
  return p.white_share == q.white_share && p.background == q.background &&
         (!fixed || p.background_y == q.background_y) && p.size_effect == q.size_effect;
}

std::string name_of(const spectra::ViewingChoices& choices) {
  const std::string background = choices.background == spectra::Background::fixed
                                     ? fmt::format("Y_b {:g}", choices.background_y)
                                     : "Y_b " + appearance::to_string(choices.background);
  return fmt::format("white {:g}, {}, size {}", choices.white_share, background,
                     choices.size_effect ? "on" : "off");
}

double between(const paints::ChoiceLook& p, const paints::ChoiceLook& q) {
  const appearance::Correlates &a = p.correlates, &b = q.correlates;
  if (!a.status.all_defined() || !b.status.all_defined()) return 0;
  return std::hypot(a.lightness - b.lightness, a.a_c - b.a_c, a.b_c - b.b_c);
}

paints::SpreadOptions options_of(const RoomRun& run, const ModelChoices& choices,
                                 paints::Distance distance) {
  return {.choices = choices.all, .distance = distance, .judgement = run.room.judgement};
}

}  // namespace

std::size_t ModelChoices::at(bool half_white, bool fixed_background, bool size_effect) {
  return (half_white ? 4U : 0U) + (fixed_background ? 2U : 0U) + (size_effect ? 1U : 0U);
}

ModelChoices model_choices(const spectra::ViewingChoices& asked, const WishUnder& wish) {
  ModelChoices choices{.all = {}, .asked = kStatedChoices};
  const auto add = [&](const spectra::ViewingChoices& viewing) {
    choices.all.push_back({.name = name_of(viewing), .viewing = viewing, .target = wish(viewing)});
  };
  for (std::size_t k = 0; k < kStatedChoices; ++k) {
    spectra::ViewingChoices viewing = asked;
    viewing.white_share = (k & 4U) != 0 ? kHalf : 1;
    viewing.background = (k & 2U) != 0 ? spectra::Background::fixed : spectra::Background::ring;
    viewing.background_y = kFixedY;
    viewing.size_effect = (k & 1U) != 0;
    if (same(viewing, asked)) choices.asked = k;
    add(viewing);
  }
  if (choices.asked == kStatedChoices) add(asked);
  return choices;
}

ModelSpread::Moves ModelSpread::moves(std::size_t row) const {
  Moves found;
  if (row >= rows.size()) return found;
  const std::vector<paints::ChoiceLook>& looks = rows[row].looks;
  found.undefined = static_cast<int>(std::ranges::count_if(
      looks, [](const auto& look) { return !look.correlates.status.all_defined(); }));
  for (const bool p : {false, true}) {
    for (const bool q : {false, true}) {
      const auto moved = [&](std::size_t from, std::size_t to, double& largest) {
        largest = std::max(largest, between(looks[from], looks[to]));
      };
      moved(ModelChoices::at(false, p, q), ModelChoices::at(true, p, q), found.white);
      moved(ModelChoices::at(p, false, q), ModelChoices::at(p, true, q), found.background);
      moved(ModelChoices::at(p, q, false), ModelChoices::at(p, q, true), found.size);
    }
  }
  return found;
}

SpreadRow spread_row(const RoomRun& run, const std::string& name,
                     const spectra::Spectrum& reflectance,
                     const std::vector<spectra::LitRoom>& rooms, const ModelChoices& choices,
                     paints::Distance distance) {
  return {.name = name,
          .looks = paints::looks_of(reflectance, rooms, options_of(run, choices, distance)),
          .ranks = {}};
}

RankedSpread ranked_spread(const RoomRun& run, const std::vector<const paints::Paint*>& candidates,
                           const std::vector<spectra::LitRoom>& rooms, paints::Distance distance,
                           const ModelChoices& choices,
                           const std::function<std::string(const paints::Paint&)>& name) {
  RankedSpread spread{
      .ranked = paints::spread_of(candidates, rooms, options_of(run, choices, distance)),
      .told = {.choices = choices, .rows = {}, .winners = {}}};
  std::vector<std::vector<int>> ranks;  // per choice
  for (std::size_t c = 0; c < choices.all.size(); ++c) {
    ranks.push_back(paints::ranks_under(spread.ranked, c));
  }
  std::vector<std::size_t> listed;
  for (std::size_t p = 0; p < candidates.size(); ++p) {
    const bool best = std::ranges::any_of(ranks, [&](const auto& r) { return r[p] == 1; });
    if (best || ranks[choices.asked][p] <= kListed) listed.push_back(p);
  }
  std::ranges::sort(listed, {}, [&](std::size_t p) { return ranks[choices.asked][p]; });
  for (const std::size_t p : listed) {
    SpreadRow& row = spread.told.rows.emplace_back();
    row.name = name(*candidates[p]);
    row.looks = spread.ranked[p].looks;
    for (const auto& r : ranks) row.ranks.push_back(r[p]);
  }
  for (std::size_t c = 0; c < choices.all.size(); ++c) {
    const auto best = std::ranges::find_if(spread.told.rows, [&](const SpreadRow& row) {
      return row.ranks[c] == 1 && std::isfinite(row.looks[c].distance);
    });
    if (best != spread.told.rows.end()) spread.told.winners.push_back(best->name);
  }
  return spread;
}

void order_robustly(paints::Ranking& ranking, const std::vector<paints::SpreadPaint>& spread,
                    std::size_t top) {
  std::map<const paints::Paint*, double> largest;
  for (const paints::SpreadPaint& p : spread) largest[p.paint] = p.largest_distance();
  std::ranges::stable_sort(ranking.paints, {},
                           [&](const paints::RankedPaint& p) { return largest.at(p.paint); });
  ranking.paints.resize(std::min(ranking.paints.size(), top));
}

}  // namespace apps
