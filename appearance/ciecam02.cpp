#include "appearance/ciecam02.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string_view>

#include "appearance/ciecam02_steps.h"

namespace appearance {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using spectra::RelativeXyz;

namespace {

constexpr double kDegreesPerRadian = 180 / std::numbers::pi;

double expanded(double response) {
  const double magnitude = std::abs(response);
  return std::copysign(std::pow(27.13 * magnitude / (400 - magnitude), 1 / 0.42), response);
}

Vector3d vector(const RelativeXyz& xyz) { return {xyz.x, xyz.y, xyz.z}; }

struct UniqueHue {
  double h_deg, e;
};

// Red, yellow, green, blue, red [CIE159].
constexpr std::array<UniqueHue, 5> kUniqueHues{
    {{20.14, 0.8}, {90.00, 0.7}, {164.25, 1.0}, {237.53, 1.2}, {380.14, 0.8}}};

double hue_quadrature(double hue_deg) {
  const double h = hue_deg < kUniqueHues[0].h_deg ? hue_deg + 360 : hue_deg;
  std::size_t i = 0;
  while (i < 3 && h >= kUniqueHues[i + 1].h_deg) ++i;
  const UniqueHue &from = kUniqueHues[i], &next = kUniqueHues[i + 1];
  const double past = (h - from.h_deg) * next.e, ahead = (next.h_deg - h) * from.e;
  return 100 * (static_cast<double>(i) + past / (past + ahead));
}

/// h in [0, 360). The half-angle formula keeps the tangent within -1..1, where atan is fastest.
double hue_angle_deg(double cos_h, double sin_h) {
  const double h = 2 * kDegreesPerRadian * std::atan(sin_h / (1 + std::abs(cos_h)));
  if (cos_h < 0) return 180 - h;
  if (h >= 0) return h;
  return h + 360 < 360 ? h + 360 : 0;  // the sum rounds to 360 for the smallest angles
}

Correlates correlates(const Status& status, double root_j, double alpha,
                      const steps::Opponent<double>& o, const Adaptation& a) {
  const double hue_deg = hue_angle_deg(o.cos_h, o.sin_h), chroma = alpha * root_j;
  const double colourfulness = chroma * a.f_l_4th;
  const double saturation = a.saturation_scale * std::sqrt(alpha);  // 100 sqrt(M / Q)
  return {.status = status,
          .lightness = 100 * root_j * root_j,
          .chroma = chroma,
          .hue_deg = hue_deg,
          .hue_quadrature = hue_quadrature(hue_deg),
          .brightness = a.brightness_scale * root_j,
          .colourfulness = colourfulness,
          .saturation = saturation,
          .a_c = chroma * o.cos_h,
          .b_c = chroma * o.sin_h,
          .a_m = colourfulness * o.cos_h,
          .b_m = colourfulness * o.sin_h,
          .a_s = saturation * o.cos_h,
          .b_s = saturation * o.sin_h};
}

void require(bool holds, const char* rule, double value) {
  if (!holds) {
    throw std::domain_error(fmt::format("CIECAM02 viewing conditions: {}, not {}", rule, value));
  }
}

void require_sound(const ViewingConditions& view) {
  const auto positive = [](double v) { return v > 0 && std::isfinite(v); };
  const auto& [f, c, n_c] = view.surround;
  require(positive(view.adapting_luminance_cd_m2), "adapting luminance L_A must be above 0",
          view.adapting_luminance_cd_m2);
  require(positive(view.background_y), "background Y_b must be above 0", view.background_y);
  require(positive(view.white.y), "white Y_w must be above 0", view.white.y);
  require(std::isfinite(view.white.x), "white X_w must be a number", view.white.x);
  require(std::isfinite(view.white.z), "white Z_w must be a number", view.white.z);
  require(f >= 0 && f <= 1, "surround factor F must lie in 0..1", f);
  require(c > 0 && c <= 2, "surround factor c must lie above 0, up to 2", c);
  require(n_c > 0 && n_c <= 2, "surround factor N_c must lie above 0, up to 2", n_c);
}

}  // namespace

Adaptation adapt(const ViewingConditions& view) {
  require_sound(view);
  const Vector3d white = steps::kCat02 * vector(view.white);
  require((white.array() > 0).all(), "each CAT02 component of the white must be above 0, the least",
          white.minCoeff());

  const auto& [f, c, n_c] = view.surround;
  const steps::Adapted<double> core =
      steps::adapted<double>({.white = vector(view.white),
                              .adapting_luminance_cd_m2 = view.adapting_luminance_cd_m2,
                              .background_y = view.background_y,
                              .f = f,
                              .c = c,
                              .n_c = n_c});
  Adaptation a{.background_induction = core.background_induction,
               .lightness_exponent = core.lightness_exponent,
               .f_l_4th = std::pow(core.f_l, 0.25),
               .chroma_factor = core.chroma_factor,
               .white_response = core.white_response,
               .chroma_scale = core.chroma_scale,
               .cones_from_xyz = core.cones_from_xyz,
               .xyz_from_cones = 100 / core.f_l * steps::kCat02.inverse() *
                                 core.gain.cwiseInverse().asDiagonal() *
                                 steps::kConesFromCat02.inverse()};
  require(a.white_response > 0 && std::isfinite(a.white_response),
          "achromatic response A_w of the white must be above 0", a.white_response);
  a.brightness_scale = 4 / c * (a.white_response + 4) * a.f_l_4th;
  a.saturation_scale = 50 * std::sqrt(c / (a.white_response + 4));
  return a;
}

Correlates ciecam02_forward(const RelativeXyz& sample, const Adaptation& a) {
  const steps::Seen<double> s = steps::seen<double>(vector(sample), a);
  if (!std::isfinite(s.root_j * s.root_j + s.alpha)) {
    throw std::domain_error(fmt::format("CIECAM02: the sample X {} Y {} Z {} is beyond all numbers",
                                        sample.x, sample.y, sample.z));
  }
  const Status status{.negative_cone = s.negative_cone,
                      .negative_achromatic = !s.has_lightness(),
                      .no_chroma_denominator = s.denominator <= 0};
  return correlates(status, s.root_j, s.alpha, s.hue, a);
}

RelativeXyz ciecam02_inverse(const LightnessChromaHue& wished, const Adaptation& a) {
  const double lightness = wished.lightness, chroma = wished.chroma, hue_deg = wished.hue_deg;
  const auto no_stimulus = [&] {
    return std::domain_error(
        fmt::format("CIECAM02: no stimulus has J {} C {} h {}", lightness, chroma, hue_deg));
  };
  const bool finite = std::isfinite(lightness + chroma + hue_deg);
  if (!finite || lightness < 0 || chroma < 0) throw no_stimulus();
  if (lightness == 0) {
    if (chroma > 0) throw no_stimulus();
    return {};
  }

  const double relative = lightness / 100;
  const double t = std::pow(chroma / (std::sqrt(relative) * a.chroma_factor), 1 / 0.9);
  const double p2 = a.white_response * std::pow(relative, 1 / a.lightness_exponent) /
                    a.background_induction;  // A / N_bb
  const double cos_h = std::cos(hue_deg / kDegreesPerRadian);
  const double sin_h = std::sin(hue_deg / kDegreesPerRadian);
  const double p1 = a.chroma_scale * steps::eccentricity(cos_h, sin_h);
  // Where the denominator is not positive, no response however strong gives so much chroma.
  const double denominator = 23 * p1 + 11 * t * cos_h + 108 * t * sin_h;
  if (!(denominator > 0)) throw no_stimulus();
  const double gamma = 23 * (p2 + steps::kNoise) * t / denominator;
  const double red_green = gamma * cos_h, yellow_blue = gamma * sin_h;

  const Vector3d r = Vector3d(460 * p2 + 451 * red_green + 288 * yellow_blue,
                              460 * p2 - 891 * red_green - 261 * yellow_blue,
                              460 * p2 - 220 * red_green - 6300 * yellow_blue) /
                     1403;
  if (!(r.cwiseAbs().maxCoeff() < 400)) throw no_stimulus();  // 400: where the cones saturate
  const Vector3d xyz = a.xyz_from_cones * r.unaryExpr(&expanded);
  if (!xyz.allFinite()) throw no_stimulus();
  return {xyz[0], xyz[1], xyz[2]};
}

std::string to_string(const Status& status) {
  std::string names;
  const auto add = [&](bool flag, const char* name) {
    if (!flag) return;
    if (!names.empty()) names += '+';
    names += name;
  };
  add(status.negative_cone, "NEGCONE");
  add(status.negative_achromatic, "A_NEG");
  add(status.no_chroma_denominator, "TDEN");
  return names.empty() ? "OK" : names;
}

std::string hue_composition(double hue_quadrature) {
  if (!(hue_quadrature >= 0 && hue_quadrature <= 400)) {
    throw std::invalid_argument(fmt::format("hue quadrature {}; want 0 to 400", hue_quadrature));
  }
  constexpr std::string_view names = "RYGBR";
  const int from = std::min(static_cast<int>(hue_quadrature / 100), 3);
  const long next_share = std::lround(hue_quadrature - 100 * from);
  if (next_share == 0) return fmt::format("100{}", names[from]);
  if (next_share == 100) return fmt::format("100{}", names[from + 1]);
  return fmt::format("{}{} {}{}", 100 - next_share, names[from], next_share, names[from + 1]);
}

}  // namespace appearance
