// What a room file says of white, background, size and swatch, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "appearance/spectra/photometry.h"
#include "tests/scenes/room_files.h"

namespace scenes {
namespace {

using testing::HasSubstr;

json seen_so(const json& view) {
  json file = sample_room();
  file["view"] = view;
  return file;
}

json with_target(const json& keys) {
  json file = sample_room();
  file["paint"]["target"].update(keys);
  return file;
}

json shop() {
  return {{"spectrum", {{"illuminant", "A"}}},
          {"illuminance_lx", 800},
          {"Y_b", 30},
          {"surround", "dim"}};
}

TEST(RoomSeeing, WhiteIsANameOrAShare) {
  EXPECT_EQ(read(seen_so({{"white", "ideal"}})).viewing.white_share, 1);
  EXPECT_EQ(read(seen_so({{"white", "lamps"}})).viewing.white_share, 0);
  EXPECT_EQ(read(seen_so({{"white", {{"share", 0.5}}}})).viewing.white_share, 0.5);
}

TEST(RoomSeeing, BackgroundIsANameOrANumber) {
  const spectra::ViewingChoices viewing = read(seen_so({{"background", 18}})).viewing;
  EXPECT_EQ(viewing.background, spectra::Background::fixed);
  EXPECT_EQ(viewing.background_y, 18);
}

TEST(RoomSeeing, SizeEffectIsOffOnOrOfAnAngle) {
  EXPECT_FALSE(read(sample_room()).viewing.size_effect);
  EXPECT_FALSE(read(seen_so({{"size_effect", false}})).viewing.size_effect);
  const Room room = read(seen_so({{"size_effect", true}}));
  EXPECT_TRUE(room.viewing.size_effect);
  EXPECT_THAT(room.notes, testing::Contains(HasSubstr("unverified constants")));
  EXPECT_EQ(read(seen_so({{"size_effect", {{"angle_deg", 60}}}})).viewing.angle_deg, 60);
}

TEST(RoomSeeing, ASwatchIsHeldSomewhereAndHasASize) {
  EXPECT_EQ(read(sample_room()).paint[0].target->seen, SwatchPlace::standard);
  EXPECT_EQ(read(with_target({{"seen", "here"}})).paint[0].target->seen, SwatchPlace::here);
  const Room room = read(with_target({{"seen", shop()}, {"angle_deg", 10}}));
  const TargetColour& target = *room.paint[0].target;
  EXPECT_EQ(target.name, "munsell-nickerson:231");
  EXPECT_EQ(target.angle_deg, 10);
  EXPECT_EQ(target.seen, SwatchPlace::own);
  EXPECT_EQ(target.own.background_y, 30);
  EXPECT_EQ(target.own.surround, spectra::Surround::dim);
  EXPECT_NEAR(spectra::luminous(target.own.irradiance), 800, 1e-9);
}

struct Refusal {
  json file;
  std::string pointer, word;
};

TEST(RoomSeeing, WhatIsOutsideIsRefusedWithItsPlace) {
  json half = shop();
  half.erase("Y_b");
  json nothing = sample_room();
  nothing["view"] = {{"white", "surfaces"}};
  nothing["paint"]["target"]["seen"] = "here";
  json correlates = sample_room();
  correlates["paint"]["target"] = {{"J", 50}, {"C", 20}, {"h_deg", 30}, {"seen", "here"}};
  json no_wall = with_target({{"seen", "here"}});
  no_wall["paint"]["surfaces"] = {"ceiling"};
  no_wall.erase("view");
  for (const Refusal& r : {
           Refusal{seen_so({{"white", {{"share", 1.5}}}}), "/view/white/share", "1.5"},
           Refusal{seen_so({{"white", {{"share", -0.1}}}}), "/view/white/share", "-0.1"},
           Refusal{seen_so({{"white", {{"share", 0.5}, {"part", 1}}}}), "/view/white/part",
                   "unknown"},
           Refusal{seen_so({{"white", "lamp"}}), "/view/white", "lamp"},
           Refusal{seen_so({{"background", 0}}), "/view/background", "0"},
           Refusal{seen_so({{"background", 120}}), "/view/background", "120"},
           Refusal{seen_so({{"size_effect", {{"angle_deg", 0}}}}), "/view/size_effect/angle_deg",
                   "0"},
           Refusal{seen_so({{"size_effect", {{"angle_deg", 181}}}}), "/view/size_effect/angle_deg",
                   "181"},
           Refusal{seen_so({{"size_effect", 60}}), "/view/size_effect", "no size effect"},
           Refusal{with_target({{"angle_deg", 0}}), "/paint/target/angle_deg", "0"},
           Refusal{with_target({{"seen", "there"}}), "/paint/target/seen", "there"},
           Refusal{with_target({{"seen", half}}), "/paint/target/seen", "Y_b"},
           Refusal{nothing, "/paint/target/seen", "viewed point"},
           Refusal{correlates, "/paint/target", "no swatch"},
           Refusal{no_wall, "/paint/surfaces", "where the eye looks"},
       }) {
    SCOPED_TRACE(r.pointer);
    const std::vector<spectra::Fault> faults = faults_of([&] { (void)read(r.file); });
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0].pointer, r.pointer);
    EXPECT_THAT(faults[0].problem, HasSubstr(r.word));
    EXPECT_FALSE(faults[0].remedy.empty());
  }
}

}  // namespace
}  // namespace scenes
