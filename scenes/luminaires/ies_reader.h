#pragma once
#include "scenes/luminaires/luminaire.h"
#include "scenes/luminaires/luminaire_text.h"

namespace scenes {

/// IES LM-63 of 1986, 1991, 1995, 2002 and 2019 [LM63].
/// @throws spectra::InputError  with every fault of the file
[[nodiscard]] Luminaire read_ies(const LuminaireText& text);

}  // namespace scenes
