#pragma once
#include <string>
#include <vector>

#include "appearance/spectra/spectrum.h"

namespace paints {

struct Paint {
  std::string name;
  spectra::Spectrum reflectance;  ///< on the grid that was asked for, 0 <= rho < 1
  std::string label;              ///< a hint for people, may be empty
};

struct Atlas {
  std::string name;
  std::string source;
  bool reconstructed = false;
  bool percent = false;            ///< a file gave percent; it was divided by 100
  std::vector<std::string> notes;  ///< what was assumed in reading the file
  std::vector<Paint> paints;
};

/// A compiled-in atlas by name, else a file by path and choices (paints/files/paint_reader.h).
/// @throws spectra::InputError  a faulty file, or wavelengths that do not cover the grid
/// @throws spectra::FileError   neither an atlas nor a readable file
[[nodiscard]] Atlas load_atlas(const std::string& name_or_path,
                               const spectra::Grid& grid = spectra::kTransportGrid);

/// @throws spectra::InputError  if the curves of the file at `path` do not cover the grid
void require_coverage(const std::string& path, const spectra::Samples& curve,
                      const spectra::Grid& grid);

}  // namespace paints
