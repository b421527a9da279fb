#include "appearance/size_effect.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace appearance {
namespace {

constexpr double kSwatch_deg = 2, kLargest_deg = 50;  // the fields that were observed

// J' = 100 + K_J (J - 100) and C' = K_C C, with K_J and K_C linear in the angle [Xiao2011]. These
// four numbers are unverified: no source at hand prints them.
double lightness_factor(double angle_deg) { return 1.1014 - 0.007 * angle_deg; }

double chroma_factor(double angle_deg) { return 0.94 + 0.008 * angle_deg; }

}  // namespace

SizeEffect size_effect(double angle_deg) {
  if (!(angle_deg > 0 && angle_deg <= 180)) {
    throw std::domain_error(
        fmt::format("a field of {} degrees; want above 0 and at most 180", angle_deg));
  }
  const double angle = std::clamp(angle_deg, kSwatch_deg, kLargest_deg);
  return {.lightness = lightness_factor(angle) / lightness_factor(kSwatch_deg),
          .chroma = chroma_factor(angle) / chroma_factor(kSwatch_deg)};
}

}  // namespace appearance
