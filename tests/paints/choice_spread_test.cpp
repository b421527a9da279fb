#include "paints/choice_spread.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/paints/sphere_room.h"

namespace paints {
namespace {

using spectra::ViewingChoices;

std::vector<spectra::LitRoom> sphere() {
  return {{.name = "", .weight = 1, .view = [](const spectra::Spectrum& paint) {
             spectra::ViewedLight light = test::sphere_room(paint).light;
             light.lamps = spectra::constant(paint.grid, 1);
             light.angle_deg = 50;
             return light;
           }}};
}

Target wish() {
  return target_of(
      appearance::on_swatch(load_atlas("munsell-nickerson").paints[230].reflectance).correlates);
}

SpreadOptions choices() {
  return {.choices = {{"as it is", {}, wish()},
                      {"white", {.white_share = 0.5}, wish()},
                      {"size", {.size_effect = true}, wish()}}};
}

TEST(ChoiceSpread, UnderOneChoiceIsTheRanking) {
  const Atlas atlas = load_atlas("munsell-nickerson");
  const std::vector<SpreadPaint> spread =
      spread_of(within_windows(atlas, wish(), {}), sphere(), choices());
  const std::vector<Choice> all = choices().choices;
  for (std::size_t c = 0; c < all.size(); ++c) {
    const std::vector<int> ranks = ranks_under(spread, c);
    const Ranking ranking = rank(atlas, wish(), sphere(), {.viewing = all[c].viewing});
    for (std::size_t i = 0; i < ranking.paints.size(); ++i) {
      const auto at = static_cast<std::size_t>(ranking.paints[i].paint - atlas.paints.data());
      EXPECT_EQ(ranks[at], static_cast<int>(i) + 1);
      EXPECT_EQ(spread[at].looks[c].distance, ranking.paints[i].distance);
    }
  }
}

TEST(ChoiceSpread, TheLargestDistanceIsOverAllChoices) {
  const Atlas atlas = load_atlas("munsell-nickerson");
  for (const SpreadPaint& p : spread_of(within_windows(atlas, wish(), {}), sphere(), choices())) {
    double largest = 0;
    for (const ChoiceLook& look : p.looks) largest = std::max(largest, look.distance);
    EXPECT_EQ(p.largest_distance(), largest);
  }
}

}  // namespace
}  // namespace paints
