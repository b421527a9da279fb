#pragma once
#include <string>

#include "appearance/spectra/spectrum_library.h"

namespace spectra {

enum class CurveKind { reflectance, light };

/// A CSV file of curves, one per row: header `name,400,410,...` (wavelengths in nm, strictly
/// rising).
struct SpectrumFile {
  SpectrumSet set;  ///< set.name is the path as given
  bool percent =
      false;  ///< reflectances were given in percent (some value above 1.5) and divided by 100
};

/// @throws FileError   if it cannot be read
/// @throws InputError  with every fault: no header, bad number, out of range, duplicate name,
/// ragged row
[[nodiscard]] SpectrumFile read_spectrum_file(const std::string& path, CurveKind kind);

}  // namespace spectra
