#include "scenes/room.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <numbers>

#include "tests/scenes/test_rooms.h"

namespace scenes {
namespace {

using testing::ElementsAre;

TEST(FindSurface, FollowsTheOrderOfTheRoom) {
  const Room room =
      rectangular_room(5, 4, 2.7).opening(0, {1, 1}, {1, 1}).box({1, 1, 0}, {2, 2, 1}).room();
  EXPECT_EQ(find_surface(room, "floor"), 0);
  EXPECT_EQ(find_surface(room, "wall_4"), 5);
  EXPECT_EQ(find_surface(room, "box_1"), 7);
  EXPECT_EQ(find_surface(room, "sofa"), -1);
}

TEST(Footprint, IsExactWithoutRotation) {
  const Box box{.name = "box", .min_m = {1.7, 1.6, 0}, .max_m = {3.3, 2.4, 0.75}};
  using V = Eigen::Vector2d;
  EXPECT_THAT(footprint(box), ElementsAre(V(1.7, 1.6), V(3.3, 1.6), V(3.3, 2.4), V(1.7, 2.4)));
}

TEST(Footprint, TurnsCounterClockwiseAboutTheCentre) {
  const Box box{.name = "box", .min_m = {0, 0, 0}, .max_m = {4, 2, 1}, .rotate_z_deg = 90};
  const auto corners = footprint(box);  // the corner (0, 0) goes to (3, -1)
  EXPECT_LT((corners[0] - Eigen::Vector2d(3, -1)).norm(), 1e-15);
  EXPECT_LT((corners[1] - Eigen::Vector2d(3, 3)).norm(), 1e-15);
}

TEST(FrameOf, NormalsPointIntoTheRoom) {
  const Room room = rectangular_room(5, 4, 2.7).panel(1, {2, 2}, {1, 1}).room();
  const Eigen::Vector3d middle(2.5, 2, 1.35);
  for (int surface = 0; surface <= 6; ++surface) {
    const Frame frame = frame_of(room, surface);
    EXPECT_GT(frame.normal.dot(middle - frame.origin_m), 0) << surface;
    EXPECT_NEAR(std::abs(frame.along.cross(frame.up).dot(frame.normal)), 1, 1e-15) << surface;
  }
}

TEST(FrameOf, RefusesFurniture) {
  const Room room = rectangular_room(5, 4, 2.7).box({1, 1, 0}, {2, 2, 1}).room();
  EXPECT_THROW((void)frame_of(room, 6), std::invalid_argument);
}

TEST(RectangleOf, OpeningIsMeasuredFromTheFirstCornerOfItsWall) {
  // Wall 2 runs from (5, 4) to (0, 4); seen from the room its first corner is on the right.
  const Room room = rectangular_room(5, 4, 2.7).opening(2, {1.5, 0.9}, {2, 1.4}).room();
  const auto corners = rectangle_of(room, 6);
  Eigen::AlignedBox3d box;
  for (const auto& corner : corners) box.extend(corner);
  EXPECT_LT((box.min() - Eigen::Vector3d(1.5, 4, 0.9)).norm(), 1e-15);
  EXPECT_LT((box.max() - Eigen::Vector3d(3.5, 4, 2.3)).norm(), 1e-15);
}

TEST(RectangleOf, CornersRunCounterClockwiseSeenFromTheRoom) {
  const Room room = rectangular_room(5, 4, 2.7)
                        .opening(0, {1, 1}, {1, 1})
                        .panel(0, {1, 1}, {1, 0.5})
                        .panel(1, {2, 1}, {1, 0.5})
                        .panel(3, {2, 1}, {1, 0.5})
                        .room();
  for (int surface = 6; surface < 10; ++surface) {
    const auto c = rectangle_of(room, surface);
    const Eigen::Vector3d turn = (c[1] - c[0]).cross(c[2] - c[1]);
    EXPECT_GT(turn.dot(frame_of(room, surface).normal), 0) << surface;
  }
  EXPECT_THROW((void)rectangle_of(room, 0), std::invalid_argument);
}

}  // namespace
}  // namespace scenes
