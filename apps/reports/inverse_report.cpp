#include "apps/reports/inverse_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/reports/csv.h"
#include "apps/system/terminal.h"

namespace apps {
namespace {

constexpr std::size_t kTableRows = 10;

Json describe_limit(const std::optional<paints::ColourLimit>& found) {
  if (!found) return {};
  const paints::ColourLimit& limit = *found;
  Json normal = Json::array();
  for (const auto& column : limit.normal.colwise()) {
    normal.push_back({column[0], column[1], column[2]});
  }
  return {{"proves", limit.proves()},
          {"no_stimulus", limit.no_stimulus},
          {"wished", limit.wished},
          {"bound", limit.bound},
          {"normal", normal}};
}

/// Of all lightings, by full solves.
double largest_distance(const InverseRun& inverse) {
  double largest = 0;
  for (const paints::SeenPaint& seen : inverse.seen) largest = std::max(largest, seen.distance);
  return largest;
}

std::string verdict(const InverseRun& inverse) {
  const paints::InverseColour& answer = inverse.answer;
  if (answer.exact) {
    return fmt::format("exact: full solves miss the wish by {:.1e}; roughness {:.4g}\n",
                       largest_distance(inverse), answer.roughness);
  }
  const std::string nearest = fmt::format(
      "out of reach: the nearest reflectance that was found is {:.3f} away\n", answer.distance);
  const paints::ColourLimit& limit = *answer.limit;
  if (limit.no_stimulus) {
    return nearest + "proven for an eye adapted as there: no stimulus at all looks as wished\n";
  }
  if (!limit.proves()) return nearest + "not proven: no plane was found between wish and paints\n";
  return nearest +
         fmt::format(
             "proven for an eye adapted as there: the wish lies {:.3f} beyond all paints, in "
             "X, Y, Z of a white of 100\n",
             limit.wished - limit.bound);
}

}  // namespace

Json describe(const InverseRun& inverse, const paints::Target& wish) {
  const paints::InverseColour& answer = inverse.answer;
  return {{"target", {{"J", wish.lightness}, {"a_C", wish.a_c}, {"b_C", wish.b_c}}},
          {"highest_reflectance", paints::InverseOptions{}.most},
          {"exact", answer.exact},
          {"distance", answer.distance},
          {"largest_distance_by_full_solves", largest_distance(inverse)},
          {"roughness", answer.roughness},
          {"stationarity", answer.stationarity},
          {"rounds", inverse.rounds},
          {"limit", describe_limit(answer.limit)}};
}

std::string bands_csv(const paints::InverseColour& answer) {
  CsvText csv("nm,reflectance,bound_multiplier");
  const spectra::Spectrum& rho = answer.reflectance;
  for (int k = 0; k < rho.grid.count; ++k) {
    csv.cell(rho.grid.wavelength_nm(k)).cell(rho.values[k]).cell(answer.bound_multipliers[k]);
    csv.end_row();
  }
  return csv.take();
}

std::string appearance_csv(const InverseRun& inverse, const std::vector<spectra::LitRoom>& rooms,
                           const paints::Target& wish) {
  CsvText csv(
      "lighting,J,a_C,b_C,C,h_deg,H,dJ,da_C,db_C,multiplier_J,multiplier_a_C,multiplier_b_C");
  for (std::size_t l = 0; l < rooms.size(); ++l) {
    const appearance::Correlates& k = inverse.seen[l].correlates;
    csv.cell(rooms[l].name).cell(k.lightness).cell(k.a_c).cell(k.b_c);
    csv.cell(k.chroma).cell(k.hue_deg).cell(k.hue_quadrature);
    csv.cell(k.lightness - wish.lightness).cell(k.a_c - wish.a_c).cell(k.b_c - wish.b_c);
    for (const double m : inverse.answer.multipliers.col(static_cast<Eigen::Index>(l))) csv.cell(m);
    csv.end_row();
  }
  return csv.take();
}

std::string inverse_text(const InverseRun& inverse, const std::vector<spectra::LitRoom>& rooms,
                         const paints::Ranking& ranking, const paints::Atlas& atlas) {
  std::vector<std::vector<std::string>> looks{{"lighting", "J", "a_C", "b_C", "missed by"}};
  for (std::size_t l = 0; l < rooms.size(); ++l) {
    const appearance::Correlates& k = inverse.seen[l].correlates;
    looks.push_back({rooms[l].name.empty() ? "all lights" : rooms[l].name,
                     fmt::format("{:.3f}", k.lightness), fmt::format("{:.3f}", k.a_c),
                     fmt::format("{:.3f}", k.b_c),
                     fmt::format("{:.1e}", inverse.seen[l].distance)});
  }
  std::vector<std::vector<std::string>> nearest{{"rank", "paint of the atlas", "distance"}};
  for (std::size_t i = 0; i < std::min(kTableRows, ranking.paints.size()); ++i) {
    const paints::RankedPaint& ranked = ranking.paints[i];
    nearest.push_back({fmt::format("{}", i + 1), paint_name(atlas, *ranked.paint),
                       fmt::format("{:.2f}", ranked.distance)});
  }
  return verdict(inverse) + "\n" + table("<>>>>", looks) + "\n" + table("><>", nearest);
}

}  // namespace apps
