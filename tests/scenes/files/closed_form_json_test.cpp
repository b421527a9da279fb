#include "scenes/files/closed_form_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenes/room_files.h"

namespace scenes {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

json sample_cube() {
  return json::parse(R"({
    "roomhue_cube": 1, "form_factors": "paper",
    "reflectance": [0.1, 0.2, 0.3, 0.4, 0.5, { "nm": [360, 830], "values": [0.2, 0.67] }],
    "emission_W_m2_nm": [0, 1.5, 0, 0, 0, { "nm": [360, 830], "values": [0, 0.47] }] })");
}

json sample_brick() {
  return json::parse(R"({
    "roomhue_brick": 1, "width_m": 5, "depth_m": 4, "height_m": 2.7, "furniture_height": 0.3,
    "window": { "width_m": 2, "height_m": 1.4, "sill_m": 0.9, "offset_m": 1.5 },
    "reflectance": { "floor": 0.25, "ceiling": 0.85, "window_wall": 0.5, "wall_1": 0.51,
      "wall_2": 0.52, "wall_3": 0.53, "furniture_1": 0.41, "furniture_2": 0.42,
      "furniture_3": 0.43 },
    "emission_W_m2_nm": { "window": 0.05 } })");
}

CubeFile cube(const json& file) { return read_cube(write_file("cube.json", file.dump())); }

BrickFile brick(const json& file) { return read_brick(write_file("brick.json", file.dump())); }

// 360..830 nm at 1 nm: both curves rise by 0.001 per nm from their first sample.
TEST(ClosedFormJson, CubeFacesKeepTheirOrder) {
  const CubeFile c = cube(sample_cube());
  EXPECT_FALSE(c.exact_form_factors);
  EXPECT_EQ(c.reflectance[2].values.size(), 471);
  EXPECT_EQ(c.reflectance[2].values[470], 0.3);
  EXPECT_NEAR(c.reflectance[5].values[100], 0.3, 1e-14);
  EXPECT_EQ(c.emission[1].values[0], 1.5);
  EXPECT_NEAR(c.emission[5].values[100], 0.1, 1e-14);
  EXPECT_THAT(c.notes, IsEmpty());
}

TEST(ClosedFormJson, ExactFormFactorsAreAskedForByName) {
  json file = sample_cube();
  file["form_factors"] = "exact";
  EXPECT_TRUE(cube(file).exact_form_factors);
}

TEST(ClosedFormJson, ShortCurvesAreCompletedAndThatIsSaid) {
  json file = sample_cube();
  file["reflectance"][0] = {{"nm", {400, 700}}, {"values", {0.2, 0.5}}};
  file["emission_W_m2_nm"][0] = {{"nm", {400, 700}}, {"values", {1, 1}}};
  const CubeFile c = cube(file);
  EXPECT_EQ(c.reflectance[0].values[0], 0.2);
  EXPECT_EQ(c.reflectance[0].values[470], 0.5);
  EXPECT_EQ(c.emission[0].values[0], 0);
  EXPECT_EQ(c.emission[0].values[470], 0);
  EXPECT_THAT(c.notes, Contains(HasSubstr("/reflectance/0")));
  EXPECT_THAT(c.notes, Contains(HasSubstr("/emission_W_m2_nm/0")));
}

TEST(ClosedFormJson, BrickPartsComeInTheOrderOfTheirNames) {
  const BrickFile b = brick(sample_brick());
  const std::vector<double> expected{0.25, 0.85, 0.5, 0, 0.51, 0.52, 0.53, 0.41, 0.42, 0.43};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(b.reflectance[i].values[0], expected[i]) << kBrickParts[i];
    EXPECT_EQ(b.emission[i].values[0], i == 3 ? 0.05 : 0) << kBrickParts[i];
  }
  EXPECT_EQ(b.depth_m, 4);
  EXPECT_EQ(b.furniture_height, 0.3);
  EXPECT_EQ(b.window_sill_m, 0.9);
}

TEST(ClosedFormJson, BrickWithoutFurnitureNeedsNoReflectanceForIt) {
  json file = sample_brick();
  for (const char* part : {"furniture_1", "furniture_2", "furniture_3"}) {
    file["reflectance"].erase(part);
  }
  EXPECT_EQ(faults_of([&] { (void)brick(file); }).size(), 3);
  file["furniture_height"] = 0;
  EXPECT_THAT(faults_of([&] { (void)brick(file); }), IsEmpty());
}

TEST(ClosedFormJson, WishNamesItsPartsAndPaintsItsOwnByDefault) {
  json file = sample_brick();
  EXPECT_FALSE(brick(file).wished);
  file["wished"] = {{"of", "wall_2"}, {"radiosity_W_m2_nm", 0.02}};
  const auto own = brick(file).wished;
  ASSERT_TRUE(own);
  EXPECT_EQ(own->of, 5);
  EXPECT_EQ(own->by, 5);
  EXPECT_EQ(own->radiosity.values[470], 0.02);
  file["wished"]["by"] = "ceiling";
  EXPECT_EQ(brick(file).wished->by, 1);

  json box = sample_cube();
  box["wished"] = {{"of", "y1"}, {"by", "z0"}, {"radiosity_W_m2_nm", 0.02}};
  EXPECT_EQ(cube(box).wished->of, 3);
  EXPECT_EQ(cube(box).wished->by, 4);
}

TEST(ClosedFormJson, SampleFilesAreRead) {
  const std::string folder = std::string(SOURCE_DIR) + "/scenes/rooms/closed_form/";
  EXPECT_TRUE(read_cube(folder + "cube.json").exact_form_factors);
  EXPECT_EQ(read_brick(folder + "brick.json").width_m, 5);
}

}  // namespace
}  // namespace scenes
