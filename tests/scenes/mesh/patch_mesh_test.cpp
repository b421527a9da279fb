#include "scenes/mesh/patch_mesh.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "scenes/shapes/shell.h"
#include "tests/scenes/shapes/volumes.h"
#include "tests/scenes/test_rooms.h"

namespace scenes {
namespace {

struct Case {
  std::string name;
  Room room;
  double patch_m;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

RoomBuilder office() {
  RoomBuilder office = rectangular_room(5, 4, 2.7);
  office.opening(0, {1.5, 0.9}, {2, 1.4}).panel(1, {2.5, 2}, {1.2, 1.2});
  office.box({1.7, 1.6, 0}, {3.3, 2.4, 0.75});       // on the floor
  office.box({4.5, 1, 0}, {5, 2.2, 2});              // against the east wall
  office.box({4.4, 2.2, 0}, {5, 3.1, 1.1});          // against the wall and the box before
  office.box({4.6, 2.3, 1.1}, {4.9, 2.6, 1.5}, 30);  // on top of it, turned
  office.box({0.3, 2.6, 0}, {1.7, 3.4, 0.75}, 20);   // on the floor, turned
  office.box({0, 0, 2.3}, {0.6, 0.6, 2.7});          // in an upper corner
  return office;
}

/// Slopes of 45 degrees from two walls 1 m high, a level part between them.
RoomBuilder attic() {
  const Polygon plan = rectangular_plan(5, 4);
  RoomBuilder attic(plan, {pitched_plane(edge_line(plan, 0), 1, 45),
                           pitched_plane(edge_line(plan, 2), 1, 45),
                           {.height_m = 2.4}});
  attic.opening(1, {1, 0.5}, {1.2, 1.5});
  attic.body(prism_body("column", regular_polygon({1.2, 2}, 0.15, 12), 0, 2.4));
  attic.body(prism_body("corner sofa",
                        {{2.5, 1}, {4.5, 1}, {4.5, 3}, {3.7, 3}, {3.7, 1.8}, {2.5, 1.8}}, 0, 0.45));
  attic.body(sheet_body("screen", {{2, 1, 0}, {2, 2, 0}, {2, 2, 1.6}, {2, 1, 1.6}}));
  attic.body(sheet_body("poster", {{0, 1.5, 1}, {0, 2.5, 1}, {0, 2.5, 1.7}, {0, 1.5, 1.7}}));
  attic.body(stairs_body("steps", {.foot_m = {3.4, 3.5, 0},
                                   .direction_deg = 180,
                                   .width_m = 0.6,
                                   .rise_m = 0.15,
                                   .going_m = 0.3,
                                   .steps = 3}));
  return attic;
}

std::vector<Case> cases() {
  const std::vector<Eigen::Vector2d> l_shape{{0, 0}, {5, 0}, {5, 2}, {2, 2}, {2, 4}, {0, 4}};
  const std::vector<Eigen::Vector2d> u_shape{{0, 0},   {6, 0}, {6, 4},   {4.3, 4},
                                             {4.3, 2}, {2, 2}, {2, 3.7}, {0, 3.7}};
  const std::vector<Eigen::Vector2d> twelve{{0, 0},   {2, -1}, {5, 0},   {5.5, 2},
                                            {4, 2.5}, {5, 4},  {3, 3.4}, {2.5, 5},
                                            {1.7, 3}, {0, 4},  {0.5, 2}, {-1, 1}};
  std::vector<Case> list;
  list.push_back({"Box", rectangular_room(5, 4, 2.7).room(), 0.25});
  list.push_back({"BoxFine", rectangular_room(5, 4, 2.7).room(), 0.05});
  list.push_back({"PatchLargerThanRoom", rectangular_room(5, 4, 2.7).room(), 100});
  list.push_back({"Office", office().room(), 0.25});
  list.push_back({"OfficeCoarse", office().room(), 10});
  list.push_back({"Fine",
                  rectangular_room(0.8, 0.6, 0.5)
                      .opening(0, {0.2, 0.1}, {0.3, 0.3})
                      .panel(1, {0.4, 0.3}, {0.25, 0.25})
                      .box({0.2, 0.2, 0}, {0.5, 0.4, 0.2}, 17)
                      .room(),
                  0.02});
  list.push_back({"LShape",
                  RoomBuilder(l_shape, 2.5)
                      .opening(3, {0.5, 1}, {1, 1})
                      .panel(1, {1, 2}, {0.6, 1.2})
                      .box({2.5, 1, 0}, {3.5, 2, 1})
                      .room(),
                  0.3});
  list.push_back({"UShape", RoomBuilder(u_shape, 3).box({0, 0, 0}, {6, 1, 3}).room(), 0.3});
  list.push_back({"Triangle",
                  RoomBuilder({{0, 0}, {4, 1}, {1, 3}}, 2).panel(1, {1.7, 1.3}, {0.3, 0.2}).room(),
                  0.25});
  list.push_back(
      {"TwelveCorners", RoomBuilder(twelve, 2.4).box({2, 1, 0}, {3, 2, 1}, 45).room(), 0.25});
  // Joined by a door, and with a corner of 180 degrees in the south wall.
  list.push_back({"TwoRooms",
                  RoomBuilder({{0, 0},
                               {1, 0},
                               {3, 0},
                               {3, 1},
                               {3.1, 1},
                               {3.1, 0},
                               {6, 0},
                               {6, 3},
                               {3.1, 3},
                               {3.1, 1.9},
                               {3, 1.9},
                               {3, 3},
                               {0, 3}},
                              2.5)
                      .box({2, 2, 0}, {3, 3, 2})
                      .room(),
                  0.3});
  list.push_back({"TinyGap", rectangular_room(3, 3, 3).box({1e-6, 1, 0}, {1, 2, 1}).room(), 0.25});
  list.push_back(
      {"FloorToCeiling", rectangular_room(3, 3, 3).box({1, 1, 0}, {1.5, 1.6, 3}).room(), 0.25});
  list.push_back({"CornerWindowAndPanel",
                  rectangular_room(3, 3, 3)
                      .opening(0, {0, 0}, {1, 2})
                      .opening(1, {2, 1}, {1, 1})
                      .panel(2, {2.5, 2.5}, {1, 1})
                      .panel(1, {2.8, 2.9}, {0.4, 0.2})
                      .panel(0, {0.2, 0.2}, {0.4, 0.4})
                      .room(),
                  0.25});
  list.push_back({"TurnedRoom",
                  RoomBuilder({{0, 0}, {4, 3}, {2.2, 5.4}, {-1.8, 2.4}}, 2.5)
                      .panel(1, {1, 2.5}, {0.5, 0.5})
                      .box({0.5, 2, 0}, {1.5, 3, 1})
                      .room(),
                  0.3});
  list.push_back({"Attic", attic().room(), 0.3});
  return list;
}

double floor_m2(const Room& room) { return vector_area_m2(room.shell[0].outline).z(); }

double area_of(const PatchMesh& mesh, int surface) {
  long double sum = 0;
  for (std::size_t i = 0; i < mesh.area_m2.size(); ++i) {
    if (mesh.surface[i] == surface) sum += mesh.area_m2[i];
  }
  return static_cast<double>(sum);
}

class EveryRoom : public testing::TestWithParam<Case> {
 protected:
  const Room room_ = GetParam().room;
  const PatchMesh mesh_ = mesh_room(room_, GetParam().patch_m);
};

INSTANTIATE_TEST_SUITE_P(Mesh, EveryRoom, testing::ValuesIn(cases()),
                         [](const auto& each) { return each.param.name; });

// Conservation: the boundary of the air is closed and faces inwards, sum A n = 0.
TEST_P(EveryRoom, IsClosed) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double total = 0;
  for (std::size_t i = 0; i < mesh_.area_m2.size(); ++i) {
    sum += mesh_.area_m2[i] * mesh_.normal[i];
    total += mesh_.area_m2[i];
  }
  EXPECT_LT(sum.norm(), 1e-12 * total);
}

// Divergence theorem; with closedness it also finds patches in the wrong plane.
TEST_P(EveryRoom, HoldsTheVolumeOfTheAir) {
  double expected = volume_within(room_.shell);
  for (const Body& body : room_.furniture) expected -= volume_within(body.faces);
  long double volume = 0;  // in double, 1e5 equal terms round the same way and leave 1e-11
  for (std::size_t i = 0; i < mesh_.area_m2.size(); ++i) {
    volume -= mesh_.area_m2[i] * mesh_.normal[i].dot(mesh_.centre[i]) / 3;
  }
  EXPECT_NEAR(static_cast<double>(volume), expected, 1e-12 * expected);
}

TEST_P(EveryRoom, FloorIsThePlanWithoutFootprintsAndPanels) {
  double expected = floor_m2(room_);
  for (const Body& body : room_.furniture) {
    for (const Outline& face : body.faces) {
      const bool stands = std::ranges::all_of(face, [](const auto& p) { return p.z() == 0; });
      if (stands) expected -= vector_area_m2(face).norm();
    }
  }
  for (const Panel& panel : room_.panels) {
    if (panel.face == 0) expected -= vector_area_m2(panel.outline).norm();
  }
  EXPECT_NEAR(area_of(mesh_, 0), expected, 1e-12 * expected);
}

TEST_P(EveryRoom, OpeningsAndPanelsKeepTheirArea) {
  for (int i = 0; i < static_cast<int>(room_.surfaces.size()); ++i) {
    const Surface& s = room_.surfaces[static_cast<std::size_t>(i)];
    const auto index = static_cast<std::size_t>(s.index);
    if (s.kind == SurfaceKind::opening) {
      const double area_m2 = vector_area_m2(room_.openings[index].outline).norm();
      EXPECT_NEAR(area_of(mesh_, i), area_m2, 1e-12) << s.name;
    } else if (s.kind == SurfaceKind::panel) {
      const double area_m2 = vector_area_m2(room_.panels[index].outline).norm();
      EXPECT_NEAR(area_of(mesh_, i), area_m2, 1e-12) << s.name;
    }
  }
}

TEST_P(EveryRoom, PatchesAreConvexPlanarAndNoLongerThanAsked) {
  for (std::size_t i = 0; i < mesh_.area_m2.size(); ++i) {
    const auto& p = mesh_.polygon[i];
    ASSERT_GE(p.size(), 3U);
    EXPECT_GE(mesh_.area_m2[i], 1e-14);
    EXPECT_NEAR(mesh_.normal[i].norm(), 1, 1e-14);
    for (std::size_t k = 0; k < p.size(); ++k) {
      const Eigen::Vector3d edge = p[(k + 1) % p.size()] - p[k];
      const Eigen::Vector3d next = p[(k + 2) % p.size()] - p[(k + 1) % p.size()];
      EXPECT_LE(edge.norm(), GetParam().patch_m + 2e-9);
      EXPECT_GE(edge.norm(), 1e-9);
      // Above 0: counter-clockwise seen from the room, and no corner left on a straight edge.
      EXPECT_GT(edge.cross(next).dot(mesh_.normal[i]), 0);
      EXPECT_NEAR(mesh_.normal[i].dot(p[k] - mesh_.centre[i]), 0, 1e-14 * 10);
    }
  }
}

TEST_P(EveryRoom, PatchesOfASurfaceAreContiguousAndInOrder) {
  EXPECT_TRUE(std::ranges::is_sorted(mesh_.surface));
}

TEST_P(EveryRoom, EqualPlaneNumbersMeanOnePlaneAndOneSide) {
  std::map<int, std::size_t> first;
  for (std::size_t i = 0; i < mesh_.area_m2.size(); ++i) {
    const std::size_t k = first.try_emplace(mesh_.plane[i], i).first->second;
    EXPECT_LT((mesh_.normal[i] - mesh_.normal[k]).norm(), 1e-9);
    EXPECT_LT(std::abs(mesh_.normal[k].dot(mesh_.centre[i] - mesh_.centre[k])), 1e-9);
  }
}

TEST_P(EveryRoom, IsTheSameEveryTime) {
  const PatchMesh again = mesh_room(room_, GetParam().patch_m);
  EXPECT_EQ(again.polygon, mesh_.polygon);
  EXPECT_EQ(again.surface, mesh_.surface);
}

TEST(MeshRoom, EmptyBoxIsAGridOfRectangles) {
  const PatchMesh mesh = mesh_room(rectangular_room(5, 4, 2.7).room(), 0.25);
  EXPECT_EQ(mesh.size(), 2 * 21 * 17 + 2 * 12 * (21 + 17));
  for (const auto& polygon : mesh.polygon) EXPECT_EQ(polygon.size(), 4U);
  EXPECT_EQ(std::set<int>(mesh.plane.begin(), mesh.plane.end()).size(), 6U);
  // Exact coordinates: an axis-aligned room needs no tolerance anywhere.
  for (const auto& corner : mesh.polygon[0]) EXPECT_EQ(corner.z(), 0);
}

/// Widths of the patches of a surface along x, from west to east.
std::vector<double> widths_m(const PatchMesh& mesh, int surface) {
  std::set<double> lines;
  for (std::size_t i = 0; i < mesh.polygon.size(); ++i) {
    if (mesh.surface[i] != surface) continue;
    for (const Eigen::Vector3d& corner : mesh.polygon[i]) lines.insert(corner.x());
  }
  std::vector<double> widths;
  for (auto line = std::next(lines.begin()); line != lines.end(); ++line) {
    widths.push_back(*line - *std::prev(line));
  }
  return widths;
}

TEST(MeshRoom, CellsAlongTheEdgesOfTheRoomAreHalfAsWide) {
  const auto widths = [](const Room& room, const char* surface) {
    return widths_m(mesh_room(room, 0.5), find_surface(room, surface));
  };
  const Room room = rectangular_room(2.5, 4, 3).box({1, 1, 0.5}, {2.5, 2, 1}).room();
  const auto half = testing::DoubleNear(0.25, 1e-12), whole = testing::DoubleNear(0.5, 1e-12);
  const auto graded = testing::ElementsAre(half, whole, whole, whole, whole, half);
  for (const char* surface : {"floor", "ceiling", "wall_1"}) {
    EXPECT_THAT(widths(room, surface), graded) << surface;
  }
  EXPECT_THAT(widths(room, "box_1"), testing::ElementsAre(whole, whole, whole));
  // The edges of a panel are no edges of the room.
  const Room with_panel = rectangular_room(2.5, 4, 3).panel(1, {1.25, 2}, {1, 1}).room();
  EXPECT_THAT(widths(with_panel, "ceiling"), graded);
}

TEST(MeshRoom, FacesOfOnePatchStayWhole) {
  EXPECT_EQ(mesh_room(rectangular_room(5, 4, 2.7).room(), 5).size(), 6);
}

TEST(MeshRoom, AxisAlignedFurnitureLeavesRectangles) {
  const PatchMesh mesh =
      mesh_room(rectangular_room(5, 4, 2.7).box({1.7, 1.6, 0}, {3.3, 2.4, 0.75}).room(), 0.25);
  for (const auto& polygon : mesh.polygon) EXPECT_EQ(polygon.size(), 4U);
}

TEST(MeshRoom, OnlyPatchesAtTheContactAreCut) {
  const auto count = [](double from) {
    const Room room = rectangular_room(4, 4, 3).box({from, from, 0}, {2.25, 2.25, 1}).room();
    const PatchMesh mesh = mesh_room(room, 0.5);
    return std::ranges::count(mesh.surface, 0);
  };
  EXPECT_EQ(count(1.25), 81 - 4);  // on the grid: nothing is cut
  // 9 patches meet the footprint; 4 lie inside it, 4 keep one strip and the corner one keeps two.
  EXPECT_EQ(count(1.15), 81 - 9 + 4 + 2);
}

TEST(MeshRoom, FacesThatTouchAreGoneOnBothSides) {
  // Two equal cubes side by side against a wall: floor, wall and each other.
  const Room room =
      rectangular_room(4, 4, 3).box({1, 0, 0}, {2, 1, 1}).box({2, 0, 0}, {3, 1, 1}).room();
  const PatchMesh mesh = mesh_room(room, 0.5);
  EXPECT_NEAR(area_of(mesh, find_surface(room, "floor")), 16 - 2, 1e-12);
  EXPECT_NEAR(area_of(mesh, find_surface(room, "wall_1")), 12 - 2, 1e-12);
  EXPECT_NEAR(area_of(mesh, find_surface(room, "box_1")), 3, 1e-12);  // top, front, one side
  EXPECT_NEAR(area_of(mesh, find_surface(room, "box_2")), 3, 1e-12);
}

TEST(MeshRoom, AGapHoweverSmallKeepsBothFaces) {
  const Room room = rectangular_room(3, 3, 3).box({1e-6, 1, 0}, {1, 2, 1}).room();
  const PatchMesh mesh = mesh_room(room, 0.25);
  EXPECT_NEAR(area_of(mesh, find_surface(room, "wall_4")), 9, 1e-12);
  EXPECT_NEAR(area_of(mesh, find_surface(room, "box_1")), 2 + 3 * (1 - 1e-6), 1e-12);
}

TEST(MeshRoom, FloorOfATurnedRectangleIsAGridOfRectangles) {
  const Room room = RoomBuilder({{0, 0}, {4, 3}, {2.2, 5.4}, {-1.8, 2.4}}, 2.5).room();
  const PatchMesh mesh = mesh_room(room, 0.5);
  EXPECT_EQ(std::ranges::count(mesh.surface, 0), 11 * 7);
  for (const auto& polygon : mesh.polygon) EXPECT_EQ(polygon.size(), 4U);
}

TEST(MeshRoom, CornersOfAnLShapeAreGridLines) {
  const Room room =
      RoomBuilder({{0, 0}, {5, 0}, {5, 2.1}, {1.9, 2.1}, {1.9, 4}, {0, 4}}, 2.5).room();
  const PatchMesh mesh = mesh_room(room, 0.5);
  for (const auto& polygon : mesh.polygon) EXPECT_EQ(polygon.size(), 4U);
  EXPECT_EQ(std::ranges::count(mesh.surface, 0), (5 + 7) * 6 + 5 * 5);
}

TEST(MeshRoom, WallsInOnePlaneHaveOnePlaneNumber) {
  const Room room = RoomBuilder({{0, 0}, {2, 0}, {5, 0}, {5, 4}, {0, 4}}, 2.7).room();
  const PatchMesh mesh = mesh_room(room, 1);
  EXPECT_EQ(std::set<int>(mesh.plane.begin(), mesh.plane.end()).size(), 6U);
  EXPECT_EQ(std::set<int>(mesh.surface.begin(), mesh.surface.end()).size(), 7U);
}

TEST(MeshRoom, ACornerReflexByLessThanTheToleranceIsNoCorner) {
  // 0.24 nm off the line: seen from the long edge it is straight, seen from the short one it is
  // not.
  const Room room = RoomBuilder({{0, 0}, {0.5, 2.4e-10}, {10, 0}, {10, 4}, {0, 4}}, 2.7).room();
  const PatchMesh mesh = mesh_room(room, 0.3);
  for (const auto& polygon : mesh.polygon) EXPECT_GE(polygon.size(), 3U);
  EXPECT_NEAR(area_of(mesh, 0), 40 - 10 * 2.4e-10 / 2, 1e-12);
}

TEST(MeshRoom, RefusesPatchSizesThatMakeNoMesh) {
  const Room room = rectangular_room(5, 4, 2.7).room();
  for (const double patch_m : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW((void)mesh_room(room, patch_m), std::invalid_argument) << patch_m;
  }
  EXPECT_THROW((void)mesh_room(room, 1e-6), std::length_error);
  EXPECT_THROW((void)mesh_room(room, 1e-300), std::length_error);
}

TEST(MeshRoom, RefusesPlansThatAreNoRoom) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::vector<Eigen::Vector2d>> plans{
      {},
      {{0, 0}, {1, 0}},
      {{0, 0}, {0, 4}, {5, 4}, {5, 0}},  // clockwise
      {{0, 0}, {5, 0}, {1, 4}, {4, 5}},  // crosses itself, more area to the right
      {{0, 0}, {5, 0}, {5, nan}, {0, 4}},
      {{0, 0}, {2, 0}, {2, 2}, {1, -1}, {0, 2}}};  // crosses itself
  for (const auto& plan : plans) {
    EXPECT_THROW((void)mesh_room(RoomBuilder(plan, 2.7).room(), 0.25), std::invalid_argument);
  }
  EXPECT_THROW((void)mesh_room(rectangular_room(5, 4, 0).room(), 0.25), std::invalid_argument);
  EXPECT_THROW((void)mesh_room(rectangular_room(5, 4, nan).room(), 0.25), std::invalid_argument);
}

TEST(MeshRoom, UnboundedPatchesStillFollowTheOpenings) {
  const Room room = rectangular_room(5, 4, 2.7).opening(0, {1, 1}, {1, 1}).room();
  const PatchMesh mesh = mesh_room(room, std::numeric_limits<double>::infinity());
  EXPECT_EQ(mesh.size(), 5 + 9);
}

// A box on the floor gets a ring around its foot; a board before a wall its outline on the wall,
// and a line three gaps inside. No area is lost or counted twice.
TEST(CrowdedCells, FollowWhatStandsOnAFaceOrCloseToIt) {
  const Room room = rectangular_room(5, 4, 2.7)
                        .box({2, 1, 0}, {3, 2, 0.75})
                        .box({1, 3.97, 1}, {2, 3.99, 2})
                        .room();
  const PatchMesh plain = mesh_room(room, 0.8), crowded = mesh_room(room, 0.8, Cells::crowded);
  std::map<int, double> area_m2;
  for (std::size_t p = 0; p < plain.area_m2.size(); ++p)
    area_m2[plain.surface[p]] += plain.area_m2[p];
  for (std::size_t p = 0; p < crowded.area_m2.size(); ++p) {
    area_m2[crowded.surface[p]] -= crowded.area_m2[p];
  }
  for (const auto& [surface, rest] : area_m2) EXPECT_NEAR(rest, 0, 1e-12) << surface;
  const auto one_holds = [&](const Eigen::Vector3d& normal, const Eigen::Vector3d& p,
                             const Eigen::Vector3d& q) {
    for (std::size_t k = 0; k < crowded.polygon.size(); ++k) {
      if ((crowded.normal[k] - normal).norm() > 1e-9) continue;
      Eigen::AlignedBox3d box;
      for (const Eigen::Vector3d& v : crowded.polygon[k]) box.extend(v);
      if (box.contains(p) && box.contains(q)) return true;
    }
    return false;
  };
  const double ring_m = 0.3 * 0.8;
  EXPECT_FALSE(one_holds({0, 0, 1}, {2.5, 1 - 0.99 * ring_m, 0}, {2.5, 1 - 1.01 * ring_m, 0}));
  EXPECT_FALSE(one_holds({0, -1, 0}, {1.5, 4, 2.001}, {1.5, 4, 1.999}));
  EXPECT_FALSE(one_holds({0, -1, 0}, {1.5, 4, 1.971}, {1.5, 4, 1.969}));
}

}  // namespace
}  // namespace scenes
