#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/pictures/relit_strip.h"

namespace apps {

/// One picture of an OpenEXR file.
struct ExrPart {
  std::string name;  ///< empty in a file of one part
  int width = 0, height = 0;
  bool relit = false;  ///< false: it has not all of R, G and B, or is deep, and was copied
};

struct ExrReport {
  std::vector<ExrPart> parts;
  PixelStatistics statistics;  ///< of all relit parts, at full resolution
};

/// Copies an OpenEXR file with each pixel (R, G, B) replaced by matrix * pixel. All else stays:
/// other channels and parts, header, pixel types, compression, tiles and their reduced levels
/// (relit too). Memory is bounded, whatever the size of the picture; the copy has the same bits for
/// any number of threads.
/// @throws spectra::FileError   if `in` cannot be opened, or `out` not written
/// @throws spectra::InputError  if `in` is no complete OpenEXR file or nothing in it can be relit
ExrReport relight_exr(const std::filesystem::path& in, const std::filesystem::path& out,
                      const Eigen::Matrix3d& matrix, int threads);

}  // namespace apps
