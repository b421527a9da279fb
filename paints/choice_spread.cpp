#include "paints/choice_spread.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace paints {

namespace {

constexpr double kUndefined = std::numeric_limits<double>::infinity();

/// Nothing, where the model cannot adapt to the white of the choice.
appearance::Correlates seen_by(const Choice& choice, const spectra::ViewedLight& light) {
  try {
    return appearance::seen(appearance::view_of_room(light, choice.viewing));
  } catch (const std::domain_error&) {
    return {.status = {.negative_achromatic = true, .no_chroma_denominator = true}};
  }
}

ChoiceLook look_under(const Choice& choice, const std::vector<spectra::ViewedLight>& lights,
                      const std::vector<spectra::LitRoom>& rooms, const SpreadOptions& options) {
  ChoiceLook look;
  std::vector<double> distances;
  for (const spectra::ViewedLight& light : lights) {
    const appearance::Correlates seen = seen_by(choice, light);
    if (distances.empty()) look.correlates = seen;
    distances.push_back(seen.status.all_defined() ? distance(options.distance, seen, choice.target)
                                                  : kUndefined);
  }
  look.distance = judged(options.judgement, distances, rooms);
  return look;
}

}  // namespace

double SpreadPaint::largest_distance() const {
  return std::ranges::max_element(looks, {}, &ChoiceLook::distance)->distance;
}

std::vector<ChoiceLook> looks_of(const spectra::Spectrum& reflectance,
                                 const std::vector<spectra::LitRoom>& rooms,
                                 const SpreadOptions& options) {
  std::vector<spectra::ViewedLight> lights;
  for (const spectra::LitRoom& room : rooms) lights.push_back(room.view(reflectance));
  std::vector<ChoiceLook> looks;
  for (const Choice& choice : options.choices) {
    looks.push_back(look_under(choice, lights, rooms, options));
  }
  return looks;
}

std::vector<SpreadPaint> spread_of(const std::vector<const Paint*>& paints,
                                   const std::vector<spectra::LitRoom>& rooms,
                                   const SpreadOptions& options) {
  std::vector<SpreadPaint> spread;
  for (const Paint* paint : paints) {
    spread.push_back({.paint = paint, .looks = looks_of(paint->reflectance, rooms, options)});
  }
  return spread;
}

std::vector<int> ranks_under(const std::vector<SpreadPaint>& paints, std::size_t choice) {
  std::vector<std::size_t> order(paints.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {},
                           [&](std::size_t p) { return paints[p].looks[choice].distance; });
  std::vector<int> ranks(paints.size());
  for (std::size_t r = 0; r < order.size(); ++r) ranks[order[r]] = static_cast<int>(r) + 1;
  return ranks;
}

}  // namespace paints
