#include "paints/ranking.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

bool rejected(const Paint& paint, const Windows& windows, const Target& target) {
  if (!windows.lightness && !windows.chroma && !windows.hue_deg) return false;
  const Correlates swatch = appearance::on_swatch(paint.reflectance).correlates;
  return swatch.status.all_defined() && !within(windows, swatch, target);
}

double distance(Distance kind, const Correlates& p, const Target& target) {
  if (kind == Distance::jab) {
    return std::hypot(p.lightness - target.lightness, p.a_c - target.a_c, p.b_c - target.b_c);
  }
  return appearance::ucs_distance(
      appearance::cam02_ucs({p.lightness, p.colourfulness, p.hue_deg}),
      appearance::cam02_ucs({target.lightness, target.colourfulness, hue_deg_of(target)}));
}

RankedPaint seen_in_room(const Paint& paint, const spectra::ViewedLight& light,
                         const Target& target, const RankingOptions& options) {
  const appearance::RoomView view = appearance::view_of_room(light, options.viewing);
  const Correlates seen =
      appearance::ciecam02_forward(view.sample, appearance::adapt(view.conditions));
  return {.paint = &paint,
          .distance = distance(options.distance, seen, target),
          .correlates = seen,
          .view = view,
          .chromaticity = spectra::chromaticity(view.sample)};
}

}  // namespace

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

Ranking rank(const Atlas& atlas, const Target& target, const spectra::RoomResponse& room,
             const RankingOptions& options) {
  require_sound(target, options.windows);
  Ranking ranking;
  for (const Paint& paint : atlas.paints) {
    if (rejected(paint, options.windows, target)) {
      ++ranking.rejected;
      continue;
    }
    RankedPaint ranked = seen_in_room(paint, room(paint.reflectance), target, options);
    if (ranked.correlates.status.all_defined()) {
      ranking.paints.push_back(std::move(ranked));
    } else {
      ranking.undefined.push_back(paint.name);
    }
  }
  std::stable_sort(
      ranking.paints.begin(), ranking.paints.end(),
      [](const RankedPaint& p, const RankedPaint& q) { return p.distance < q.distance; });
  return ranking;
}

}  // namespace paints
