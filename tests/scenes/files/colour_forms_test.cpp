// Reflectances and targets as colours.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "appearance/spectra/stated_colour.h"
#include "tests/scenes/room_files.h"

namespace scenes {
namespace {

Room room_with_target(const json& target) {
  json room = sample_room();
  room["paint"] = {{"surfaces", {"walls"}}, {"target", target}};
  return read_room(write_file("colour_form.json", room.dump()));
}

void expect_target(const json& target, const spectra::StatedColour& want) {
  const Room room = room_with_target(target);
  const auto& rho = std::get<spectra::Spectrum>(room.paint.front().target->colour);
  const spectra::RelativeXyz xyz = spectra::xyz_under(want.white, rho);
  EXPECT_NEAR(xyz.x, want.xyz.x, 1e-9) << target;
  EXPECT_NEAR(xyz.y, want.xyz.y, 1e-9) << target;
  EXPECT_NEAR(xyz.z, want.xyz.z, 1e-9) << target;
}

TEST(ColourForms, TargetsHaveTheColourThatIsStated) {
  expect_target({{"hex", "#D8C9A7"}}, spectra::from_srgb(*spectra::parse_hex("#D8C9A7")));
  expect_target({{"Lab", {81.2, 1.9, 19.8}}}, spectra::from_lab({81.2, 1.9, 19.8}, {}));
  expect_target({{"Lab", {81.2, 1.9, 19.8}}, {"illuminant", "D50"}, {"observer", 10}},
                spectra::from_lab({81.2, 1.9, 19.8}, {.illuminant = "D50", .observer_deg = 10}));
  expect_target({{"XYZ", {40, 42, 30}}}, spectra::from_xyz({40, 42, 30}, {}));
  expect_target({{"xyY", {0.35, 0.36, 42}}}, spectra::from_xy_y(0.35, 0.36, 42, {}));
  expect_target({{"LRV", 42}}, spectra::from_lrv(42));
}

TEST(ColourForms, MunsellIsAChipOfTheRenotation) {
  const Room by_munsell = room_with_target({{"munsell", "10R 7/6"}});
  const Room by_name = room_with_target({{"paint", "munsell-renotation:10R 7/6"}});
  EXPECT_EQ(by_munsell.paint[0].target->name, by_name.paint[0].target->name);
}

TEST(ColourForms, OthersAreFaults) {
  for (const json& bad :
       {json{{"hex", "#GG0000"}}, json{{"Lab", {120, 0, 0}}}, json{{"Lab", {50, 120, -120}}},
        json{{"Lab", {50, 0}}}, json{{"Lab", {50, 0, 0}}, {"observer", 4}},
        json{{"Lab", {50, 0, 0}}, {"illuminant", "F11"}}, json{{"xyY", {0.3, 0, 40}}},
        json{{"LRV", 120}}, json{{"munsell", "10R 7/66"}}, json{{"hex", "#808080"}, {"LRV", 10}}}) {
    const auto faults = faults_of([&] { (void)room_with_target(bad); });
    EXPECT_EQ(faults.size(), 1U) << bad;
    EXPECT_THAT(faults.front().pointer, testing::HasSubstr("/paint/target")) << bad;
  }
}

}  // namespace
}  // namespace scenes
