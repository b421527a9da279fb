// What a room file asks for: view, paint, scenarios.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenes/room_files.h"

namespace scenes {
namespace {

using testing::ElementsAre;

TEST(RoomJson, WallsAsPaintedSurfacesMeansAllOfThemOnce) {
  json file = sample_room();
  file["paint"]["surfaces"] = {"north", "walls"};
  EXPECT_THAT(read(file).paint.at(0).surfaces, ElementsAre(2, 3, 4, 5));
}

TEST(RoomJson, GroupsArePaintedIndependently) {
  json file = sample_room();
  json walls = file["paint"], north = file["paint"];
  walls["surfaces"] = {"south", "east", "west"};
  north["surfaces"] = {"north"};
  north["weight"] = 0.5;
  north["view"] = {{"eye_m", {2.5, 1, 1}}, {"look_at_m", {2.5, 4, 1}}};
  file["paint"] = {walls, north};
  const Room room = read(file);
  ASSERT_EQ(room.paint.size(), 2U);
  EXPECT_EQ(paint_group(room, 2), 0);
  EXPECT_EQ(paint_group(room, 4), 1);
  EXPECT_EQ(paint_group(room, 0), -1);
  EXPECT_EQ(room.paint[1].name, "north");
  EXPECT_EQ(room.paint[1].weight, 0.5);
  EXPECT_EQ(room.paint[1].view->eye_m.x(), 2.5);
}

TEST(RoomJson, ScenariosScaleLightsByName) {
  json file = sample_room();
  file["judge"] = "worst";
  file["scenarios"] = {{{"name", "evening"}, {"lights", {{"panel", 0.25}}}, {"weight", 2}}};
  const Room room = read(file);
  EXPECT_EQ(room.judgement, spectra::Judgement::worst);
  ASSERT_EQ(room.scenarios.size(), 1U);
  EXPECT_EQ(room.scenarios[0].weight, 2);
  const Room evening = relit(room, room.scenarios[0]);
  EXPECT_TRUE(
      (surface(evening, "panel").exitance.values == 0.25 * surface(room, "panel").exitance.values)
          .all());
  EXPECT_EQ(surface(evening, "window").exitance.values.maxCoeff(), 0);
}

TEST(RoomJson, TargetIsAReflectanceOrCorrelates) {
  json file = sample_room();
  EXPECT_EQ(read(file).paint.at(0).target->name, "munsell-nickerson:231");
  EXPECT_EQ(read(file).paint.at(0).top, 7);
  file["paint"]["target"] = {{"J", 70}, {"C", 20}, {"h_deg", 45}};
  EXPECT_EQ(std::get<Eigen::Vector3d>(read(file).paint.at(0).target->colour),
            Eigen::Vector3d(70, 20, 45));
  file["paint"].erase("target");
  EXPECT_FALSE(read(file).paint.at(0).target.has_value());
}

TEST(RoomJson, AtlasFileIsFoundBesideTheRoom) {
  json file = sample_room();
  file["paint"]["atlas"] = "paints.csv";
  EXPECT_EQ(read(file).paint.at(0).atlas, own_folder() + "paints.csv");
}

TEST(RoomJson, ViewingChoicesNeedNoEye) {
  json file = sample_room();
  file["view"] = {{"surround", "dim"}, {"background", "sample"}, {"white", "surfaces"}};
  const Room room = read(file);
  EXPECT_FALSE(room.view.has_value());
  EXPECT_EQ(room.viewing.surround, spectra::Surround::dim);
  EXPECT_EQ(room.viewing.background, spectra::Background::sample);
  EXPECT_EQ(room.viewing.white, spectra::ReferenceWhite::surfaces);
}

}  // namespace
}  // namespace scenes
