#include "appearance/viewing_conditions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/photometry.h"

namespace appearance {

using spectra::Surround;

namespace {

constexpr double kAverage = 1, kDim = 0.2, kDark = 0;  // surround ratios of [Neumann2004] Table 5

// N_c of dim as in [CIE159]; [Neumann2004] prints 0.95.
constexpr SurroundFactors kAverageFactors{.f = 1.0, .c = 0.69, .n_c = 1.0};
constexpr SurroundFactors kDimFactors{.f = 0.9, .c = 0.59, .n_c = 0.9};
constexpr SurroundFactors kDarkFactors{.f = 0.8, .c = 0.525, .n_c = 0.8};

SurroundFactors mixed(const SurroundFactors& p, const SurroundFactors& q, double share_of_q) {
  return {.f = std::lerp(p.f, q.f, share_of_q),
          .c = std::lerp(p.c, q.c, share_of_q),
          .n_c = std::lerp(p.n_c, q.n_c, share_of_q)};
}

/// Average from a threshold up, dim below, dark at 0.
double surround_class(double value, double threshold) {
  if (value >= threshold) return kAverage;
  return value > 0 ? kDim : kDark;
}

double luminance_cd_m2(const spectra::Spectrum& radiosity) {
  return spectra::luminous(radiosity) / std::numbers::pi;
}

void require_light(double luminance, const char* where) {
  if (!(luminance > 0 && std::isfinite(luminance))) {
    throw std::domain_error(
        fmt::format("no colour to be seen: the luminance of the {} is {}", where, luminance));
  }
}

const spectra::Spectrum& swatch_light() {
  static const spectra::Spectrum d65 =
      spectra::light_on(spectra::kTransportGrid, spectra::illuminant("D65"));
  return d65;
}

}  // namespace

SurroundFactors surround_factors(double ratio) {
  if (!std::isfinite(ratio)) {
    throw std::domain_error(fmt::format("the surround ratio is {}; want a number", ratio));
  }
  const double r = std::clamp(ratio, kDark, kAverage);
  if (r < kDim) return mixed(kDarkFactors, kDimFactors, r / kDim);
  return mixed(kDimFactors, kAverageFactors, (r - kDim) / (kAverage - kDim));
}

RatioAndFactors surround_of(Surround choice, const SurroundLight& light) {
  const auto& [adapting, white, illuminance_lx] = light;
  if (!(white > 0 && adapting >= 0 && illuminance_lx >= 0 &&
        std::isfinite(white + adapting + illuminance_lx))) {
    throw std::domain_error(
        fmt::format("no surround from L_A {} cd/m^2, L_Aw {} cd/m^2 and {} lx; want L_Aw above 0",
                    adapting, white, illuminance_lx));
  }
  const auto of_ratio = [](double ratio) {
    return RatioAndFactors{.ratio = ratio, .factors = surround_factors(ratio)};
  };
  switch (choice) {
    case Surround::neumann:
      return of_ratio(std::clamp(adapting / white, kDark, kAverage));
    case Surround::cie: {
      const double s_r = 5 * adapting / white;
      return {.ratio = s_r, .factors = surround_factors(surround_class(s_r, 0.2))};
    }
    case Surround::illuminance:
      return of_ratio(surround_class(illuminance_lx, 40));
    case Surround::average:
      return of_ratio(kAverage);
    case Surround::dim:
      return of_ratio(kDim);
    case Surround::dark:
      return of_ratio(kDark);
  }
  throw std::invalid_argument("unknown choice of surround");
}

std::string to_string(Surround choice) {
  switch (choice) {
    case Surround::neumann:
      return "neumann";
    case Surround::cie:
      return "cie";
    case Surround::illuminance:
      return "illuminance";
    case Surround::average:
      return "average";
    case Surround::dim:
      return "dim";
    case Surround::dark:
      return "dark";
  }
  throw std::invalid_argument("unknown choice of surround");
}

std::string to_string(spectra::Background choice) {
  return choice == spectra::Background::ring ? "ring" : "sample";
}

std::string to_string(spectra::ReferenceWhite choice) {
  return choice == spectra::ReferenceWhite::ideal ? "ideal" : "surfaces";
}

RoomView view_of_room(const spectra::ViewedLight& light, const spectra::ViewingChoices& choices) {
  const spectra::Xyz white = spectra::absolute_xyz(light.white);
  const double adapting = luminance_cd_m2(light.field);
  require_light(white.y, "reference white");
  require_light(adapting, "adapting field");

  const auto relative = [&](const spectra::Spectrum& radiosity) {
    return spectra::relative_xyz(spectra::absolute_xyz(radiosity), white.y);
  };
  RoomView view{.sample = relative(light.sample),
                .white_luminance_cd_m2 = white.y / std::numbers::pi,
                .illuminance_lx = white.y,
                .surround = choices.surround};
  const double background_y = choices.background == spectra::Background::ring
                                  ? 100 * spectra::luminous(light.background) / white.y
                                  : view.sample.y;
  require_light(background_y, "background");

  const auto [ratio, factors] =
      surround_of(choices.surround, {.adapting_luminance_cd_m2 = adapting,
                                     .white_luminance_cd_m2 = view.white_luminance_cd_m2,
                                     .illuminance_lx = view.illuminance_lx});
  view.surround_ratio = ratio;
  view.conditions = {.white = relative(light.white),
                     .adapting_luminance_cd_m2 = adapting,
                     .background_y = background_y,
                     .surround = factors};
  return view;
}

const ViewingConditions& standard_conditions() {
  static const ViewingConditions conditions{
      .white = spectra::relative_xyz(spectra::constant(spectra::kTransportGrid, 1), swatch_light()),
      .adapting_luminance_cd_m2 = 2000 / std::numbers::pi,
      .background_y = 20,
      .surround = kAverageFactors};
  return conditions;
}

const Adaptation& standard_adaptation() {
  static const Adaptation adaptation = adapt(standard_conditions());
  return adaptation;
}

SwatchAppearance on_swatch(const spectra::Spectrum& reflectance) {
  const spectra::RelativeXyz xyz = spectra::relative_xyz(reflectance, swatch_light());
  return {.xyz = xyz, .correlates = ciecam02_forward(xyz, standard_adaptation())};
}

}  // namespace appearance
