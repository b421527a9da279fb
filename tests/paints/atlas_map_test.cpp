#include "paints/atlas_map.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/photometry.h"

namespace paints {
namespace {

using spectra::Spectrum;

Atlas papers(std::size_t step) {
  const Atlas all = load_atlas("munsell-nickerson");
  Atlas some{.name = "some", .source = "test"};
  for (std::size_t i = 0; i < all.paints.size(); i += step) some.paints.push_back(all.paints[i]);
  return some;
}

/// A swatch under some light, with a wall that reflects into itself by `share`.
std::vector<spectra::LitRoom> swatch_under(const char* illuminant, double share) {
  const Spectrum light = spectra::scaled_to_luminous(
      spectra::light_on(spectra::kTransportGrid, spectra::illuminant(illuminant)), 2000);
  return {{.view = [=](const Spectrum& paint) {
    const Eigen::ArrayXd white = light.values / (1 - share * paint.values);
    return spectra::ViewedLight{.sample = {light.grid, white * paint.values},
                                .background = {light.grid, light.values * 0.2},
                                .field = light,
                                .white = light};
  }}};
}

// In the standard condition itself nothing moves, and every chip is its own order.
TEST(AtlasMap, StandardConditionMovesNothing) {
  const Atlas atlas = papers(7);
  const auto room = swatch_under("D65", 0);
  const std::vector<MappedChip> chips = map_atlas(atlas, room);
  ASSERT_EQ(chips.size(), atlas.paints.size());
  for (const MappedChip& chip : chips) EXPECT_LT(chip.seen.front().distance, 1e-9);
  for (const Order& order : orders(chips, room)) EXPECT_EQ(order.ordered, order.wished);
}

// The order is what ranking the atlas for that swatch puts first.
TEST(AtlasMap, OrdersAreTheWinnersOfRankings) {
  const Atlas atlas = papers(11);
  const auto room = swatch_under("A", 0.6);
  const std::vector<MappedChip> chips = map_atlas(atlas, room);
  int moved = 0;
  for (const Order& order : orders(chips, room)) {
    const Ranking ranking = rank(atlas, target_of(chips[order.wished].swatch.correlates), room);
    EXPECT_EQ(chips[order.ordered].paint, ranking.paints.front().paint);
    EXPECT_EQ(order.distance, ranking.paints.front().distance);
    moved += order.ordered != order.wished ? 1 : 0;
  }
  EXPECT_GT(moved, 0);
}

}  // namespace
}  // namespace paints
