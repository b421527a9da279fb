#pragma once
#include <string>
#include <utility>
#include <vector>

#include "appearance/ciede2000.h"
#include "paints/files/paint_file.h"

namespace paints {

/// A paint of a file as numbers for people: under D65, by the 2 degree observer, on the 31 bands.
struct ListedPaint {
  spectra::RelativeXyz xyz;  ///< y is its LRV
  appearance::Lab lab;
  Eigen::Vector3d srgb;  ///< components 0 to 1, cut where sRGB has no such colour
  bool in_srgb = true;   ///< nothing was cut
};

/// In the order of the file.
/// @throws spectra::InputError  if a spectrum does not cover the transport grid
[[nodiscard]] std::vector<ListedPaint> listed(const PaintFile& file);

/// Each paint whose reflectance is, number by number, that of an earlier one: (later, earlier).
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> duplicates(const PaintFile& file);

/// "#D8C9A7"
[[nodiscard]] std::string hex_code(const ListedPaint& paint);

}  // namespace paints
