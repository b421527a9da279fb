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

double angle_deg(const spectra::ViewedLight& light, const spectra::ViewingChoices& choices) {
  return choices.angle_deg > 0 ? choices.angle_deg : light.angle_deg;
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
  if (choice == spectra::Background::fixed) return "fixed";
  return choice == spectra::Background::ring ? "ring" : "sample";
}

std::string to_string(spectra::ReferenceWhite choice) {
  return choice == spectra::ReferenceWhite::ideal ? "ideal" : "surfaces";
}

Adopted adopted(const spectra::ViewedLight& light, const spectra::ViewingChoices& choices) {
  Adopted adopted{.choices = choices, .white = {}, .size = {}};
  if (choices.white_share != 1) {
    const spectra::Xyz lamps =
        light.lamps.values.size() == 0 ? spectra::Xyz{} : spectra::absolute_xyz(light.lamps);
    require_light(lamps.y, "lamps");
    adopted.white = {
        .share = choices.white_share, .lamps_x = lamps.x / lamps.y, .lamps_z = lamps.z / lamps.y};
  }
  if (choices.size_effect) adopted.size = size_effect(angle_deg(light, choices));
  return adopted;
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
                .surround = choices.surround,
                .lamps_by_flux = light.lamps_by_flux};
  double background_y = choices.background_y;
  if (choices.background == spectra::Background::ring) {
    background_y = 100 * spectra::luminous(light.background) / white.y;
  } else if (choices.background == spectra::Background::sample) {
    background_y = view.sample.y;
  }
  require_light(background_y, "background");
  const Adopted taken = adopted(light, choices);
  view.size = taken.size;
  if (choices.size_effect) view.angle_deg = angle_deg(light, choices);

  const auto [ratio, factors] =
      surround_of(choices.surround, {.adapting_luminance_cd_m2 = adapting,
                                     .white_luminance_cd_m2 = view.white_luminance_cd_m2,
                                     .illuminance_lx = view.illuminance_lx});
  view.surround_ratio = ratio;
  spectra::RelativeXyz adopted_white = relative(light.white);
  adopted_white.x = taken.white.x(adopted_white.x, adopted_white.y);
  adopted_white.z = taken.white.z(adopted_white.z, adopted_white.y);
  view.conditions = {.white = adopted_white,
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

Correlates seen(const spectra::RelativeXyz& sample, const Adaptation& adaptation,
                const SizeEffect& size) {
  Correlates p = ciecam02_forward(sample, adaptation);
  if (size.none() || p.status.negative_achromatic) return p;
  const LightnessChromaHue large =
      size.forward({.lightness = p.lightness, .chroma = p.chroma, .hue_deg = p.hue_deg});
  p.lightness = large.lightness;
  p.brightness = adaptation.brightness_scale * std::sqrt(p.lightness / 100);
  if (p.status.no_chroma_denominator) return p;
  p.chroma = large.chroma;
  p.colourfulness *= size.chroma;
  const double before = p.saturation;
  p.saturation = p.brightness > 0 ? 100 * std::sqrt(p.colourfulness / p.brightness) : 0;
  const double saturation = before > 0 ? p.saturation / before : 0;
  p.a_c *= size.chroma, p.b_c *= size.chroma;
  p.a_m *= size.chroma, p.b_m *= size.chroma;
  p.a_s *= saturation, p.b_s *= saturation;
  return p;
}

Correlates seen(const RoomView& view) {
  return seen(view.sample, adapt(view.conditions), view.size);
}

SwatchCondition swatch_in(const spectra::Spectrum& irradiance, double background_y,
                          Surround surround) {
  const double illuminance_lx = spectra::luminous(irradiance);
  require_light(illuminance_lx, "swatch");
  const double luminance = illuminance_lx / std::numbers::pi;
  return {.light = irradiance,
          .conditions = {.white = spectra::relative_xyz(spectra::constant(irradiance.grid, 1),
                                                        irradiance),
                         .adapting_luminance_cd_m2 = luminance,
                         .background_y = background_y,
                         .surround = surround_of(surround, {.adapting_luminance_cd_m2 = luminance,
                                                            .white_luminance_cd_m2 = luminance,
                                                            .illuminance_lx = illuminance_lx})
                                         .factors},
          .size = {}};
}

const SwatchCondition& standard_swatch() {
  static const SwatchCondition standard{
      .light = swatch_light(), .conditions = standard_conditions(), .size = {}};
  return standard;
}

SwatchAppearance on_swatch(const spectra::Spectrum& reflectance, const SwatchCondition& swatch) {
  const spectra::RelativeXyz xyz = spectra::relative_xyz(reflectance, swatch.light);
  const bool standard = &swatch == &standard_swatch();
  const Adaptation& adaptation = standard ? standard_adaptation() : adapt(swatch.conditions);
  return {.xyz = xyz, .correlates = seen(xyz, adaptation, swatch.size)};
}

}  // namespace appearance
