#include "scenes/shapes/roof.h"

#include <gtest/gtest.h>

#include "scenes/shapes/room_builder.h"
#include "tests/scenes/shapes/volumes.h"

namespace scenes {
namespace {

using Eigen::Vector3d;

RoofPlane from_wall(const Polygon& plan_m, std::size_t wall, double height_m, double pitch_deg) {
  return pitched_plane(edge_line(plan_m, wall), height_m, pitch_deg);
}

void expect_closed(const std::vector<ShellFace>& shell, double volume_m3) {
  EXPECT_LT(gap_m2(shell).norm(), 1e-12);
  EXPECT_NEAR(volume_within(shell), volume_m3, 1e-12 * volume_m3);
  for (const ShellFace& face : shell) {
    const PlaneCoordinates plane(face.outline);
    EXPECT_LT((plane.normal() - face.frame.normal).norm(), 1e-12);
    for (const Vector3d& p : face.outline) {
      EXPECT_LT(std::abs(plane.height_m(p)), 1e-12);
      EXPECT_LT(std::abs(face.frame.normal.dot(p - face.frame.origin_m)), 1e-12);
    }
  }
}

TEST(RoofedShell, UnderOneLevelPlaneIsAPrism) {
  const std::vector<ShellFace> shell = roofed_shell(rectangular_plan(5, 4), {{.height_m = 2.7}});
  EXPECT_EQ(shell.size(), 6U);
  expect_closed(shell, 5 * 4 * 2.7);
}

// A gable of 45 degrees over 5 x 4 m, eaves at 1 m: ridge at 3 m.
TEST(RoofedShell, GableHasARidgeAndTwoFiveCorneredWalls) {
  const Polygon plan = rectangular_plan(5, 4);
  const std::vector<ShellFace> shell =
      roofed_shell(plan, {from_wall(plan, 0, 1, 45), from_wall(plan, 2, 1, 45)});
  ASSERT_EQ(shell.size(), 7U);
  expect_closed(shell, 5 * (4 * 1 + 4));
  EXPECT_EQ(shell[1].surface, 1);
  EXPECT_EQ(shell[2].surface, 1);
  EXPECT_EQ(shell[3].outline.size(), 4U);
  EXPECT_EQ(shell[4].outline.size(), 5U);
  EXPECT_EQ(shell[4].surface, 3);
}

// V = d^2 (3 w - d) / 12 above the eaves of a hipped roof of 45 degrees over w x d, d <= w.
TEST(RoofedShell, HipHasFourSlopes) {
  const Polygon plan = rectangular_plan(6, 4);
  std::vector<RoofPlane> planes;
  for (std::size_t wall = 0; wall < 4; ++wall) planes.push_back(from_wall(plan, wall, 2, 45));
  const std::vector<ShellFace> shell = roofed_shell(plan, planes);
  ASSERT_EQ(shell.size(), 9U);
  expect_closed(shell, 6 * 4 * 2 + 4.0 * 4 * (3 * 6 - 4) / 12);
}

// With a level ceiling 1 m above the eaves: the wedge above it is gone.
TEST(RoofedShell, TheLowestPlaneCounts) {
  const Polygon plan = rectangular_plan(5, 4);
  const std::vector<ShellFace> shell =
      roofed_shell(plan, {from_wall(plan, 0, 1, 45), from_wall(plan, 2, 1, 45), {.height_m = 2}});
  ASSERT_EQ(shell.size(), 8U);
  expect_closed(shell, 5 * (4 * 1 + 4 - 1));
  EXPECT_EQ(shell[5].outline.size(), 6U);
}

// One plane over any plan: area times its height over the centroid.
TEST(RoofedShell, LeanToOverAPlanWithAReflexCorner) {
  const Polygon plan{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 5}, {0, 5}};
  const RoofPlane plane = from_wall(plan, 0, 2, 20);
  expect_closed(roofed_shell(plan, {plane}), area(plan) * plane.over(centroid(plan)));
  const std::vector<ShellFace> two = roofed_shell(plan, {plane, {.height_m = 3}});
  EXPECT_LT(gap_m2(two).norm(), 1e-12);
  EXPECT_LT(volume_within(two), area(plan) * plane.over(centroid(plan)));
}

TEST(RoofPlane, GoesThroughItsCorners) {
  const Outline corners{{0, 0, 2}, {4, 0, 3}, {0, 5, 1}};
  const RoofPlane plane = roof_plane_of(corners);
  for (const Vector3d& c : corners) EXPECT_NEAR(plane.over(c.head<2>()), c.z(), 1e-14);
}

}  // namespace
}  // namespace scenes
