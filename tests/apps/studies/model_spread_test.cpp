// What is told of the model's own error bar, from looks that are given.
#include "apps/studies/model_spread.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/pictures/model_spread_picture.h"
#include "apps/reports/model_spread_report.h"

namespace apps {
namespace {

using testing::HasSubstr;
using testing::Not;

/// The eight stated choices; a paint that moves by (3, 4) in a_C and b_C with the white, by 2 in J
/// with the background and by 7 in J with the size effect.
ModelSpread spread() {
  ModelSpread spread{.choices = model_choices({}, [](const auto&) { return paints::Target{}; }),
                     .rows = {{.name = "paint", .looks = {}, .ranks = {}}},
                     .winners = {}};
  for (std::size_t c = 0; c < kStatedChoices; ++c) {
    const spectra::ViewingChoices& viewing = spread.choices.all[c].viewing;
    paints::ChoiceLook look;
    look.correlates.lightness = 50;
    if (viewing.background == spectra::Background::fixed) look.correlates.lightness += 2;
    if (viewing.size_effect) look.correlates.lightness += 7;
    if (viewing.white_share == 0.5) look.correlates.a_c = 3, look.correlates.b_c = 4;
    spread.rows[0].looks.push_back(look);
  }
  return spread;
}

TEST(ModelSpread, MovesAreThoseOfOneChoiceAtATime) {
  const ModelSpread::Moves moves = spread().moves();
  EXPECT_DOUBLE_EQ(moves.white, 5);
  EXPECT_DOUBLE_EQ(moves.background, 2);
  EXPECT_DOUBLE_EQ(moves.size, 7);
  EXPECT_EQ(moves.undefined, 0);
}

TEST(ModelSpread, SaysWhereTheModelSaysNothing) {
  ModelSpread partly = spread();
  partly.rows[0].looks[3].correlates.status.negative_achromatic = true;
  EXPECT_EQ(partly.moves().undefined, 1);
  EXPECT_THAT(model_spread_text(partly, "it"), HasSubstr("not define it under 1 of 8 choices"));
  EXPECT_THAT(model_spread_text(spread(), "it"), Not(HasSubstr("not define")));
  const auto marks = [](const ModelSpread& told) {
    const std::string svg = model_spread_picture("room", told);
    int count = 0;
    for (auto at = svg.find("<circle"); at != std::string::npos; at = svg.find("<circle", at + 1)) {
      ++count;
    }
    return count;
  };
  EXPECT_EQ(marks(spread()), 8);
  EXPECT_EQ(marks(partly), 7);
}

TEST(ModelSpread, TellsInWordsWhatMovesAndWhatIsBest) {
  ModelSpread ranked = spread();
  ranked.winners = {"a", "b", "a", "c", "a", "b", "a", "a"};
  const std::string text = model_spread_text(ranked, "the best paint");
  EXPECT_THAT(text, HasSubstr("the choice of the white moves the best paint by up to 5.0"));
  EXPECT_THAT(text, HasSubstr("3 paints are best under some choice: a, b, c"));
}

TEST(ModelSpread, AChoiceBesideTheEightIsANinth) {
  const auto nothing = [](const auto&) { return paints::Target{}; };
  EXPECT_EQ(model_choices({}, nothing).all.size(), 8U);
  const ModelChoices nine = model_choices({.white_share = 0.3}, nothing);
  EXPECT_EQ(nine.all.size(), 9U);
  EXPECT_EQ(nine.all[nine.asked].viewing.white_share, 0.3);
}

}  // namespace
}  // namespace apps
