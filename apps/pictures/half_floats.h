#pragma once
#include <cstdint>

namespace apps {

/// From here on a float is infinite as a half: 65520 lies half-way between the largest half, 65504,
/// and 2^16, and rounds up.
inline constexpr float kInfiniteHalf = 65520;

/// Binary numbers of 16 bits (IEEE 754) to floats, exactly; bits of NaN are kept.
void floats_from_halves(const std::uint16_t* halves, int count, float* floats);

/// Floats to the nearest halves, ties to even. Halves that went through floats come back the same,
/// NaN too.
void halves_from_floats(const float* floats, int count, std::uint16_t* halves);

}  // namespace apps
