#pragma once
#include "scenes/luminaires/luminaire.h"
#include "scenes/luminaires/luminaire_text.h"

namespace scenes {

/// EULUMDAT [Stockmar1990]: one value a line. Of several sets of lamps the first is taken.
/// @throws spectra::InputError  with every fault of the file
[[nodiscard]] Luminaire read_eulumdat(const LuminaireText& text);

}  // namespace scenes
