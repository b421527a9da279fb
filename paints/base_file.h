#pragma once
#include <string>

#include "paints/mixing.h"

namespace paints {

/// What a shop has: the paints as they come, and the same as ingredients.
struct Ingredients {
  Atlas atlas;
  BaseSet set;
  bool two_constant = false;  ///< K and S were given, not taken from reflectances
};

/// A compiled-in atlas by name or a CSV file by path, as load_atlas reads it; but a CSV file that
/// holds a base's K and S in two rows, "NAME K" and "NAME S", is read as such pairs (both above 0,
/// any unit as long as it is the same), and its atlas holds each base as an opaque film of its own.
/// @throws spectra::InputError  a faulty file, a row without its partner, or wavelengths that do
/// not
///                              cover the grid
/// @throws spectra::FileError   neither an atlas nor a readable file
[[nodiscard]] Ingredients load_ingredients(const std::string& name_or_path,
                                           const Saunderson& surface = {},
                                           const spectra::Grid& grid = spectra::kTransportGrid);

}  // namespace paints
