#pragma once
#include <Eigen/Core>

#include "appearance/ciecam02.h"

namespace appearance {

/// A pixel as an eye sees it in the room, and how a display shows it.
struct DisplayedPixel {
  double lightness = 0, chroma = 0, hue_deg = 0;  ///< J, C, h in the room
  double lightness_shown = 0, chroma_shown = 0;
  Eigen::Vector3d srgb = Eigen::Vector3d::Zero();  ///< encoded, 0..1
  bool too_light = false;                          ///< shown as light as the display's white
  bool less_chroma = false;  ///< out of the display's gamut: C was reduced, J and h kept
  bool undefined = false;    ///< A < 0, shown black; or no finite C, shown with the largest
};

/// Shows colours of a room on an sRGB display so that they look the same: CIECAM02 forward under
/// the room's conditions, inverse under the display's. These are: white (0.3127, 0.3290) of 80
/// cd/m^2, room light 64 lx, so an average surround, L_A 16 cd/m^2, Y_b 20, and an eye wholly
/// adapted (D = 1), so that grey is shown grey.
///
/// What is lighter than the display's white is shown as light as it. C is reduced at constant J and
/// h to where linear sRGB first leaves 0..1 as C rises.
class Display {
 public:
  /// @param headroom  how many times lighter than the room's white the display's is, 1 or above
  /// @throws std::domain_error  as `adapt`; std::invalid_argument  if headroom is below 1
  explicit Display(const ViewingConditions& room, double headroom = kHeadroom);

  /// 10/9: a white wall in coloured light keeps its tinge, which the display's own white cannot
  /// have.
  static constexpr double kHeadroom = 10.0 / 9;

  /// @param xyz  relative to the room's white
  /// @throws std::domain_error  if it is not finite
  [[nodiscard]] DisplayedPixel show(const spectra::RelativeXyz& xyz) const;

  /// Whatever looks so in the room.
  [[nodiscard]] DisplayedPixel show_look(const LightnessChromaHue& look) const;

 private:
  [[nodiscard]] Eigen::Vector3d linear_srgb(double lightness, double chroma, double hue_deg) const;
  [[nodiscard]] double room_in_gamut(double lightness, double chroma, double hue_deg) const;
  [[nodiscard]] double largest_chroma(double lightness, double hue_deg, double wished) const;

  Adaptation room_, display_;
  Eigen::Matrix3d srgb_from_adapted_;  ///< of the display's eye, headroom included
  double white_lightness_ = 100;
};

/// The transfer function of sRGB, 0..1 to 0..1; what is outside is clipped first.
[[nodiscard]] Eigen::Vector3d srgb_encoded(const Eigen::Vector3d& linear);

/// Linear sRGB (D65) of a stimulus with white at Y = 1, by the unrounded primaries.
[[nodiscard]] Eigen::Vector3d linear_srgb_of(const Eigen::Vector3d& xyz);

/// Linear sRGB that a medium of 0..1 can hold: a colour outside is mixed with the grey of its own
/// luminance, as little as possible; one that is as luminous as white, or more, is white.
struct Desaturated {
  Eigen::Vector3d linear;
  bool changed = false;
};

[[nodiscard]] Desaturated desaturated(const Eigen::Vector3d& linear);

}  // namespace appearance
