#include "scenes/shapes/mesh_body.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <numbers>

#include "scenes/shapes/bodies.h"
#include "scenes/shapes/enclosure.h"
#include "tests/scenes/shapes/volumes.h"

namespace scenes {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

/// The faces of bodies as fans of triangles from the corner nearest to `apex`, every other one
/// turned round.
std::vector<MeshPolygon> triangles_of(const std::vector<Body>& bodies,
                                      const Vector3d& apex = Vector3d::Zero()) {
  std::vector<MeshPolygon> triangles;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    for (Outline face : bodies[b].faces) {
      const auto nearest =
          std::ranges::min_element(face, {}, [&](const Vector3d& p) { return (p - apex).norm(); });
      std::rotate(face.begin(), nearest, face.end());
      for (std::size_t k = 2; k < face.size(); ++k) {
        Outline triangle{face[0], face[k - 1], face[k]};
        if (triangles.size() % 2 == 1) std::swap(triangle[0], triangle[1]);
        triangles.push_back({.outline = triangle, .part = static_cast<int>(b)});
      }
    }
  }
  return triangles;
}

double parts_m3(const Body& body) {
  double sum = 0;
  for (const ConvexPart& part : body.parts) {
    if (part.faces.size() > 2) sum += volume_within(part);
  }
  return sum;
}

TEST(MeshBody, TrianglesOfABoxBecomeABox) {
  const MeshBody mesh =
      mesh_body("box", triangles_of({box_body("", {0, 0, 0}, {1, 2, 3}, 20)}), false);
  EXPECT_TRUE(mesh.faults.empty());
  EXPECT_EQ(mesh.body.faces.size(), 6U);
  EXPECT_EQ(mesh.body.parts.size(), 1U);
  EXPECT_NEAR(volume_within(mesh.body.faces), 6, 1e-9);
  EXPECT_NEAR(parts_m3(mesh.body), 6, 1e-9);
}

// A table top on four legs that it touches, each a part of its own.
TEST(MeshBody, ConvexShellsThatTouchHideAsWholes) {
  std::vector<Body> bodies{box_body("", {0, 0, 0.7}, {1.2, 0.8, 0.74})};
  for (const double x : {0.0, 1.15}) {
    for (const double y : {0.0, 0.75}) {
      bodies.push_back(box_body("", {x, y, 0}, {x + 0.05, y + 0.05, 0.7}));
    }
  }
  const MeshBody mesh = mesh_body("table", triangles_of(bodies), false);
  EXPECT_TRUE(mesh.faults.empty()) << mesh.faults.front();
  EXPECT_EQ(mesh.body.faces.size(), 30U);
  EXPECT_EQ(mesh.body.part_of_face.back(), 4);
  EXPECT_NEAR(volume_within(mesh.body.faces), 1.2 * 0.8 * 0.04 + 4 * 0.7 * 0.0025, 1e-9);
}

TEST(MeshBody, WhatIsNotConvexHidesFaceByFace) {
  const Polygon angle{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};
  const MeshBody mesh = mesh_body("sofa", triangles_of({prism_body("", angle, 0, 0.5)}), false);
  // Fans from the first corner of that plan stay within it.
  ASSERT_TRUE(mesh.faults.empty()) << mesh.faults.front();
  EXPECT_EQ(mesh.body.faces.size(), 8U);
  for (const ConvexPart& part : mesh.body.parts) EXPECT_EQ(part.faces.size(), 2U);
  EXPECT_NEAR(volume_within(mesh.body.faces), 2, 1e-9);
  EXPECT_NEAR(distance_m(mesh.body, {0.5, 0.5, 0.25}), -0.25, 1e-9);
  EXPECT_NEAR(distance_m(mesh.body, {1.5, 1.5, 0.25}), 0.5, 1e-9);
}

TEST(MeshBody, CurvedMeshesKeepTheirFacets) {
  const Body cylinder = prism_body("", regular_polygon({0, 0}, 0.5, 48), 0, 1);
  const MeshBody mesh = mesh_body("drum", triangles_of({cylinder}), false);
  EXPECT_EQ(mesh.body.faces.size(), 50U);
  EXPECT_EQ(mesh.body.parts.size(), 1U);
  EXPECT_NEAR(volume_within(mesh.body.faces), std::numbers::pi / 4, 1e-9);
}

TEST(MeshBody, BentQuadrilateralsArePartedAndSliversLeftOut) {
  std::vector<MeshPolygon> cube;
  for (const Outline& face : box_body("", {0, 0, 0}, {1, 1, 1}).faces) {
    cube.push_back({.outline = face});
    for (Vector3d& p : cube.back().outline) {
      if (p == Vector3d(1, 1, 1)) p.z() = 1.2;
    }
  }
  cube.push_back({.outline = {{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}}});
  const MeshBody mesh = mesh_body("cube", cube, false);
  ASSERT_TRUE(mesh.faults.empty()) << mesh.faults.front();
  EXPECT_EQ(mesh.body.faces.size(), 7U);
  EXPECT_THAT(mesh.notes, testing::ElementsAre(HasSubstr("no area"), HasSubstr("bent")));
}

TEST(MeshBody, OpenDoubledAndCrossingMeshesAreRefused) {
  std::vector<MeshPolygon> open = triangles_of({box_body("", {0, 0, 0}, {1, 1, 1})});
  std::vector<MeshPolygon> doubled = open;
  doubled.push_back(doubled.front());
  open.pop_back();
  EXPECT_THAT(mesh_body("", open, false).faults.at(0), HasSubstr("meets no other face"));
  EXPECT_FALSE(mesh_body("", doubled, false).faults.empty());
  const MeshBody crossing = mesh_body(
      "",
      triangles_of({box_body("", {0, 0, 0}, {1, 1, 1}), box_body("", {0.5, 0.5, 0.5}, {2, 2, 2})}),
      false);
  ASSERT_FALSE(crossing.faults.empty());
}

// Which way round a thin face is given means nothing: it must not lie on another.
TEST(MeshBody, ThinFacesMayNotLieOnEachOther) {
  const Outline square{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  Outline moved = square;
  for (Vector3d& p : moved) p += Vector3d(0.5, 0.5, 0);
  for (const bool turned : {false, true}) {
    if (turned) std::reverse(moved.begin(), moved.end());
    EXPECT_FALSE(mesh_body("", {{.outline = square}, {.outline = moved}}, true).faults.empty());
  }
}

TEST(MeshBody, ThinMeshesLookBothWays) {
  const std::vector<MeshPolygon> fold{{.outline = {{0, 0, 0}, {1, 0, 0}, {1, 0, 2}, {0, 0, 2}}},
                                      {.outline = {{1, 0, 0}, {1, 1, 0}, {1, 1, 2}, {1, 0, 2}}}};
  EXPECT_FALSE(mesh_body("", fold, false).faults.empty());
  const MeshBody mesh = mesh_body("", fold, true);
  ASSERT_TRUE(mesh.faults.empty());
  EXPECT_EQ(mesh.body.faces.size(), 4U);
  EXPECT_LT(gap_m2(mesh.body.faces).norm(), 1e-15);
  EXPECT_EQ(mesh.body.parts.size(), 2U);
}

}  // namespace
}  // namespace scenes
