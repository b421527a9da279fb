#include "appearance/display.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "appearance/ciecam02_steps.h"
#include "appearance/spectra/rgb_space.h"
#include "appearance/spectra/srgb_transfer.h"

namespace appearance {

using Eigen::Vector3d;
using spectra::RelativeXyz;

namespace {

constexpr double kAdaptingLuminance_cd_m2 = 16, kBackgroundY = 20;
constexpr double kInGamut = 1e-9;  ///< of linear sRGB
constexpr double kOutside = -1, kUnknown = -2;
/// Up to this chroma no colour leaves the gamut and comes back as C rises (display_test.cpp).
constexpr double kNoReturn = 40;
constexpr double kChromaStep = 2.5, kMostChroma = 250, kChromaError = 1e-9;

const Eigen::Matrix3d& xyz_of_srgb() { return spectra::rgb_space("srgb").xyz_from_rgb; }

const Eigen::Matrix3d& srgb_of_xyz() {
  static const Eigen::Matrix3d inverse = xyz_of_srgb().inverse();
  return inverse;
}

/// With a white of equal CAT02 components the gains are 1 for every D; von Kries brings the
/// display's own white there (D = 1).
const ViewingConditions kAdaptedDisplay{.white = {100, 100, 100},
                                        .adapting_luminance_cd_m2 = kAdaptingLuminance_cd_m2,
                                        .background_y = kBackgroundY,
                                        .surround = {}};

Eigen::Matrix3d srgb_from_adapted_xyz() {
  const Vector3d white = steps::kCat02 * xyz_of_srgb() * Vector3d::Ones();
  return srgb_of_xyz() * steps::kCat02.inverse() * white.asDiagonal() * steps::kCat02 / 100;
}

}  // namespace

Vector3d srgb_encoded(const Vector3d& linear) {
  return linear.cwiseMax(0.0).cwiseMin(1.0).unaryExpr(&spectra::srgb_encoded);
}

Vector3d linear_srgb_of(const Vector3d& xyz) { return srgb_of_xyz() * xyz; }

Desaturated desaturated(const Vector3d& linear) {
  if (linear.minCoeff() >= 0 && linear.maxCoeff() <= 1) return {linear};
  const double y = xyz_of_srgb().row(1).dot(linear);
  if (y >= 1) return {Vector3d::Ones(), true};
  if (y <= 0) return {Vector3d::Zero(), true};
  const double low = linear.minCoeff(), high = linear.maxCoeff();
  const double kept =
      std::min(low < 0 ? y / (y - low) : 1.0, high > 1 ? (1 - y) / (high - y) : 1.0);
  return {Vector3d::Constant(y) + kept * (linear - Vector3d::Constant(y)), true};
}

Display::Display(const ViewingConditions& room, double headroom)
    : room_(adapt(room)),
      display_(adapt(kAdaptedDisplay)),
      srgb_from_adapted_(srgb_from_adapted_xyz() / headroom) {
  if (!(headroom >= 1 && headroom <= 100)) {
    throw std::invalid_argument("the display's white is 1 to 100 times as light as the room's");
  }
  const double white = 100 * headroom;
  white_lightness_ = ciecam02_forward({white, white, white}, display_).lightness;
}

Vector3d Display::linear_srgb(double lightness, double chroma, double hue_deg) const {
  const RelativeXyz xyz = ciecam02_inverse({lightness, chroma, hue_deg}, display_);
  return srgb_from_adapted_ * Vector3d(xyz.x, xyz.y, xyz.z);
}

/// How far linear sRGB is within 0..1; negative outside.
double Display::room_in_gamut(double lightness, double chroma, double hue_deg) const {
  try {
    const Vector3d rgb = linear_srgb(lightness, chroma, hue_deg);
    return std::min(rgb.minCoeff(), 1 - rgb.maxCoeff()) + kInGamut;
  } catch (const std::domain_error&) {
    return kOutside;
  }
}

/// `wished`, or where the gamut is first left on the way there.
double Display::largest_chroma(double lightness, double hue_deg, double wished) const {
  double inside = 0, outside = 0, room_inside = kUnknown, room_outside = 0;
  for (double c = std::min(wished, kNoReturn);; c = std::min(wished, c + kChromaStep)) {
    room_outside = room_in_gamut(lightness, c, hue_deg);
    if (room_outside < 0) {
      outside = c;
      break;
    }
    inside = c;
    room_inside = room_outside;
    if (c >= wished) return wished;
  }
  if (room_inside == kUnknown) room_inside = room_in_gamut(lightness, 0, hue_deg);
  if (room_inside < 0) return 0;
  // The Illinois variant of regula falsi: both ends close in.
  for (int side = 0; outside - inside > kChromaError;) {
    const double line = inside + (outside - inside) * room_inside / (room_inside - room_outside);
    const bool useless = !(line > inside && line < outside);
    const double c = useless ? (inside + outside) / 2 : line;
    if (c <= inside || c >= outside) break;
    const double room = room_in_gamut(lightness, c, hue_deg);
    if (room == 0) return c;
    if (room > 0) {
      inside = c;
      room_inside = room;
      if (side > 0) room_outside /= 2;
      side = 1;
    } else {
      outside = c;
      room_outside = room;
      if (side < 0) room_inside /= 2;
      side = -1;
    }
  }
  return inside;
}

DisplayedPixel Display::show(const RelativeXyz& xyz) const {
  const Correlates seen = ciecam02_forward(xyz, room_);
  const bool no_chroma = seen.status.no_chroma_denominator;
  DisplayedPixel pixel;
  if (!seen.status.negative_achromatic) {
    pixel = show_look({seen.lightness, no_chroma ? kMostChroma : seen.chroma, seen.hue_deg});
  }
  pixel.chroma = seen.chroma;
  pixel.hue_deg = seen.hue_deg;
  pixel.undefined = !seen.status.all_defined();
  return pixel;
}

DisplayedPixel Display::show_look(const LightnessChromaHue& look) const {
  DisplayedPixel pixel{.lightness = look.lightness, .chroma = look.chroma, .hue_deg = look.hue_deg};
  if (!(look.lightness > 0)) return pixel;
  pixel.too_light = look.lightness > white_lightness_;
  pixel.lightness_shown = std::min(look.lightness, white_lightness_);
  pixel.chroma_shown = largest_chroma(pixel.lightness_shown, look.hue_deg, look.chroma);
  pixel.less_chroma = pixel.chroma_shown < look.chroma;
  pixel.srgb = srgb_encoded(linear_srgb(pixel.lightness_shown, pixel.chroma_shown, look.hue_deg));
  return pixel;
}

}  // namespace appearance
