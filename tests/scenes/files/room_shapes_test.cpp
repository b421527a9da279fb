// Shapes of rooms and furniture as files give them: what they mean, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "scenes/mesh/patch_mesh.h"
#include "tests/scenes/room_files.h"
#include "tests/scenes/shapes/volumes.h"

namespace scenes {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

json sample_of_faces() {
  return json::parse(std::ifstream(std::string(SOURCE_DIR) + "/scenes/rooms/faces.json"));
}

/// The sample room with other furniture of the same name.
json with_furniture(const char* shape) {
  json room = sample_room();
  room["furniture"][0] = json::parse(shape);
  room["furniture"][0]["name"] = "desk";
  return room;
}

/// The sample room under another ceiling.
json under(const char* ceiling) {
  json room = sample_room();
  room.erase("height_m");
  room["ceiling"] = json::parse(ceiling);
  room["lights"].erase(0);  // the panel, which may not fit
  room["openings"][0]["sill_m"] = 0.2;
  room["openings"][0]["height_m"] = 0.8;
  room["furniture"][0]["box_m"]["max"][2] = 0.5;
  room["receivers"] = json::array();
  room.erase("view");
  return room;
}

TEST(RoomShapes, HeightsOverTheCornersMakeOneSlope) {
  const Room room = read(under(R"({ "heights_m": [2, 2, 4, 4] })"));
  EXPECT_NEAR(volume_within(room.shell), 5 * 4 * 3, 1e-12);
  EXPECT_EQ(room.shell.size(), 6U);
}

TEST(RoomShapes, TheLowestPlaneCounts) {
  const Room room = read(under(R"({ "planes": [
      { "wall": "south", "height_m": 1.2, "pitch_deg": 45 },
      { "points_m": [[0, 4, 1.2], [5, 4, 1.2], [0, 2, 3.2]] },
      { "height_m": 2.2 } ] })"));
  EXPECT_NEAR(volume_within(room.shell), 5 * (4 * 1.2 + 4 - 1), 1e-12);
  EXPECT_EQ(room.shell.size(), 8U);
}

TEST(RoomShapes, HeightBesidePlanesIsOneMore) {
  json file = under(R"({ "planes": [ { "wall": "south", "height_m": 1.2, "pitch_deg": 45 } ] })");
  file["height_m"] = 2.2;
  EXPECT_NEAR(volume_within(read(file).shell), 5 * (4 * 2.2 - 0.5), 1e-12);
}

// A roof window 1 m up a slope of 45 degrees, over y = 0.5, lies at z = 1.2 + 0.5.
TEST(RoomShapes, RoofWindowLiesInTheSlopeAboveItsPlace) {
  json file = under(R"({ "planes": [ { "wall": "south", "height_m": 1.2, "pitch_deg": 45 } ] })");
  file["openings"][0] = {
      {"name", "window"}, {"on", "ceiling"}, {"center_m", {2, 0.5}}, {"size_m", {0.8, 0.6}}};
  const Room room = read(file);
  const Outline& window = room.openings[0].outline;
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& p : window) middle += p / 4;
  EXPECT_LT((middle - Vector3d(2, 0.5, 1.7)).norm(), 1e-12);
  EXPECT_NEAR(vector_area_m2(window).norm(), 0.48, 1e-12);
  EXPECT_LT((vector_area_m2(window).normalized() - Vector3d(0, 1, -1).normalized()).norm(), 1e-12);
  const PatchMesh mesh = mesh_room(room, 0.3);
  double area_m2 = 0;
  for (int p = 0; p < mesh.size(); ++p) {
    const auto i = static_cast<std::size_t>(p);
    if (mesh.surface[i] == find_surface(room, "window")) area_m2 += mesh.area_m2[i];
  }
  EXPECT_NEAR(area_m2, 0.48, 1e-12);
}

TEST(RoomShapes, OutlinesAreTurnedToTheRoom) {
  json file = sample_room();
  file["openings"][0] = {
      {"name", "window"},
      {"outline_m", {{1, 0, 1}, {1, 0, 2}, {2, 0, 2}, {2.5, 0, 1.5}, {2, 0, 1}}}};
  const Room room = read(file);
  EXPECT_EQ(room.openings[0].face, 2);
  EXPECT_LT((vector_area_m2(room.openings[0].outline) - Vector3d(0, 1.25, 0)).norm(), 1e-12);
}

TEST(RoomShapes, FurnitureHasItsVolume) {
  const std::vector<std::pair<const char*, double>> shapes{
      {R"({ "prism": { "plan_m": [[1, 1], [2, 1], [2, 2], [1.5, 1.2]], "z_m": [0, 2] } })", 0.7},
      {R"({ "prism": { "plan_m": [[1, 1], [1.5, 1.2], [2, 2], [2, 1]], "z_m": [0, 2] } })", 0.7},
      {R"({ "cylinder": { "center_m": [2, 2], "radius_m": 0.5, "z_m": [0, 1] } })",
       std::numbers::pi / 4},
      {R"({ "stairs": { "foot_m": [1, 1, 0], "width_m": 1, "rise_m": 0.2, "going_m": 0.3,
            "steps": 4 } })",
       10 * 0.06},
      {R"({ "box_m": { "min": [1, 1, 1], "max": [2, 3, 2] },
            "rotate": { "axis": [1, 1, 0], "angle_deg": 20 } })",
       2}};
  for (const auto& [shape, volume_m3] : shapes) {
    const Room room = read(with_furniture(shape));
    EXPECT_NEAR(volume_within(room.furniture[0].faces), volume_m3, 1e-12) << shape;
  }
}

TEST(RoomShapes, FacesMayBeGivenFromEitherSideWithHoles) {
  json file = sample_of_faces();
  const Room room = read(file);
  const auto air_m3 = [](const Room& r) {
    const PatchMesh mesh = mesh_room(r, 1);
    double volume = 0;
    for (std::size_t i = 0; i < mesh.area_m2.size(); ++i) {
      volume -= mesh.area_m2[i] * mesh.normal[i].dot(mesh.centre[i]) / 3;
    }
    return volume;
  };
  EXPECT_NEAR(air_m3(room), 4 * 3 * 2.5 + 0.6, 1e-12);
  for (json& face : file["faces"]) {
    std::reverse(face["outline_m"].begin(), face["outline_m"].end());
  }
  EXPECT_NEAR(air_m3(read(file)), 4 * 3 * 2.5 + 0.6, 1e-12);
  EXPECT_EQ(surface(room, "floor").kind, SurfaceKind::floor);
  EXPECT_EQ(surface(room, "ceiling").kind, SurfaceKind::ceiling);
  EXPECT_EQ(surface(room, "shaft").kind, SurfaceKind::wall);
}

// Two faces side by side where one would do: their common edge ends on the edges of others.
TEST(RoomShapes, CornersMayLieOnEdges) {
  json file = sample_of_faces();
  json left = file["faces"][2], right = left;
  left["outline_m"] = {{0, 0, 0}, {1.3, 0, 0}, {1.3, 0, 2.5}, {0, 0, 2.5}};
  right["outline_m"] = {{1.3, 0, 0}, {4, 0, 0}, {4, 0, 2.5}, {1.3, 0, 2.5}};
  file["faces"][2] = left;
  file["faces"].push_back(right);
  EXPECT_NO_THROW((void)read(file));
}

struct BadShape {
  json room;
  std::string pointer, word;
};

void expect_refused(const std::vector<BadShape>& shapes) {
  for (const auto& [room, pointer, word] : shapes) {
    const auto faults = faults_of([&room = room] { (void)read(room); });
    if (faults.empty()) {
      ADD_FAILURE() << "not refused: " << pointer << ", " << word;
      continue;
    }
    EXPECT_EQ(faults[0].pointer, pointer) << faults[0].problem;
    EXPECT_THAT(faults[0].problem, HasSubstr(word));
    EXPECT_GT(faults[0].line, 0);
    EXPECT_FALSE(faults[0].remedy.empty());
    for (std::size_t k = 1; k < faults.size(); ++k) ADD_FAILURE() << to_string(faults[k]);
  }
}

TEST(RoomShapes, BadCeilingsAreRefused) {
  const std::string planes = "/ceiling/planes";
  json with_height = under(R"({ "heights_m": [2, 2, 4, 4] })");
  with_height["height_m"] = 3;
  expect_refused({
      {under(R"({})"), "/ceiling", "no shape"},
      {under(R"({ "heights_m": [2, 2, 4, 4], "planes": [ { "height_m": 3 } ] })"), "/ceiling",
       "both"},
      {under(R"({ "heights_m": [2, 2, 4] })"), "/ceiling/heights_m", "3 heights for 4 corners"},
      {under(R"({ "heights_m": [2, 2, 4, 4.1] })"), "/ceiling/heights_m/0", "no plane"},
      {under(R"({ "heights_m": [2, 2, 4, 0] })"), "/ceiling/heights_m/3", "out of range"},
      {under(R"({ "heights_m": 3 })"), "/ceiling/heights_m", "list"},
      {with_height, "/height_m", "both"},
      {under(R"({ "planes": [] })"), planes, "0 entries"},
      {under(R"({ "planes": [ { "wall": "south", "height_m": 1.2 } ] })"), planes + "/0",
       "go together"},
      {under(R"({ "planes": [ { "height_m": 1.2, "pitch_deg": 40 } ] })"), planes + "/0",
       "go together"},
      {under(R"({ "planes": [ { "wall": "attic", "height_m": 1.2, "pitch_deg": 40 } ] })"),
       planes + "/0/wall", "no wall"},
      {under(R"({ "planes": [ { "wall": "south", "height_m": 1.2, "pitch_deg": 90 } ] })"),
       planes + "/0/pitch_deg", "out of range"},
      {under(R"({ "planes": [ { "wall": "south", "height_m": 2, "pitch_deg": -40 } ] })"),
       "/ceiling", "high over corner"},
      {under(R"({ "planes": [ { "points_m": [[0, 0, 2], [1, 0, 2]] } ] })"), planes + "/0/points_m",
       "2 entries"},
      {under(R"({ "planes": [ { "points_m": [[0, 0, 2], [1, 0, 2], [2, 0, 2]] } ] })"),
       planes + "/0/points_m", "in a line"},
      {under(R"({ "planes": [ { "points_m": [[0, 0, 2], [1, 0, 2], [1, 0, 3]] } ] })"),
       planes + "/0/points_m", "upright"},
      {under(R"({ "planes": [ { "points_m": [[0, 0, 2], [1, 0, 2], [0, 1, 2]],
                                "height_m": 2 } ] })"),
       planes + "/0/height_m", "three points"},
      {under(R"({ "planes": [ { "height_m": 2, "tilt": 3 } ] })"), planes + "/0/tilt", "unknown"},
  });
}

TEST(RoomShapes, BadFurnitureIsRefused) {
  const std::string desk = "/furniture/0";
  const auto bad = [&](const char* shape, const std::string& place, const char* word) {
    return BadShape{with_furniture(shape), desk + place, word};
  };
  expect_refused({
      bad(R"({})", "", "no shape"),
      bad(R"({ "prism": { "plan_m": [[1, 1], [2, 1], [2, 2]], "z_m": [0, 1] },
               "sheet": { "outline_m": [[1, 1, 1], [2, 1, 1], [2, 2, 1]] } })",
          "", "both"),
      bad(R"({ "prism": { "plan_m": [[1, 1], [2, 1]], "z_m": [0, 1] } })", "/prism/plan_m",
          "2 entries"),
      bad(R"({ "prism": { "plan_m": [[1, 1], [2, 2], [2, 1], [1, 2]], "z_m": [0, 1] } })",
          "/prism/plan_m/0", "crosses"),
      bad(R"({ "prism": { "plan_m": [[1, 1], [2, 1], [2, 1], [1, 2]], "z_m": [0, 1] } })",
          "/prism/plan_m/2", "repeats"),
      bad(R"({ "prism": { "plan_m": [[1, 1], [2, 1], [2, 2]], "z_m": [1, 0] } })", "/prism/z_m",
          "not above"),
      bad(R"({ "prism": { "plan_m": [[1, 1], [2, 1], [2, 2]], "z_m": [0, 3] } })", "",
          "through \"ceiling\""),
      bad(R"({ "prism": { "plan_m": [[1, 1], [2, 1], [2, 2]] } })", "/prism", "z_m"),
      bad(R"({ "prism": { "plan_m": [[1, 1], [6, 1], [2, 2]], "z_m": [0, 1] } })", "",
          "through \"east\""),
      bad(R"({ "prism": { "plan_m": [[6, 1], [7, 1], [7, 2]], "z_m": [0, 1] } })", "", "outside"),
      bad(R"({ "prism": { "plan_m": [[1, 1], [2, 1], [2, 2]], "z_m": [0, 1] },
               "rotate_z_deg": 20 })",
          "/rotate_z_deg", "boxes only"),
      bad(R"({ "cylinder": { "center_m": [2, 2], "radius_m": 0, "z_m": [0, 1] } })",
          "/cylinder/radius_m", "out of range"),
      bad(R"({ "cylinder": { "center_m": [2, 2], "radius_m": 1, "z_m": [0, 1], "sides": 2 } })",
          "/cylinder/sides", "out of range"),
      bad(R"({ "cylinder": { "center_m": [2, 2], "radius_m": 0.002, "z_m": [0, 1],
               "sides": 90 } })",
          "/cylinder", "shorter than 1 mm"),
      bad(R"({ "cylinder": { "center_m": [4.5, 3.5], "radius_m": 1, "z_m": [0, 1] } })", "",
          "through"),
      bad(R"({ "cylinder": { "center_m": [2], "radius_m": 1, "z_m": [0, 1] } })",
          "/cylinder/center_m", "1 entries"),
      bad(R"({ "stairs": { "foot_m": [1, 1, 0], "width_m": 1, "rise_m": 0.2, "going_m": 0.3 } })",
          "/stairs", "steps"),
      bad(R"({ "stairs": { "foot_m": [1, 2.8, 0], "width_m": 1, "rise_m": 0.2, "going_m": 0.3,
               "steps": 20 } })",
          "", "through"),
      bad(R"({ "stairs": { "foot_m": [1, 1, 0], "width_m": 1, "rise_m": 0.2, "going_m": 0.3,
               "steps": 0 } })",
          "/stairs/steps", "out of range"),
      bad(R"({ "sheet": { "outline_m": [[1, 1, 1], [2, 1, 1]] } })", "/sheet/outline_m",
          "2 entries"),
      bad(R"({ "sheet": { "outline_m": [[1, 1, 1], [2, 1, 1], [3, 1, 1]] } })", "/sheet/outline_m",
          "no area"),
      bad(R"({ "sheet": { "outline_m": [[1, 1, 1], [2, 1, 1], [2, 2, 1], [1, 2, 1.01]] } })",
          "/sheet/outline_m/1", "no plane"),
      bad(R"({ "sheet": { "outline_m": [[1, 1, 1], [3, 2, 1], [3, 1, 1], [1, 1.5, 1]] } })",
          "/sheet/outline_m/0", "crosses"),
      bad(R"({ "sheet": { "outline_m": [[-1, 1, 1], [2, 1, 1], [2, 2, 1]] } })", "",
          "through \"west\""),
      bad(R"({ "sheet": {} })", "/sheet", "outline_m"),
      bad(R"({ "box_m": { "min": [1, 1, 0], "max": [2, 2, 1] },
               "rotate": { "axis": [0, 0, 0], "angle_deg": 5 } })",
          "/rotate/axis", "no direction"),
      bad(R"({ "box_m": { "min": [1, 1, 0], "max": [2, 2, 1] },
               "rotate": { "axis": [0, 0, 1] } })",
          "/rotate", "angle_deg"),
      bad(R"({ "box_m": { "min": [1, 1, 0], "max": [2, 2, 1] },
               "rotate": { "axis": [1, 0, 0], "angle_deg": 5 } })",
          "", "through \"floor\""),
      bad(R"({ "box_m": { "min": [1, 1, 0], "max": [2, 2, 1] }, "rotate_z_deg": 5,
               "rotate": { "axis": [0, 0, 1], "angle_deg": 5 } })",
          "/rotate_z_deg", "twice"),
  });
}

TEST(RoomShapes, BadOpeningsAndPanelsAreRefused) {
  const auto opening = [](const char* shape) {
    json room = sample_room();
    json& entry = room["openings"][0];
    entry = json::parse(shape);
    entry["name"] = "window";
    return room;
  };
  const auto panel = [](const char* shape) {
    json room = sample_room();
    room["lights"][0]["panel"] = json::parse(shape);
    return room;
  };
  const std::string window = "/openings/0", lamp = "/lights/0/panel";
  expect_refused({
      {opening(R"({ "outline_m": [[1, 0, 1], [2, 0, 1]] })"), window + "/outline_m", "2 entries"},
      {opening(R"({ "outline_m": [[1, 1, 1], [2, 1, 1], [2, 1, 2]] })"), window + "/outline_m",
       "on no face"},
      {opening(R"({ "outline_m": [[4, 0, 1], [6, 0, 1], [6, 0, 2]] })"), window + "/outline_m",
       "on no face"},
      {opening(R"({ "outline_m": [[1, 0, 1], [2, 0, 1], [2, 0, 2], [1.9, 0, 1.1]] })"),
       window + "/outline_m", "not convex"},
      {opening(R"({ "outline_m": [[1, 0, 1], [2, 0, 2], [2, 0, 1], [1, 0, 2]] })"),
       window + "/outline_m", "crosses"},
      {opening(R"({ "outline_m": [[1, 0, 1], [2, 0, 1], [2, 0, 2]], "sill_m": 1 })"),
       window + "/sill_m", "outline already"},
      {opening(R"({ "on": "ceiling", "center_m": [0.2, 2], "size_m": [1, 1] })"), window, "beyond"},
      {opening(R"({ "on": "roof", "center_m": [2, 2], "size_m": [1, 1] })"), window + "/on",
       "no wall"},
      {opening(R"({ "on": "ceiling", "center_m": [2, 2] })"), window, "size_m"},
      {opening(R"({ "on": "ceiling", "center_m": [4, 3], "size_m": [1, 1], "width_m": 1 })"),
       window + "/width_m", "does not go with"},
      {opening(R"({ "wall": "south", "offset_m": 1, "sill_m": 1, "width_m": 1, "height_m": 1,
                    "size_m": [1, 1] })"),
       window + "/size_m", "goes with"},
      {panel(R"({ "outline_m": [[1, 0.1, 1], [2, 0.1, 1], [2, 0.1, 2]] })"), lamp + "/outline_m",
       "on no face"},
      {panel(R"({ "outline_m": [[2, 0, 1], [3, 0, 1], [3, 0, 2]] })"), lamp, "overlaps"},
      {panel(R"({ "outline_m": [[1, 1, 2.7], [2, 1, 2.7], [2, 2, 2.7]], "on": "ceiling" })"),
       lamp + "/on", "outline already"},
  });
}

TEST(RoomShapes, BadFacesAreRefused) {
  const auto changed = [](const char* pointer, const char* value) {
    json room = sample_of_faces();
    room[json::json_pointer(pointer)] = json::parse(value);
    return room;
  };
  json open = sample_of_faces(), doubled = open, both = open, no_outline = open, body = open;
  open["faces"].erase(2);
  open["paint"]["surfaces"].erase(0);
  doubled["faces"].push_back(doubled["faces"][2]);
  both["plan_m"] = {{0, 0}, {4, 0}, {4, 3}};
  no_outline["openings"][0] = {
      {"name", "rooflight"}, {"on", "ceiling"}, {"center_m", {1, 1}}, {"size_m", {1, 1}}};
  body["furniture"].push_back(
      {{"name", "box"}, {"box_m", {{"min", {3, 1, 0}}, {"max", {4.5, 2, 1}}}}});
  body["surfaces"]["box"] = 0.5;
  const auto faults = faults_of([&] { (void)read(open); });
  EXPECT_EQ(faults.size(), 4U);  // its four edges
  for (const auto& fault : faults) EXPECT_THAT(fault.problem, HasSubstr("meets no other face"));
  EXPECT_THAT(faults_of([&] { (void)read(doubled); })[0].problem, HasSubstr("of 3 faces"));
  expect_refused({
      {changed("/faces", "[]"), "/faces", "0 entries"},
      {changed("/faces/0/outline_m/2", "[4, 3]"), "/faces/0/outline_m/2", "2 entries"},
      {changed("/faces/0/outline_m/2", "[4, 3, 0.1]"), "/faces/0/outline_m/1", "no plane"},
      {changed("/faces/0/outline_m/2", "[4, 0, 0]"), "/faces/0/outline_m/2", "repeats"},
      {changed("/faces/1/holes_m/0/0", "[-1, 1, 2.5]"), "/faces/1/holes_m/0", "not within"},
      {changed("/faces/3/surface", "\"\""), "/faces/3/surface", "empty"},
      {changed("/faces/3/surface", "\"walls\""), "/faces/3/surface", "reserved"},
      {both, "/plan_m", "both faces"},
      {no_outline, "/openings/0", "no outline"},
      {body, "/furniture/0", "through \"east\""},
  });
}

}  // namespace
}  // namespace scenes
