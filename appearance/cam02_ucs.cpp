#include "appearance/cam02_ucs.h"

#include <cmath>
#include <numbers>

namespace appearance {

namespace {

constexpr double kC1 = 0.007, kC2 = 0.0228;  // the uniform space; LCD and SCD have others

}  // namespace

UcsColour cam02_ucs(const LightnessColourfulnessHue& colour) {
  const auto& [lightness, colourfulness, hue_deg] = colour;
  const double m = std::log1p(kC2 * colourfulness) / kC2;
  const double h = hue_deg * std::numbers::pi / 180;
  return {.j = (1 + 100 * kC1) * lightness / (1 + kC1 * lightness),
          .a = m * std::cos(h),
          .b = m * std::sin(h)};
}

double ucs_distance(const UcsColour& p, const UcsColour& q) {
  return std::hypot(p.j - q.j, p.a - q.a, p.b - q.b);
}

}  // namespace appearance
