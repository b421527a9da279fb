#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace apps {

/// A picture in sRGB, rows from the top, r, g, b by turns.
struct PngPicture {
  int width = 0, height = 0;
  int bits = 8;                                            ///< of a sample, 8 or 16
  std::vector<std::uint16_t> samples;                      ///< 0 to 2^bits - 1
  std::vector<std::pair<std::string, std::string>> texts;  ///< keyword, text
};

/// A file in PNG with the chunks sRGB (perceptual intent), gAMA and cHRM.
/// @throws std::runtime_error  if libpng cannot write it
[[nodiscard]] std::string png_file(const PngPicture& picture);

/// 0..1 to the nearest sample, ties to even.
[[nodiscard]] std::uint16_t png_sample(double value, int bits);

}  // namespace apps
