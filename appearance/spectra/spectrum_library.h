#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "appearance/spectra/spectrum.h"

namespace spectra {

/// A curve with the name by which room files and reports call it.
struct NamedSpectrum {
  std::string name;   ///< "117", "5YR 8/4"
  Samples samples;    ///< reflectance as a fraction, or relative power of a lamp
  std::string label;  ///< for people: the nearest renotation chip, or the maker's label of a lamp
};

/// A table of curves: an atlas of paints, or a collection of lamps.
struct SpectrumSet {
  std::string name;  ///< "munsell-nickerson"
  std::string source;
  bool reconstructed = false;  ///< curves were computed from colours, not measured
  std::vector<NamedSpectrum> entries;
};

/// Compiled-in atlases: "munsell-nickerson" (462 measured papers, 001..462), "munsell-renotation"
/// (2724 chips, reconstructed on first use; `source` counts those left out because no reflectance
/// has their colour). Loaded once; the reference stays valid.
/// @throws std::invalid_argument  naming the known atlases
[[nodiscard]] const SpectrumSet& atlas(std::string_view name);
[[nodiscard]] const std::vector<std::string>& atlas_names();

/// Compiled-in lamps: "houser", 401 measured lamps counted from 1.
[[nodiscard]] const SpectrumSet& lamps(std::string_view name);
[[nodiscard]] const std::vector<std::string>& lamp_set_names();

/// "ATLAS:NAME" or "LAMPS:NUMBER"; numbers with or without leading zeros.
/// @throws std::invalid_argument  saying which part is unknown, and the nearest names
struct SetAndSpectrum {
  const SpectrumSet* set = nullptr;
  const NamedSpectrum* spectrum = nullptr;
};

[[nodiscard]] SetAndSpectrum find_paint(std::string_view qualified_name);
[[nodiscard]] SetAndSpectrum find_lamp(std::string_view qualified_name);

}  // namespace spectra
