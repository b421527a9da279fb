#include "apps/pictures/half_floats.h"

#include <bit>

namespace apps {
namespace {

// A half has 5 bits of exponent (bias 15) and 10 of fraction, a float 8 (bias 127) and 23. Every
// case is computed and one is chosen, without branches, so that the loops are vectorised; for AVX2
// too, which doubles their speed and gives the same bits.
constexpr std::uint32_t kExponents = 0x0f800000;  // of a half moved into the place of a float's
constexpr std::uint32_t kRebias = (127 - 15) << 23;
constexpr float kSmallestNormal = 0x1p-14F;

std::uint32_t choose(bool first, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t mask = 0U - static_cast<std::uint32_t>(first);
  return (a & mask) | (b & ~mask);
}

}  // namespace

__attribute__((target_clones("avx2", "default"))) void floats_from_halves(
    const std::uint16_t* __restrict halves, int count, float* __restrict floats) {
  for (int i = 0; i < count; ++i) {
    const std::uint32_t half = halves[i];
    const std::uint32_t moved = (half & 0x7fff) << 13, exponent = moved & kExponents;
    // Without exponent the fraction counts steps of 2^-24: put behind 2^-14, then that taken away.
    const float small = std::bit_cast<float>(moved + kRebias + (1U << 23)) - kSmallestNormal;
    const std::uint32_t normal = moved + kRebias, special = moved + 2 * kRebias;
    const std::uint32_t magnitude = choose(exponent == 0, std::bit_cast<std::uint32_t>(small),
                                           choose(exponent == kExponents, special, normal));
    floats[i] = std::bit_cast<float>(magnitude | (half & 0x8000) << 16);
  }
}

__attribute__((target_clones("avx2", "default"))) void halves_from_floats(
    const float* __restrict floats, int count, std::uint16_t* __restrict halves) {
  for (int i = 0; i < count; ++i) {
    const auto bits = std::bit_cast<std::uint32_t>(floats[i]);
    const std::uint32_t magnitude = bits & 0x7fffffff;
    // Behind 0.5 a float has steps of 2^-24, those of the smallest halves: the sum rounds to them.
    const std::uint32_t small =
        std::bit_cast<std::uint32_t>(std::bit_cast<float>(magnitude) + 0.5F) -
        std::bit_cast<std::uint32_t>(0.5F);
    const std::uint32_t normal = (magnitude - kRebias + 0xfff + (magnitude >> 13 & 1)) >> 13;
    const std::uint32_t nan = 0x7c00 | (magnitude >> 13 & 0x3ff);
    // As whole numbers, which order magnitudes as the floats do.
    const auto order = static_cast<std::int32_t>(magnitude);
    constexpr auto kInfinite = std::bit_cast<std::int32_t>(kInfiniteHalf);
    const std::uint32_t half =
        choose(order < std::bit_cast<std::int32_t>(kSmallestNormal), small,
               choose(order < kInfinite, normal, choose(order <= 0x7f800000, 0x7c00, nan)));
    halves[i] = static_cast<std::uint16_t>(half | (bits >> 16 & 0x8000));
  }
}

}  // namespace apps
