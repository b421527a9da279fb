#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "appearance/display.h"
#include "appearance/spectra/grid.h"
#include "apps/pictures/png.h"
#include "apps/pictures/spectral_exr.h"
#include "solver/rooms/room_picture.h"

namespace apps {

/// What of a picture is kept in memory: a row per pixel, from the top left.
struct RoomImage {
  int width = 0, height = 0;
  Eigen::Array<float, Eigen::Dynamic, 3, Eigen::RowMajor> xyz;  ///< y in cd m^-2
  Eigen::ArrayXf illuminance_lx;
};

/// Takes the picture row by row; its spectra go into `exr` alone, if there is one.
[[nodiscard]] RoomImage take_picture(const solver::RoomPicture& picture, int width, int height,
                                     const spectra::Grid& grid, SpectralExr* exr = nullptr);

/// Bytes that a picture takes at its making, from above.
[[nodiscard]] std::int64_t picture_bytes(std::int64_t width, std::int64_t height, int bands,
                                         ExrNumbers numbers);

/// As a camera sees it whose film is balanced for daylight.
struct Photograph {
  PngPicture png;
  double exposure = 0;           ///< linear sRGB per cd m^-2
  std::int64_t desaturated = 0;  ///< pixels outside the gamut, or brighter than white
  std::int64_t white = 0;        ///< of those, pixels at or above the luminance of white
};

/// @param white_cd_m2  what is to get Y = 0.8
[[nodiscard]] Photograph photograph(const RoomImage& image, double white_cd_m2, int bits,
                                    int threads);

/// As the eye sees it that is adapted to the room.
struct SeenPicture {
  PngPicture png;
  std::int64_t too_light = 0, less_chroma = 0, undefined = 0;  ///< pixels; appearance/display.h
  double largest_reduction = 0;                                ///< of C
};

/// @param white_cd_m2  of the room's adopted white
[[nodiscard]] SeenPicture seen_picture(const RoomImage& image, const appearance::Display& display,
                                       double white_cd_m2, int bits, int threads);

}  // namespace apps
