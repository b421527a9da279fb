#pragma once
#include "scenes/luminaires/luminaire.h"
#include "scenes/luminaires/number_stream.h"

namespace scenes {

/// Position of the lamp, count, angles and factors, as they follow TILT=INCLUDE or fill a file of
/// their own [LM63]. Faults go to the stream; what is returned after one has no meaning.
[[nodiscard]] Tilt read_tilt(NumberStream& stream, LuminaireFaults& faults);

}  // namespace scenes
