#pragma once
#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/photometry.h"
#include "appearance/spectra/viewed_light.h"
#include "paints/mixing.h"

namespace paints::test {

/// An integrating sphere under 300 lx of A, of which 45 % are painted and the rest reflects 0.5:
/// the irradiance is E / (1 - mean reflectance). The field also sees lamps.
inline spectra::ViewedLightSlope sphere_room(const spectra::Spectrum& paint) {
  static const Eigen::ArrayXd kLamp =
      spectra::scaled_to_luminous(
          spectra::light_on(spectra::kTransportGrid, spectra::illuminant("A")), 300)
          .values;
  const Eigen::ArrayXd& rho = paint.values;
  const auto part = [&](const Eigen::ArrayXd& values) {
    return spectra::Spectrum{paint.grid, values};
  };
  const Eigen::ArrayXd mean = 0.45 * rho + 0.55 * 0.5, fade = 1 / (1 - mean);
  const Eigen::ArrayXd h = kLamp * fade, dh = 0.45 * h * fade;
  return {.light = {.sample = part(rho * h),
                    .background = part((0.8 * rho + 0.1) * h),
                    .field = part(mean * h + 0.3 * kLamp),
                    .white = part(h)},
          .by_reflectance = {.sample = part(h + rho * dh),
                             .background = part(0.8 * h + (0.8 * rho + 0.1) * dh),
                             .field = part(0.45 * h + mean * dh),
                             .white = part(dh)}};
}

/// Every `every`-th of the measured papers.
inline BaseSet some_papers(std::size_t every, const Saunderson& surface = {}) {
  Atlas atlas = load_atlas("munsell-nickerson");
  std::vector<Paint> few;
  for (std::size_t i = 0; i < atlas.paints.size(); i += every) few.push_back(atlas.paints[i]);
  atlas.paints = few;
  return bases_of(atlas, surface);
}

}  // namespace paints::test
