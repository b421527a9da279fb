#include "appearance/jab_slope.h"

#include <array>
#include <numbers>
#include <stdexcept>
#include <unsupported/Eigen/AutoDiff>

#include "appearance/ciecam02_steps.h"
#include "appearance/spectra/cie_tables.h"
#include "appearance/viewing_conditions.h"

namespace appearance {
namespace {

using spectra::ViewingChoices;
using steps::Vector3;

enum Sum { sample_x, sample_y, sample_z, white_x, white_y, white_z, field_y, background_y };

// A number with its derivatives by the eight sums.
using Dual = Eigen::AutoDiffScalar<ViewedSums>;

template <typename T>
using Sums = std::array<T, kViewedSums>;

constexpr double kOffNeutral = 1e-6;  // of the white

double value(double number) { return number; }

double value(const Dual& number) { return number.value(); }

/// What each band adds to each sum: 8 x bands.
Eigen::MatrixXd band_terms(const spectra::ViewedLight& light) {
  const spectra::Grid& grid = light.sample.grid;
  for (const spectra::Spectrum* part : {&light.background, &light.field, &light.white}) {
    if (part->grid != grid) throw std::invalid_argument("viewed light on different grids");
  }
  const Eigen::MatrixX3d weights =
      spectra::kMaxLuminousEfficacy_lm_W * grid.step_nm * spectra::colour_matching(grid);
  const auto weighted = [](const auto& by_band, const spectra::Spectrum& part) {
    return (by_band.transpose() * part.values.matrix().asDiagonal()).eval();
  };
  Eigen::MatrixXd terms(kViewedSums, grid.count);
  terms.middleRows<3>(sample_x) = weighted(weights, light.sample);
  terms.middleRows<3>(white_x) = weighted(weights, light.white);
  terms.row(field_y) = weighted(weights.col(1), light.field);
  terms.row(background_y) = weighted(weights.col(1), light.background);
  return terms;
}

template <typename T>
struct SurroundOf {
  T f, c, n_c;
};

/// As surround_of; with the derivatives of the one reading that follows the light smoothly, whose
/// factors are linear between dark 0, dim 0.2 and average 1.
template <typename T>
SurroundOf<T> surround(spectra::Surround choice, const T& adapting, const T& white_luminance) {
  const auto [ratio, factors] =
      surround_of(choice, {.adapting_luminance_cd_m2 = value(adapting),
                           .white_luminance_cd_m2 = value(white_luminance),
                           .illuminance_lx = value(white_luminance) * std::numbers::pi});
  const bool follows = choice == spectra::Surround::neumann && ratio < 1;
  if (!follows) return {.f = T(factors.f), .c = T(factors.c), .n_c = T(factors.n_c)};

  const double from = ratio < 0.2 ? 0 : 0.2, to = ratio < 0.2 ? 0.2 : 1;
  const SurroundFactors low = surround_factors(from), high = surround_factors(to);
  const T share = (adapting / white_luminance - from) / (to - from);
  return {.f = low.f + share * (high.f - low.f),
          .c = low.c + share * (high.c - low.c),
          .n_c = low.n_c + share * (high.n_c - low.n_c)};
}

template <typename T>
T background_of(const Sums<T>& s, const T& relative, const ViewingChoices& choices) {
  if (choices.background == spectra::Background::fixed) return T(choices.background_y);
  const bool ring = choices.background == spectra::Background::ring;
  return (ring ? s[background_y] : s[sample_y]) * relative;
}

template <typename T>
steps::Adapted<T> adapted(const Sums<T>& s, const T& relative, const ViewingChoices& choices) {
  const T adapting = s[field_y] / std::numbers::pi, white = s[white_y] / std::numbers::pi;
  const auto around = surround<T>(choices.surround, adapting, white);
  return steps::adapted<T>(
      {.white = Vector3<T>(s[white_x] * relative, T(100), s[white_z] * relative),
       .adapting_luminance_cd_m2 = adapting,
       .background_y = background_of(s, relative, choices),
       .f = around.f,
       .c = around.c,
       .n_c = around.n_c});
}

template <typename T>
struct Jab {
  T j, a_c, b_c;
};

template <typename T>
Jab<T> jab_from(Sums<T> s, const Adopted& adopted, double off_neutral) {
  s[white_x] = adopted.white.x(s[white_x], s[white_y]);
  s[white_z] = adopted.white.z(s[white_z], s[white_y]);
  const T relative = 100 / s[white_y];
  Vector3<T> sample(s[sample_x] * relative, s[sample_y] * relative, s[sample_z] * relative);
  const double scale = off_neutral * value(relative);
  sample[0] += scale * value(s[white_x]);
  sample[1] += scale * value(s[white_y]);
  sample[2] += scale * 0.99 * value(s[white_z]);
  const auto seen = steps::seen<T>(sample, adapted<T>(s, relative, adopted.choices));
  const T chroma = adopted.size.chroma * seen.alpha * seen.root_j;
  const T j = 100 * seen.root_j * seen.root_j;
  const bool resized = !adopted.size.none() && seen.has_lightness();
  return {.j = resized ? T(j + (1 - adopted.size.lightness) * (100 - j)) : j,
          .a_c = chroma * seen.hue.cos_h,
          .b_c = chroma * seen.hue.sin_h};
}

template <typename T, typename Make>
Sums<T> each(Make make) {
  Sums<T> all;
  for (int i = 0; i < kViewedSums; ++i) all[static_cast<std::size_t>(i)] = make(i);
  return all;
}

}  // namespace

ViewedSums viewed_sums(const spectra::ViewedLight& light) {
  return band_terms(light).rowwise().sum();
}

Eigen::Vector3d jab_of(const ViewedSums& sums, const Adopted& adopted) {
  const auto [j, a_c, b_c] =
      jab_from<double>(each<double>([&](int i) { return sums[i]; }), adopted, 0);
  return {j, a_c, b_c};
}

JabOfSums jab_slope(const ViewedSums& sums, const Adopted& adopted) {
  JabOfSums slope{.jab = jab_of(sums, adopted), .by_sum = {}};
  const bool neutral = slope.jab[1] == 0 && slope.jab[2] == 0;
  const auto [j, a_c, b_c] =
      jab_from<Dual>(each<Dual>([&](int i) { return Dual(sums[i], kViewedSums, i); }), adopted,
                     neutral ? kOffNeutral : 0);
  slope.by_sum << j.derivatives().transpose(), a_c.derivatives().transpose(),
      b_c.derivatives().transpose();
  return slope;
}

JabSlope jab_slope(const spectra::ViewedLightSlope& light, const ViewingChoices& choices) {
  const RoomView view = view_of_room(light.light, choices);
  const Correlates k = seen(view);
  const JabOfSums slope = jab_slope(viewed_sums(light.light), adopted(light.light, choices));
  return {.status = k.status,
          .jab = {k.lightness, k.a_c, k.b_c},
          .by_reflectance = slope.by_sum * band_terms(light.by_reflectance)};
}

}  // namespace appearance
