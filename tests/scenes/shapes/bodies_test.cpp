#include "scenes/shapes/bodies.h"

#include <gmock/gmock.h>

#include <numbers>

#include "tests/scenes/shapes/volumes.h"

namespace scenes {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
using testing::ElementsAre;

const Polygon kAngle{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 3}, {0, 3}};  // 4 m^2

struct Known {
  Body body;
  double volume_m3 = 0;
};

std::vector<Known> known_bodies() {
  const Stairs stairs{.foot_m = {1, 2, 0.5},
                      .direction_deg = 30,
                      .width_m = 0.9,
                      .rise_m = 0.18,
                      .going_m = 0.26,
                      .steps = 5};
  Eigen::Isometry3d tilt = Eigen::Isometry3d::Identity();
  tilt.rotate(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()));
  return {{box_body("box", {1, 2, 3}, {2, 4, 6}, 25), 6},
          {prism_body("angle", kAngle, 0.5, 1.25), 3},
          {prism_body("cylinder", regular_polygon({3, 1}, 0.4, 24), 0, 2), pi * 0.16 * 2},
          {stairs_body("stairs", stairs), 15 * 0.9 * 0.18 * 0.26},
          {moved(prism_body("tilted", kAngle, 0, 1), tilt), 4}};
}

TEST(Bodies, AreClosedAndHoldTheirVolume) {
  for (const auto& [body, volume_m3] : known_bodies()) {
    EXPECT_LT(gap_m2(body.faces).norm(), 1e-12) << body.name;
    EXPECT_NEAR(volume_within(body.faces), volume_m3, 1e-12 * volume_m3) << body.name;
  }
}

TEST(Bodies, AreFilledByTheirConvexParts) {
  for (const auto& [body, volume_m3] : known_bodies()) {
    double parts_m3 = 0;
    for (const ConvexPart& part : body.parts) parts_m3 += volume_within(part);
    EXPECT_NEAR(parts_m3, volume_m3, 1e-12 * volume_m3) << body.name;
    EXPECT_FALSE(body.two_sided);
  }
}

TEST(BoxBody, IsExactWithoutRotation) {
  const Body box = box_body("box", {1.7, 1.6, 0}, {3.3, 2.4, 0.75});
  EXPECT_THAT(box.faces[1], ElementsAre(Vector3d(1.7, 1.6, 0.75), Vector3d(3.3, 1.6, 0.75),
                                        Vector3d(3.3, 2.4, 0.75), Vector3d(1.7, 2.4, 0.75)));
}

TEST(BoxBody, TurnsCounterClockwiseAboutItsCentre) {
  const Body box = box_body("box", {0, 0, 0}, {4, 2, 1}, 90);  // the corner (0, 0) goes to (3, -1)
  EXPECT_LT((box.faces[1][0] - Vector3d(3, -1, 1)).norm(), 1e-15);
  EXPECT_LT((box.faces[1][1] - Vector3d(3, 3, 1)).norm(), 1e-15);
}

// Climbing along +y, the highest step is the furthest, and the foot's middle lies on the floor.
TEST(StairsBody, ClimbsWhereItIsTold) {
  const Body stairs = stairs_body("stairs", {.foot_m = {2, 1, 0},
                                             .direction_deg = 90,
                                             .width_m = 1,
                                             .rise_m = 0.2,
                                             .going_m = 0.25,
                                             .steps = 4});
  Eigen::AlignedBox3d extent;
  for (const Outline& face : stairs.faces) {
    for (const Vector3d& p : face) extent.extend(p);
  }
  EXPECT_LT((extent.min() - Vector3d(1.5, 1, 0)).norm(), 1e-12);
  EXPECT_LT((extent.max() - Vector3d(2.5, 2, 0.8)).norm(), 1e-12);
  const auto top = std::ranges::max_element(
      stairs.faces, {}, [](const Outline& f) { return vector_area_m2(f).z() + 10 * f[0].z(); });
  for (const Vector3d& p : *top) EXPECT_GT(p.y(), 1.75 - 1e-12);
}

TEST(SheetBody, LooksBothWays) {
  const Outline outline{{0, 0, 0}, {2, 0, 0}, {2, 0, 1}, {1, 0, 1}, {1, 0, 2}, {0, 0, 2}};
  const Body sheet = sheet_body("sheet", outline);
  EXPECT_TRUE(sheet.two_sided);
  ASSERT_EQ(sheet.faces.size(), 2U);
  EXPECT_LT((vector_area_m2(sheet.faces[0]) - Vector3d(0, -3, 0)).norm(), 1e-15);
  EXPECT_LT((vector_area_m2(sheet.faces[1]) - Vector3d(0, 3, 0)).norm(), 1e-15);
  double area_m2 = 0;
  for (const ConvexPart& part : sheet.parts) area_m2 += vector_area_m2(part.corners).norm();
  EXPECT_NEAR(area_m2, 3, 1e-15);
}

}  // namespace
}  // namespace scenes
