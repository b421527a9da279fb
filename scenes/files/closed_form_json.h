#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "appearance/spectra/spectrum.h"

namespace scenes {

/// The radiosity that part `of` shall have, to be reached by the reflectance of part `by`.
struct WishedPart {
  int of = 0, by = 0;
  spectra::Spectrum radiosity;  ///< W m^-2 nm^-1
};

/// Faces in the order x0, x1, y0, y1, z0, z1: 0-1, 2-3, 4-5 are opposite. On the closed-form grid.
struct CubeFile {
  bool exact_form_factors = false;  ///< false: 0.2 for every pair, as printed in [Neumann2004]
  std::array<spectra::Spectrum, 6> reflectance, emission;
  std::optional<WishedPart> wished;
  std::vector<std::string> notes;
};

/// Window wall at y = 0, then wall_1 at x = width, wall_2 at y = depth, wall_3 at x = 0.
struct BrickFile {
  double width_m = 0, depth_m = 0, height_m = 0;
  double furniture_height = 0;  ///< share of the wall's height, 0 <= share < 1
  double window_width_m = 0, window_height_m = 0, window_sill_m = 0, window_offset_m = 0;
  /// In the order of kBrickParts.
  std::vector<spectra::Spectrum> reflectance, emission;
  std::optional<WishedPart> wished;
  std::vector<std::string> notes;
};

inline constexpr std::array kCubeFaces{"x0", "x1", "y0", "y1", "z0", "z1"};

inline constexpr std::array kBrickParts{"floor",       "ceiling",    "window_wall", "window",
                                        "wall_1",      "wall_2",     "wall_3",      "furniture_1",
                                        "furniture_2", "furniture_3"};

/// @throws spectra::FileError, spectra::InputError  with every fault
[[nodiscard]] CubeFile read_cube(const std::string& path);
[[nodiscard]] BrickFile read_brick(const std::string& path);

}  // namespace scenes
