#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>

#include "appearance/spectra/reconstruct.h"
#include "appearance/spectra/tristimulus.h"

namespace spectra {

/// Under which light and by which observer a colour is stated.
struct StatedWhite {
  std::string illuminant = "D65";  ///< of illuminant_names()
  int observer_deg = 2;            ///< 2 or 10

  bool operator==(const StatedWhite&) const = default;
};

/// "D65/2", "d50 / 10", "D65/10deg"; nothing if it is none of the illuminants and observers.
[[nodiscard]] std::optional<StatedWhite> parse_white(std::string_view text);
[[nodiscard]] std::string to_string(const StatedWhite& white);

/// X, Y, Z of a perfect diffuser, Y = 100, by the sums over the bands of the transport grid, and by
/// those at 1 nm, which published whites agree with.
[[nodiscard]] RelativeXyz band_white(const StatedWhite& white);
[[nodiscard]] RelativeXyz published_white(const StatedWhite& white);

/// X, Y, Z of a reflectance on the transport grid.
/// @throws std::invalid_argument  on any other grid
[[nodiscard]] RelativeXyz xyz_under(const StatedWhite& white, const Spectrum& reflectance);

/// A colour as a catalogue states it: the X, Y, Z by the sums over the bands that have the stated
/// L*, a*, b* against the white of the bands. So the stated white itself is a flat reflectance,
/// whichever table of the white the catalogue was made with.
struct StatedColour {
  RelativeXyz xyz;
  StatedWhite white;
};

/// CIE 1976 L*, a*, b* [CIE15], turned round.
[[nodiscard]] StatedColour from_lab(const Eigen::Vector3d& lab, const StatedWhite& white);
/// Relative to the published white, Y = 100 for a perfect diffuser.
[[nodiscard]] StatedColour from_xyz(const RelativeXyz& xyz, const StatedWhite& white);
/// Chromaticity, and Y from 0 to 100. @throws std::invalid_argument  if y is not above 0
[[nodiscard]] StatedColour from_xy_y(double x, double y, double luminance,
                                     const StatedWhite& white);
/// Components from 0 to 1. @throws std::invalid_argument  outside
[[nodiscard]] StatedColour from_srgb(const Eigen::Vector3d& rgb);
/// A light reflectance value alone: the grey of that Y.
[[nodiscard]] StatedColour from_lrv(double lrv);

/// "#D8C9A7", with or without the mark, any case, or the short form "#DCA"; components 0 to 1.
[[nodiscard]] std::optional<Eigen::Vector3d> parse_hex(std::string_view text);

/// The smoothest reflectance of the colour, on the transport grid, exact by the sums over the
/// bands; black is 0 throughout.
[[nodiscard]] Reconstruction reconstruct_stated(const StatedColour& colour);

}  // namespace spectra
