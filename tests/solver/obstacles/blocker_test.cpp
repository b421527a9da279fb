#include "solver/obstacles/blocker.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <random>
#include <string>

#include "scenes/shapes/room_builder.h"
#include "solver/exchange/exchange.h"
#include "solver/obstacles/segments.h"
#include "solver/sources/direct_light.h"

namespace solver {
namespace {

using Eigen::Vector3d;
using Polygon = std::vector<Vector3d>;

struct Box {
  std::string name;
  Vector3d min_m, max_m;
  double rotate_z_deg = 0;
};

const Box kDesk{.name = "desk", .min_m = {1, 1, 0.2}, .max_m = {2.2, 1.7, 0.9}, .rotate_z_deg = 25};
const Box kShelf{.name = "shelf", .min_m = {2, 0.5, 0.3}, .max_m = {2.4, 2.5, 1.8}};

std::vector<Blocker> furniture(const std::vector<Box>& boxes) {
  scenes::Room room;
  for (const Box& b : boxes) {
    room.furniture.push_back(scenes::box_body(b.name, b.min_m, b.max_m, b.rotate_z_deg));
  }
  return blockers_of(room);
}

/// Whether a segment passes through a box, by the slabs of its own frame.
bool passes(const Box& box, Vector3d from, Vector3d to) {
  const Vector3d middle = (box.min_m + box.max_m) / 2;
  const Eigen::AngleAxisd back(-box.rotate_z_deg * std::numbers::pi / 180, Vector3d::UnitZ());
  from = back * (from - middle);
  to = back * (to - middle);
  double enter = 0, leave = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double half = (box.max_m - box.min_m)[axis] / 2, d = to[axis] - from[axis];
    const double a = (-half - from[axis]) / d, b = (half - from[axis]) / d;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave;
}

double area_m2(const std::vector<Polygon>& polygons) {
  double sum = 0;
  for (const Polygon& p : polygons) sum += make_facet(p).area_m2;
  return sum;
}

int count_containing(const std::vector<Polygon>& parts, const Vector3d& normal, const Vector3d& p) {
  return static_cast<int>(
      std::ranges::count_if(parts, [&](const Polygon& part) { return contains(part, normal, p); }));
}

scenes::Room l_shaped_room() {
  const scenes::Polygon plan_m{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}};
  return scenes::RoomBuilder(plan_m, 2.5, 0, {.first_nm = 500, .step_nm = 10, .count = 1})
      .opening(2, {0.5, 0.8}, {1, 1})
      .box({1, 1.5, 0}, {1.9, 3.2, 2.2})  // a post
      .box({3, 0.6, 0}, {3.8, 1.4, 0.8})  // a desk
      .room();
}

TEST(Blockers, AreClosedAndOnlyWhatStandsInTheRoom) {
  EXPECT_EQ(blockers_of(l_shaped_room()).size(), 2U + 2U);  // furniture, re-entrant walls
  double volume_m3 = 0;
  const Blocker desk = furniture({kDesk}).at(0);
  for (const Blocker::Face& face : desk.faces) {
    Polygon polygon;
    for (const int c : face.corners) polygon.push_back(desk.corners[static_cast<std::size_t>(c)]);
    volume_m3 += make_facet(polygon).area_m2 * face.plane.offset_m / 3;
  }
  EXPECT_NEAR(volume_m3, 1.2 * 0.7 * 0.7, 1e-13);
}

Box grown(Box box, double by_m) {
  box.min_m.array() -= by_m;
  box.max_m.array() += by_m;
  return box;
}

/// Segments that pass within a millimetre of a face, or end there, may go either way.
/// @return whether it surely passes through the box
bool expect_blocked(const Box& box, const Vector3d& a, const Vector3d& b, bool blocked) {
  const bool inside = passes(grown(box, -1e-3), a, b);
  if (inside == passes(grown(box, 1e-3), a, b)) {
    EXPECT_EQ(blocked, inside) << box.name << ": " << a.transpose() << " to " << b.transpose();
  }
  return inside;
}

// Random segments, also from face to face of the box itself and with ends inside.
TEST(Segments, AreBlockedWhereTheyPassThroughABox) {
  const Segments segments(furniture({kDesk, kShelf}));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 3);
  int hits = 0;
  for (int packet = 0; packet < 500; ++packet) {
    std::vector<std::pair<Vector3d, Vector3d>> ends;
    Points16 from, to;
    for (int k = 0; k < 16; ++k) {
      ends.emplace_back(Vector3d(unit(random), unit(random), unit(random)),
                        Vector3d(unit(random), unit(random), unit(random)));
      from.row(k) = segments.local(ends.back().first);
      to.row(k) = segments.local(ends.back().second);
    }
    const std::uint32_t desk = segments.blocked(0, from, to), shelf = segments.blocked(1, from, to);
    for (std::size_t k = 0; k < 16; ++k) {
      const auto& [a, b] = ends[k];
      hits += expect_blocked(kDesk, a, b, (desk >> k & 1U) == 1);
      hits += expect_blocked(kShelf, a, b, (shelf >> k & 1U) == 1);
    }
  }
  EXPECT_GT(hits, 1000);
}

// Along a face, from it, up to it, and along an edge: all touch, none pass.
TEST(Segments, ThatTouchABlockerPass) {
  const Segments segments(furniture({{.name = "post", .min_m = {0, 0, 0}, .max_m = {1, 1, 2}}}));
  const std::vector<std::pair<Vector3d, Vector3d>> touching{
      {{-1, 0.5, 2}, {2, 0.5, 2}}, {{0.5, 0.5, 2}, {3, 1, 2.5}}, {{3, 1, 2.5}, {0.5, 0.5, 2}},
      {{0, 0, -1}, {0, 0, 3}},     {{1, 0.2, 0.5}, {2, 2, 2}},   {{-1, 0, 1}, {2, 0, 1}}};
  for (const auto& [a, b] : touching) {
    Points16 from, to;
    for (int k = 0; k < 16; ++k) {
      from.row(k) = segments.local(a);
      to.row(k) = segments.local(b);
    }
    EXPECT_EQ(segments.blocked(0, from, to), 0U) << a.transpose() << " to " << b.transpose();
  }
}

// A wall of an L-shaped plan is a plate.
TEST(Segments, AreBlockedByAPlateWithinItsEdges) {
  scenes::Room room = l_shaped_room();
  room.furniture.clear();
  const std::vector<Blocker> walls = blockers_of(room);
  const Segments segments(walls);
  const auto blocked = [&](const Vector3d& a, const Vector3d& b) {
    Points16 from, to;
    for (int k = 0; k < 16; ++k) {
      from.row(k) = segments.local(a);
      to.row(k) = segments.local(b);
    }
    std::uint32_t all = 0;
    for (std::size_t w = 0; w < walls.size(); ++w) all |= segments.blocked(w, from, to);
    return all != 0;
  };
  EXPECT_TRUE(blocked({1, 3.5, 1}, {3.5, 1, 1}));   // across the outer corner
  EXPECT_FALSE(blocked({1, 2.5, 1}, {2.5, 1, 1}));  // past the inner one
  EXPECT_FALSE(blocked({2, 3, 1}, {0, 1, 2}));      // from the plate
}

// A tilted triangle behind two boxes that hide each other in part: every point of it is in one lit
// part, or its segment to the light passes through a box.
TEST(Shadows, LitPartsAreWhatSegmentsReach) {
  const std::vector<Box> boxes{kDesk, kShelf};
  const Facet wall = make_facet({{3.5, 0, 0.1}, {3.3, 3, 0.1}, {3.2, 1.4, 2.6}});
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  int hidden = 0;
  for (int light = 0; light < 20; ++light) {
    const Vector3d at(unit(random), 3 * unit(random), 2.5 * unit(random));
    const Shadows shadows(furniture(boxes), from_point(at));
    const std::vector<Polygon> lit = shadows.lit_parts(wall.vertices);
    for (int k = 0; k < 500; ++k) {
      const Vector3d p = area_point(wall, unit(random), unit(random));
      const bool dark = passes(kDesk, at, p) || passes(kShelf, at, p);
      hidden += dark;
      EXPECT_EQ(count_containing(lit, wall.normal, p), dark ? 0 : 1);
      EXPECT_EQ(shadows.contain(p), dark);
    }
  }
  EXPECT_GT(hidden, 1000);
  EXPECT_LT(hidden, 9500);
}

// Seen from above at an angle, the top of a box shadows the floor as itself, moved.
TEST(Shadows, SunCastsTheTopAndTheSidesOfABox) {
  const Shadows shadows(furniture({{.name = "post", .min_m = {0, 0, 0}, .max_m = {1, 1, 2}}}),
                        from_direction({1, 0, 1}));
  const Polygon floor{{-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0}};
  EXPECT_NEAR(area_m2(shadows.lit_parts(floor)), 100 - 3, 1e-12);  // -2 < x < 1
  EXPECT_TRUE(shadows.contain({-1.9, 0.5, 0}));
  EXPECT_FALSE(shadows.contain({-2.1, 0.5, 0}));
  EXPECT_FALSE(shadows.contain({0.5, 0.5, 2}));  // its own lit face
}

TEST(Shadows, FacesThatTheLightTouchesAndThatTouchTheLightStayLit) {
  const Box post{.name = "post", .min_m = {0, 0, 0}, .max_m = {1, 1, 2}};
  const Polygon top{{0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}};
  const Polygon ceiling{{-3, -3, 3}, {-3, 3, 3}, {3, 3, 3}, {3, -3, 3}};
  for (const Vector3d& on_post : {Vector3d(0.5, 0.5, 2), {1, 0.5, 2}, {1, 1, 2}}) {
    const Shadows shadows(furniture({post}), from_point(on_post));
    EXPECT_EQ(shadows.lit_parts(ceiling), std::vector<Polygon>{ceiling});
  }
  EXPECT_EQ(Shadows(furniture({post}), from_point({0.3, 0.2, 2.5})).lit_parts(top),
            std::vector<Polygon>{top});
}

// The post stands in the other arm of the room, where no light passes that comes in by the window,
// and reaches through the plane of the window. The desk stands in the light.
TEST(DirectLight, SunIsHiddenOnlyByWhatStandsBehindTheWindow) {
  scenes::Room room = l_shaped_room();
  room.suns.push_back({.name = "sun",
                       .azimuth_deg = 315,
                       .altitude_deg = 30,
                       .normal_irradiance = {room.grid, Eigen::ArrayXd::Ones(1)}});
  const scenes::PatchMesh mesh = scenes::mesh_room(room, 0.3);
  const DirectLight light =
      DirectSources(room, Visibility(room, mesh)).on_patches(mesh, facets_of(mesh));
  EXPECT_LT(light.largest_scaling(), 1e-9);
  double on_desk = 0;
  for (std::size_t p = 0; p < mesh.area_m2.size(); ++p) {
    const bool desk = room.surfaces[static_cast<std::size_t>(mesh.surface[p])].name == "box_2";
    if (desk) on_desk += light.irradiance(static_cast<Eigen::Index>(p), 0) * mesh.area_m2[p];
  }
  EXPECT_GT(on_desk, 0.05);
}

// What patches get of a point light sums to all of it, with furniture and re-entrant walls.
TEST(DirectLight, AllFluxOfAPointLightArrives) {
  scenes::Room room = l_shaped_room();
  room.point_lights.push_back({.name = "bulb",
                               .at_m = {2.4, 0.5, 2.1},
                               .spectral_flux = {room.grid, Eigen::ArrayXd::Ones(1)}});
  const scenes::PatchMesh mesh = scenes::mesh_room(room, 0.3);
  const DirectLight light =
      DirectSources(room, Visibility(room, mesh)).on_patches(mesh, facets_of(mesh));
  EXPECT_LT(light.largest_scaling(), 1e-9);
}

}  // namespace
}  // namespace solver
