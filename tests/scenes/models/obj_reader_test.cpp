#include "scenes/models/obj_reader.h"

#include <gmock/gmock.h>

#include "scenes/mesh/patch_mesh.h"
#include "tests/scenes/room_files.h"
#include "tests/scenes/shapes/volumes.h"

namespace scenes {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

ObjFile obj_of(const std::string& text) { return read_obj(write_file("mesh.obj", text)); }

/// A cube of one unit, quads, indices from the end.
std::string cube_text() {
  return "# a cube\r\no cube\r\n"
         "v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nv 0 0 1\r\nv 1 0 1\r\nv 1 1 1\r\nv 0 1 1\r\n"
         "usemtl wood\r\nf 4 3 2 1\r\nf 5/1 6/2 7/3 8/4\r\nf 1//1 2//1 6//1 5//1\r\n"
         "usemtl steel\r\ng other\r\nf -7 -6 -2 -3\r\nf 3 4 \\\r\n 8 7\r\nf 4/1/1 1/1/1 5/1/1 "
         "8/1/1\r\n";
}

TEST(ObjReader, ReadsEveryFormOfAFace) {
  const ObjFile file = obj_of(cube_text() + "l 1 2\nvn 0 0 1\nvt 0 0\n");
  EXPECT_THAT(file.corners, SizeIs(8));
  ASSERT_THAT(file.faces, SizeIs(6));
  EXPECT_THAT(file.faces[1].corners, ElementsAre(4, 5, 6, 7));
  EXPECT_THAT(file.faces[3].corners, ElementsAre(1, 2, 6, 5));
  EXPECT_THAT(file.faces[4].corners, ElementsAre(2, 3, 7, 6));
  EXPECT_EQ(file.faces[2].material, "wood");
  EXPECT_EQ(file.faces[4].material, "steel");  // usemtl rules, not g
  EXPECT_EQ(file.faces[5].line, 20);
  EXPECT_THAT(file.notes, ElementsAre(HasSubstr("\"l\"")));
}

TEST(ObjReader, FaultsHaveTheirLine) {
  const auto first = [](const std::string& text) {
    const auto faults = faults_of([&] { (void)obj_of(text); });
    return faults.empty() ? spectra::Fault{} : faults.front();
  };
  EXPECT_EQ(first("v 0 0 0\nv 1 x 0\n").line, 2);
  EXPECT_EQ(first("v 0 0 0\nv 1 nan 0\n").line, 2);
  EXPECT_EQ(first("v 0 0\n").line, 1);
  EXPECT_EQ(first("v 0 0 1e300\n").line, 1);
  EXPECT_EQ(first("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 4\n").line, 4);
  EXPECT_EQ(first("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 0 1 2\n").line, 4);
  EXPECT_EQ(first("v 0 0 0\nv 1 0 0\nv 1 1 0\nf -4 -1 -2\n").line, 4);
  EXPECT_EQ(first("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2\n").line, 4);
  EXPECT_EQ(first("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3.5\n").line, 4);
  EXPECT_EQ(first("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 99999999999999999999\n").line, 4);
  EXPECT_THAT(first("v 0 0 0\n").problem, HasSubstr("no face"));
  EXPECT_THAT(first("").problem, HasSubstr("no face"));
  EXPECT_THROW((void)read_obj("/nowhere.obj"), spectra::FileError);
  EXPECT_THROW((void)read_obj("/dev/null"), spectra::FileError);
}

/// The sample room with the cube, in centimetres of 50 per unit, as its desk.
json room_with_mesh(const std::string& text, const char* unit = "m") {
  write_file("cube.obj", text);
  json room = sample_room();
  room["furniture"][0] = {
      {"name", "desk"},
      {"mesh", {{"file", "cube.obj"}, {"unit", unit}, {"up", "z"}, {"at_m", {1, 1, 0}}}}};
  return room;
}

TEST(RoomMesh, IsPlacedAndHasASurfaceForEachMaterial) {
  json file = room_with_mesh(cube_text());
  file["surfaces"]["desk.steel"] = 0.6;
  const Room room = read(file);
  EXPECT_NEAR(volume_within(room.furniture[0].faces), 1, 1e-12);
  EXPECT_EQ(surface(room, "desk.wood").reflectance.values[0], 0.4);  // that of "desk"
  EXPECT_EQ(surface(room, "desk.steel").reflectance.values[0], 0.6);
  const PatchMesh mesh = mesh_room(room, 0.25);
  double wood_m2 = 0, steel_m2 = 0;
  for (std::size_t p = 0; p < mesh.area_m2.size(); ++p) {
    if (mesh.surface[p] == find_surface(room, "desk.wood")) wood_m2 += mesh.area_m2[p];
    if (mesh.surface[p] == find_surface(room, "desk.steel")) steel_m2 += mesh.area_m2[p];
  }
  EXPECT_NEAR(wood_m2, 2, 1e-12);  // it stands on one of three
  EXPECT_NEAR(steel_m2, 3, 1e-12);
}

TEST(RoomMesh, UnitsAndAxesAreThoseThatAreSaid) {
  json file = room_with_mesh(cube_text(), "ft");
  file["furniture"][0]["mesh"]["up"] = "y";  // y up: the cube reaches from y = 1 - 0.3 to 1
  const Room room = read(file);
  Eigen::AlignedBox3d box;
  for (const Outline& face : room.furniture[0].faces) {
    for (const Eigen::Vector3d& p : face) box.extend(p);
  }
  EXPECT_LT((box.min() - Eigen::Vector3d(1, 1 - 0.3048, 0)).norm(), 1e-12);
  EXPECT_LT((box.max() - Eigen::Vector3d(1.3048, 1, 0.3048)).norm(), 1e-12);
}

TEST(RoomMesh, BadOnesAreRefusedAtTheirPlace) {
  const auto fault = [](const json& room) {
    const auto faults = faults_of([&] { (void)read(room); });
    return faults.empty() ? spectra::Fault{} : faults.front();
  };
  const std::string mesh = "/furniture/0/mesh";
  json room = room_with_mesh(cube_text());
  room["furniture"][0]["mesh"].erase("unit");
  EXPECT_EQ(fault(room).pointer, mesh);
  room = room_with_mesh(cube_text(), "mile");
  EXPECT_EQ(fault(room).pointer, mesh + "/unit");
  room = room_with_mesh(cube_text());
  room["furniture"][0]["mesh"]["file"] = "nowhere.obj";
  EXPECT_EQ(fault(room).pointer, mesh + "/file");
  room = room_with_mesh(cube_text() + "v 1 2\n");
  EXPECT_EQ(fault(room).pointer, mesh + "/file");
  room = room_with_mesh(cube_text().substr(0, cube_text().rfind("f 4/")));
  EXPECT_THAT(fault(room).problem, HasSubstr("meets no other face"));
  room = room_with_mesh(cube_text());
  room["furniture"][0]["mesh"]["at_m"] = {4.5, 1, 0};
  EXPECT_THAT(fault(room).problem, HasSubstr("through \"east\""));
  room =
      room_with_mesh(cube_text() +  // and a second cube, far outside
                     "v 9 0 0\nv 10 0 0\nv 10 1 0\nv 9 1 0\nv 9 0 1\nv 10 0 1\nv 10 1 1\nv 9 1 1\n"
                     "f -5 -6 -7 -8\nf -4 -3 -2 -1\nf -8 -7 -3 -4\nf -7 -6 -2 -3\nf -6 -5 -1 -2\n"
                     "f -5 -8 -4 -1\n");
  EXPECT_THAT(fault(room).problem, HasSubstr("outside the room"));
  room = room_with_mesh(cube_text());
  room["furniture"][0]["mesh"]["two_sided"] = 1;
  EXPECT_EQ(fault(room).pointer, mesh + "/two_sided");
}

}  // namespace
}  // namespace scenes
