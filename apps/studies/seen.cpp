#include "apps/studies/seen.h"

namespace apps {

Reported::Reported(const appearance::Correlates& k)
    : h_deg(k.hue_deg), hue_quadrature(k.hue_quadrature) {
  if (k.status.negative_achromatic) return;
  j = k.lightness, q = k.brightness;
  if (k.status.no_chroma_denominator) return;
  c = k.chroma, m = k.colourfulness, s = k.saturation;
  a_c = k.a_c, b_c = k.b_c, a_m = k.a_m, b_m = k.b_m, a_s = k.a_s, b_s = k.b_s;
}

Seen seen_in_room(const appearance::RoomView& view) {
  return {.xyz = view.sample, .correlates = appearance::seen(view)};
}

Seen seen_on_swatch(const spectra::Spectrum& reflectance,
                    const appearance::SwatchCondition& swatch) {
  const auto [xyz, correlates] = appearance::on_swatch(reflectance, swatch);
  return {.xyz = xyz, .correlates = correlates};
}

}  // namespace apps
