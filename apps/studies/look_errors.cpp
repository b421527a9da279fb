#include "apps/studies/look_errors.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "solver/rooms/mesh_study.h"

namespace apps {
namespace {

/// Of a look linear light falls no faster than constant light: the eye's field is seen along single
/// rays.
constexpr solver::Light kGain = solver::Light::constant;

/// A paint on patches of length h, 2 h and 4 h.
struct OnMeshes {
  std::array<const paints::SeenPaint*, 3> seen;  ///< in the first lighting
  std::array<double, 3> distance{};

  template <typename Quantity>
  [[nodiscard]] double error(const Quantity& of) const {
    const double h = of(*seen[0]), h2 = of(*seen[1]), h4 = of(*seen[2]);
    return solver::left_by_mesh(h - h2, h2 - h4, kGain);
  }
};

LookError error_of(const OnMeshes& paint) {
  const auto correlate = [&](double appearance::Correlates::*value) {
    return paint.error([=](const auto& seen) { return seen.correlates.*value; });
  };
  const auto condition = [&](double appearance::ViewingConditions::*value) {
    return paint.error([=](const auto& seen) { return seen.view.conditions.*value; });
  };
  const auto white = [&](double spectra::RelativeXyz::*value) {
    return paint.error([=](const auto& seen) { return seen.view.conditions.white.*value; });
  };
  return {.distance = solver::left_by_mesh(paint.distance[0] - paint.distance[1],
                                           paint.distance[1] - paint.distance[2], kGain),
          .lightness = correlate(&appearance::Correlates::lightness),
          .a_c = correlate(&appearance::Correlates::a_c),
          .b_c = correlate(&appearance::Correlates::b_c),
          .background_y = condition(&appearance::ViewingConditions::background_y),
          .adapting_luminance_cd_m2 =
              condition(&appearance::ViewingConditions::adapting_luminance_cd_m2),
          .white = std::max({white(&spectra::RelativeXyz::x), white(&spectra::RelativeXyz::y),
                             white(&spectra::RelativeXyz::z)})};
}

/// What is left of the difference of two distances, which is less than of each.
double error_of_difference(const OnMeshes& a, const OnMeshes& b) {
  std::array<double, 3> difference{};
  for (std::size_t k = 0; k < 3; ++k) difference[k] = a.distance[k] - b.distance[k];
  return solver::left_by_mesh(difference[0] - difference[1], difference[1] - difference[2], kGain);
}

}  // namespace

RankingErrors ranking_errors(const paints::Ranking& ranking, const paints::Target& target,
                             const std::vector<std::vector<spectra::LitRoom>>& longer,
                             const paints::RankingOptions& options) {
  RankingErrors errors;
  if (longer.size() < 2) return errors;
  const std::size_t count = ranking.paints.size();
  std::vector<std::array<std::vector<paints::SeenPaint>, 2>> looks(count);
  std::vector<OnMeshes> paints;
  for (std::size_t i = 0; i < count; ++i) {
    const paints::RankedPaint& ranked = ranking.paints[i];
    OnMeshes& paint = paints.emplace_back();
    paint.seen[0] = &ranked.seen.front();
    paint.distance[0] = paints::judged(options.judgement, ranked.seen, longer[0]);
    for (std::size_t k = 0; k < 2; ++k) {
      looks[i][k] = paints::look(ranked.paint->reflectance, target, longer[k], options.distance,
                                 options.viewing);
      paint.seen[k + 1] = &looks[i][k].front();
      paint.distance[k + 1] = paints::judged(options.judgement, looks[i][k], longer[k]);
    }
    errors.of_paint.push_back(error_of(paint));
  }
  for (std::size_t i = 0; i < count; ++i) {
    int tie = 0;
    for (std::size_t k = 0; k < i && tie == 0; ++k) {
      const double apart = paints[i].distance[0] - paints[k].distance[0];
      if (apart <= error_of_difference(paints[i], paints[k])) tie = static_cast<int>(k) + 1;
    }
    errors.ties_with.push_back(tie);
  }
  return errors;
}

}  // namespace apps
