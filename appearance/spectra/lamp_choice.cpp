#include "appearance/spectra/lamp_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "appearance/spectra/compiled_tables.h"
#include "appearance/spectra/spectrum_library.h"

namespace spectra {

const std::vector<LampFacts>& lamp_facts() {
  static const std::vector<LampFacts> facts = [] {
    std::vector<LampFacts> all;
    const std::vector<NamedSpectrum>& measured = lamps("houser").entries;
    for (const CsvRow& row : compiled_table(CompiledTable::lamp_metrics).rows) {
      const auto number = [&](std::size_t column) { return compiled_number(row.cells.at(column)); };
      all.push_back({.name = row.cells[0],
                     .label = measured.at(all.size()).label,
                     .kind = row.cells[1],
                     .cct_K = number(2),
                     .duv = number(3),
                     .ra = number(4),
                     .r9 = number(5),
                     .rf = number(6),
                     .rg = number(7)});
    }
    return all;
  }();
  return facts;
}

const std::vector<std::string>& lamp_kinds() {
  static const std::vector<std::string> kinds{
      "LED", "fluorescent", "halogen", "incandescent", "metal halide", "sodium", "mercury"};
  return kinds;
}

double distance_from(const LampFacts& lamp, const LampBox& box) {
  const double r9 = box.r9 ? (lamp.r9 - *box.r9) / 10 : 0;
  return std::sqrt(std::pow((lamp.cct_K - box.cct_K) / 50, 2) + std::pow(lamp.ra - box.ra, 2) +
                   std::pow(lamp.duv / 0.002, 2) + r9 * r9);
}

std::vector<LampMatch> lamps_like(const LampBox& box) {
  std::vector<LampMatch> matches;
  for (const LampFacts& lamp : lamp_facts()) {
    if (box.kind.empty() ? lamp.kind == "model" : lamp.kind != box.kind) continue;
    matches.push_back({&lamp, distance_from(lamp, box)});
  }
  std::ranges::stable_sort(matches, {}, &LampMatch::distance);
  return matches;
}

bool stands_for(const LampFacts& lamp, const LampBox& box) {
  constexpr double kTemperature = 0.06, kRaBelow = 3, kRaAbove = 10, kR9Below = 30;
  return std::abs(lamp.cct_K / box.cct_K - 1) <= kTemperature && lamp.ra >= box.ra - kRaBelow &&
         lamp.ra <= box.ra + kRaAbove && (!box.r9 || lamp.r9 >= *box.r9 - kR9Below);
}

std::string in_words(const LampFacts& lamp) {
  return fmt::format("{:.0f} K, Duv {:.4f}, Ra {:.0f}, R9 {:.0f}", lamp.cct_K, lamp.duv, lamp.ra,
                     lamp.r9);
}

}  // namespace spectra
