#include "apps/pictures/half_floats.h"

#include <Imath/half.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <vector>

namespace apps {
namespace {

std::vector<std::uint16_t> all_halves() {
  std::vector<std::uint16_t> bits(1 << 16);
  for (std::size_t i = 0; i < bits.size(); ++i) bits[i] = static_cast<std::uint16_t>(i);
  return bits;
}

std::vector<float> as_floats(const std::vector<std::uint16_t>& halves) {
  std::vector<float> floats(halves.size());
  floats_from_halves(halves.data(), static_cast<int>(halves.size()), floats.data());
  return floats;
}

std::vector<std::uint16_t> as_halves(const std::vector<float>& floats) {
  std::vector<std::uint16_t> halves(floats.size());
  halves_from_floats(floats.data(), static_cast<int>(floats.size()), halves.data());
  return halves;
}

// The library that reads the files converts too: one by one, and slower.
TEST(HalfFloats, EveryHalfIsTheFloatOfTheLibrary) {
  const std::vector<float> floats = as_floats(all_halves());
  for (const std::uint16_t bits : all_halves()) {
    half wanted;
    wanted.setBits(bits);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(floats[bits]),
              std::bit_cast<std::uint32_t>(static_cast<float>(wanted)));
  }
}

TEST(HalfFloats, EveryHalfComesBack) {
  EXPECT_EQ(as_halves(as_floats(all_halves())), all_halves());
}

TEST(HalfFloats, RoundsAsTheLibraryAtAndBesideEveryTie) {
  const std::vector<float> ordered = as_floats(all_halves());
  std::vector<float> floats{0.0F, 1e-30F, 1e30F, INFINITY};
  for (std::size_t i = 0; i < 0x7c00; ++i) {  // positive finite halves, in order
    const float next = i + 1 < 0x7c00 ? ordered[i + 1] : 65536;
    const float tie = (ordered[i] + next) / 2;
    for (const float f : {tie, std::nextafter(tie, 0.0F), std::nextafter(tie, next)}) {
      floats.insert(floats.end(), {f, -f});
    }
  }
  const std::vector<std::uint16_t> halves = as_halves(floats);
  for (std::size_t i = 0; i < floats.size(); ++i) {
    EXPECT_EQ(halves[i], half(floats[i]).bits()) << floats[i];
  }
  EXPECT_TRUE(std::isinf(as_floats(as_halves({kInfiniteHalf}))[0]));
  EXPECT_EQ(as_floats(as_halves({std::nextafter(kInfiniteHalf, 0.0F)}))[0], 65504);
}

}  // namespace
}  // namespace apps
