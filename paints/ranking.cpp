#include "paints/ranking.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "appearance/cam02_ucs.h"

namespace paints {

using appearance::Correlates;

namespace {

constexpr double kGreyChroma = 5;  // below it a hue angle says little

double chroma_of(const Target& t) { return std::hypot(t.a_c, t.b_c); }

double hue_deg_of(const Target& t) { return std::atan2(t.b_c, t.a_c) * 180 / std::numbers::pi; }

/// Within 0..180.
double hue_difference_deg(double p, double q) { return std::abs(std::remainder(p - q, 360)); }

void require_window(const std::optional<double>& window, const char* name) {
  if (window && !(*window > 0 && std::isfinite(*window))) {
    throw std::invalid_argument(
        fmt::format("window of {} is {}; want a positive number", name, *window));
  }
}

void require_sound(const Target& target, const Windows& windows) {
  if (!std::isfinite(target.lightness + target.a_c + target.b_c + target.colourfulness)) {
    throw std::invalid_argument(fmt::format("target J {} a_C {} b_C {} M {}; want numbers",
                                            target.lightness, target.a_c, target.b_c,
                                            target.colourfulness));
  }
  require_window(windows.lightness, "lightness");
  require_window(windows.chroma, "chroma");
  require_window(windows.hue_deg, "hue");
}

bool within(const Windows& windows, const Correlates& swatch, const Target& target) {
  const auto passes = [](const std::optional<double>& window, double difference) {
    return !window || std::abs(difference) <= *window;
  };
  const double chroma = chroma_of(target);
  const bool grey = std::min(chroma, swatch.chroma) < kGreyChroma;
  return passes(windows.lightness, swatch.lightness - target.lightness) &&
         passes(windows.chroma, swatch.chroma - chroma) &&
         (grey || passes(windows.hue_deg, hue_difference_deg(swatch.hue_deg, hue_deg_of(target))));
}

bool rejected(const Paint& paint, const RankingOptions& options, const Target& target) {
  const Windows& windows = options.windows;
  if (!windows.lightness && !windows.chroma && !windows.hue_deg) return false;
  const Correlates swatch = appearance::on_swatch(paint.reflectance, options.swatch).correlates;
  return swatch.status.all_defined() && !within(windows, swatch, target);
}

/// Largest difference between a paint's looks in two lightings.
double inconstancy(Distance kind, const std::vector<SeenPaint>& seen) {
  double largest = 0;
  for (std::size_t p = 0; p < seen.size(); ++p) {
    if (!seen[p].correlates.status.all_defined()) continue;
    const Target look = target_of(seen[p].correlates);
    for (std::size_t q = 0; q < p; ++q) {
      largest = std::max(largest, distance(kind, seen[q].correlates, look));
    }
  }
  return largest;
}

bool defined(const std::vector<SeenPaint>& seen) {
  return std::ranges::all_of(seen,
                             [](const SeenPaint& s) { return s.correlates.status.all_defined(); });
}

/// Sorts, and forgets what is not among the best.
void keep_best(std::vector<RankedPaint>& paints, std::size_t top) {
  std::ranges::stable_sort(paints, {}, &RankedPaint::distance);
  if (paints.size() > top) paints.resize(top);
}

}  // namespace

double distance(Distance kind, const Correlates& seen, const Target& target) {
  if (kind == Distance::jab) {
    return std::hypot(seen.lightness - target.lightness, seen.a_c - target.a_c,
                      seen.b_c - target.b_c);
  }
  return appearance::ucs_distance(
      appearance::cam02_ucs({seen.lightness, seen.colourfulness, seen.hue_deg}),
      appearance::cam02_ucs({target.lightness, target.colourfulness, hue_deg_of(target)}));
}

double judged(spectra::Judgement judgement, const std::vector<double>& distances,
              const std::vector<spectra::LitRoom>& rooms) {
  if (judgement == spectra::Judgement::worst) return *std::ranges::max_element(distances);
  double sum = 0, weights = 0;
  for (std::size_t k = 0; k < rooms.size(); ++k) {
    sum += rooms[k].weight * distances[k];
    weights += rooms[k].weight;
  }
  return sum / weights;
}

Target target_of(const Correlates& p) {
  if (!p.status.all_defined()) {
    throw std::domain_error(
        fmt::format("CIECAM02 does not define the target's appearance: {}", to_string(p.status)));
  }
  return {.lightness = p.lightness, .a_c = p.a_c, .b_c = p.b_c, .colourfulness = p.colourfulness};
}

Target target_of(const appearance::LightnessChromaHue& wished) {
  const auto& [lightness, chroma, hue_deg] = wished;
  if (!(lightness >= 0 && chroma >= 0 && std::isfinite(lightness + chroma + hue_deg))) {
    throw std::domain_error(fmt::format("target J {} C {} h {}; want numbers, J and C from 0 up",
                                        lightness, chroma, hue_deg));
  }
  const double h = hue_deg * std::numbers::pi / 180;
  return {.lightness = lightness,
          .a_c = chroma * std::cos(h),
          .b_c = chroma * std::sin(h),
          .colourfulness = chroma * appearance::standard_adaptation().f_l_4th};
}

std::string to_string(Distance distance) { return distance == Distance::jab ? "jab" : "cam02-ucs"; }

double judged(spectra::Judgement judgement, const std::vector<SeenPaint>& seen,
              const std::vector<spectra::LitRoom>& rooms) {
  if (seen.size() == 1) return seen.front().distance;
  std::vector<double> distances;
  for (const SeenPaint& s : seen) distances.push_back(s.distance);
  return judged(judgement, distances, rooms);
}

SeenPaint look(const spectra::Spectrum& reflectance, const Target& target,
               const spectra::LitRoom& room, Distance kind,
               const spectra::ViewingChoices& viewing) {
  SeenPaint seen{.view = appearance::view_of_room(room.view(reflectance), viewing)};
  seen.correlates = appearance::seen(seen.view);
  seen.distance = distance(kind, seen.correlates, target);
  seen.chromaticity = spectra::chromaticity(seen.view.sample);
  return seen;
}

std::vector<SeenPaint> look(const spectra::Spectrum& reflectance, const Target& target,
                            const std::vector<spectra::LitRoom>& rooms, Distance kind,
                            const spectra::ViewingChoices& viewing) {
  std::vector<SeenPaint> all;
  for (const spectra::LitRoom& room : rooms) {
    all.push_back(look(reflectance, target, room, kind, viewing));
  }
  return all;
}

std::vector<const Paint*> within_windows(const Atlas& atlas, const Target& target,
                                         const RankingOptions& options) {
  std::vector<const Paint*> paints;
  for (const Paint& paint : atlas.paints) {
    if (!rejected(paint, options, target)) paints.push_back(&paint);
  }
  return paints;
}

Ranking rank(const Atlas& atlas, const Target& target, const std::vector<spectra::LitRoom>& rooms,
             const RankingOptions& options) {
  require_sound(target, options.windows);
  if (rooms.empty()) throw std::invalid_argument("no lighting to rank under");
  Ranking ranking;
  std::vector<SeenPaint> seen;
  double enough = std::numeric_limits<double>::infinity();  // what the best must be below
  for (const Paint& paint : atlas.paints) {
    if (rejected(paint, options, target)) {
      ++ranking.rejected;
      continue;
    }
    seen.clear();
    for (const spectra::LitRoom& room : rooms) {
      seen.push_back(look(paint.reflectance, target, room, options.distance, options.viewing));
    }
    if (!defined(seen)) {
      ranking.undefined.push_back(paint.name);
      continue;
    }
    const double distance = judged(options.judgement, seen, rooms);
    if (distance >= enough) continue;
    ranking.paints.push_back({.paint = &paint,
                              .distance = distance,
                              .inconstancy = inconstancy(options.distance, seen),
                              .seen = seen});
    if (ranking.paints.size() / 2 >= options.top) {
      keep_best(ranking.paints, options.top);
      enough = ranking.paints.back().distance;
    }
  }
  keep_best(ranking.paints, options.top);
  return ranking;
}

}  // namespace paints
