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

/// The model sees the room through eight sums over the bands.
enum Sum { sample_x, sample_y, sample_z, white_x, white_y, white_z, field_y, background_y, sums };

using Slope = Eigen::Matrix<double, sums, 1>;
using Dual = Eigen::AutoDiffScalar<Slope>;  // a number with its derivatives by the eight sums
using Sums = std::array<Dual, sums>;
using steps::Vector3;

constexpr double kOffNeutral = 1e-6;  // of the white

/// A row per sum, a column per band: the sums' derivatives, where those of the light are given.
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
  Eigen::MatrixXd terms(static_cast<int>(sums), grid.count);
  terms.middleRows<3>(sample_x) = weighted(weights, light.sample);
  terms.middleRows<3>(white_x) = weighted(weights, light.white);
  terms.row(field_y) = weighted(weights.col(1), light.field);
  terms.row(background_y) = weighted(weights.col(1), light.background);
  return terms;
}

struct DualSurround {
  Dual f, c, n_c;
};

/// The factors are linear in the ratio between dark 0, dim 0.2 and average 1.
DualSurround surround(const RoomView& view, const Dual& adapting, const Dual& white_luminance) {
  const auto& [f, c, n_c] = view.conditions.surround;
  const bool follows = view.surround == spectra::Surround::neumann && view.surround_ratio < 1;
  if (!follows) return {.f = f, .c = c, .n_c = n_c};

  const double from = view.surround_ratio < 0.2 ? 0 : 0.2, to = view.surround_ratio < 0.2 ? 0.2 : 1;
  const SurroundFactors low = surround_factors(from), high = surround_factors(to);
  const Dual share = (adapting / white_luminance - from) / (to - from);
  return {.f = low.f + share * (high.f - low.f),
          .c = low.c + share * (high.c - low.c),
          .n_c = low.n_c + share * (high.n_c - low.n_c)};
}

steps::Adapted<Dual> adapted(const Sums& s, const RoomView& view, const Dual& relative,
                             spectra::Background background) {
  const Dual adapting = s[field_y] / std::numbers::pi;
  const DualSurround around = surround(view, adapting, s[white_y] / std::numbers::pi);
  const bool ring = background == spectra::Background::ring;
  return steps::adapted<Dual>(
      {.white = Vector3<Dual>(s[white_x] * relative, Dual(view.conditions.white.y),
                              s[white_z] * relative),
       .adapting_luminance_cd_m2 = adapting,
       .background_y = (ring ? s[background_y] : s[sample_y]) * relative,
       .f = around.f,
       .c = around.c,
       .n_c = around.n_c});
}

}  // namespace

JabSlope jab_slope(const spectra::ViewedLightSlope& light, const spectra::ViewingChoices& choices) {
  const RoomView view = view_of_room(light.light, choices);
  const Correlates k = ciecam02_forward(view.sample, adapt(view.conditions));
  const Eigen::VectorXd totals = band_terms(light.light).rowwise().sum();
  Sums s;
  for (int i = 0; i < sums; ++i) s[static_cast<std::size_t>(i)] = Dual(totals[i], sums, i);

  const Dual relative = 100 / s[white_y];
  Vector3<Dual> sample(s[sample_x] * relative, s[sample_y] * relative, s[sample_z] * relative);
  if (k.chroma == 0) {
    const auto& white = view.conditions.white;
    sample += (kOffNeutral * Eigen::Vector3d(white.x, white.y, 0.99 * white.z)).cast<Dual>();
  }
  const auto seen = steps::seen<Dual>(sample, adapted(s, view, relative, choices.background));
  const Dual chroma = seen.alpha * seen.root_j;
  const std::array<Dual, 3> jab{100 * seen.root_j * seen.root_j, chroma * seen.hue.cos_h,
                                chroma * seen.hue.sin_h};

  Eigen::Matrix<double, 3, sums> by_sum;
  for (int i = 0; i < 3; ++i) by_sum.row(i) = jab[static_cast<std::size_t>(i)].derivatives();
  return {.status = k.status,
          .jab = {k.lightness, k.a_c, k.b_c},
          .by_reflectance = by_sum * band_terms(light.by_reflectance)};
}

}  // namespace appearance
