#include "scenes/shapes/enclosure.h"

#include <gtest/gtest.h>

#include "scenes/shapes/room_builder.h"
#include "scenes/shapes/shell.h"

namespace scenes {
namespace {

using Eigen::Vector3d;

Enclosure attic() {
  const Polygon plan = rectangular_plan(5, 4);
  return Enclosure(roofed_shell(
      plan, {pitched_plane(edge_line(plan, 0), 1, 45), pitched_plane(edge_line(plan, 2), 1, 45)}));
}

Enclosure l_shape() {
  return Enclosure(prism_shell({{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 5}, {0, 5}}, 2.5));
}

TEST(Enclosure, ClearanceIsTheDistanceToTheNearestFace) {
  EXPECT_NEAR(attic().clearance_m({2.5, 2, 0.4}), 0.4, 1e-15);
  EXPECT_NEAR(attic().clearance_m({2.5, 2, 2.5}), 0.5 * std::sqrt(0.5), 1e-15);  // below the ridge
  EXPECT_NEAR(attic().clearance_m({2.5, 0, 0.5}), 0, 1e-15);
  EXPECT_NEAR(attic().clearance_m({2.5, 1, 2.5}), -0.5 * std::sqrt(0.5), 1e-15);  // above a slope
  EXPECT_NEAR(l_shape().clearance_m({1.5, 3, 1}), 0.5, 1e-15);
  EXPECT_NEAR(l_shape().clearance_m({3, 3, 1}), -1, 1e-15);
  EXPECT_NEAR(l_shape().clearance_m({2.3, 1.6, 1}), 0.4, 1e-15);  // past the inner corner
}

TEST(Enclosure, BodiesMayTouchButNotReachThroughIt) {
  const auto through = [](const Enclosure& room, const Vector3d& low, const Vector3d& high) {
    return room.reached_through(box_body("box", low, high));
  };
  EXPECT_EQ(through(attic(), {0, 0, 0}, {1, 1, 1}), -1);     // in a corner, touches the slope
  EXPECT_EQ(through(attic(), {0, 0, 0}, {1, 1, 1.001}), 1);  // into the slope
  EXPECT_EQ(through(attic(), {1, 1, 0}, {2, 3, 2}), -1);     // its upper edges touch both slopes
  EXPECT_GE(through(attic(), {1, 1, 0}, {2, 3, 2.01}), 1);
  EXPECT_EQ(through(attic(), {4.5, 1, 0.2}, {5.1, 2, 1}), 4);  // a wall
  EXPECT_EQ(through(l_shape(), {1, 1, 0}, {2, 2, 1}), -1);     // touches the inner corner
  EXPECT_GE(through(l_shape(), {1, 1, 0}, {2.1, 2.1, 1}), 0);
  const Body curtain = sheet_body("curtain", {{1, 0.1, 0}, {2, 0.1, 0}, {2, 0.1, 1}, {1, 0.1, 1}});
  EXPECT_EQ(attic().reached_through(curtain), -1);
  const Body poster = sheet_body("poster", {{1, 0, 0}, {2, 0, 0}, {2, 0, 1}, {1, 0, 1}});
  EXPECT_EQ(attic().reached_through(poster), -1);  // flush with the wall
  const Body fin = sheet_body("fin", {{1, -0.1, 0}, {1, 1, 0}, {1, 1, 1}, {1, -0.1, 1}});
  EXPECT_EQ(attic().reached_through(fin), 3);
}

TEST(Overlap, IsMoreThanTouching) {
  const Body post = box_body("post", {1, 1, 0}, {2, 2, 1});
  EXPECT_FALSE(overlap(post, box_body("on top", {1.2, 1.2, 1}, {3, 3, 2}, 20)));
  EXPECT_TRUE(overlap(post, box_body("sunk", {1.2, 1.2, 0.99}, {3, 3, 2}, 20)));
  EXPECT_TRUE(overlap(post, box_body("inside", {1.2, 1.2, 0.2}, {1.3, 1.3, 0.3})));
  EXPECT_FALSE(overlap(post, box_body("beside", {2, 1, 0}, {3, 2, 1})));
  const Body ring =
      prism_body("angle", {{0, 0}, {4, 0}, {4, 0.9}, {0.9, 0.9}, {0.9, 4}, {0, 4}}, 0, 1);
  EXPECT_FALSE(overlap(post, ring));  // its hull would
  const Body round = prism_body("round", regular_polygon({3, 1.5}, 0.98, 24), 0, 1);
  EXPECT_FALSE(overlap(post, round));
}

TEST(Overlap, OfSheetsIsCrossingOrLyingOnEachOther) {
  const Body a = sheet_body("a", {{0, 0, 0}, {2, 0, 0}, {2, 0, 2}, {0, 0, 2}});
  const Body crossing = sheet_body("crossing", {{1, -1, 0}, {1, 1, 0}, {1, 1, 2}, {1, -1, 2}});
  const Body meeting = sheet_body("meeting", {{1, 0, 0}, {1, 1, 0}, {1, 1, 2}, {1, 0, 2}});
  const Body on_it = sheet_body("on it", {{1, 0, 1}, {3, 0, 1}, {3, 0, 3}, {1, 0, 3}});
  const Body beside = sheet_body("beside", {{2, 0, 0}, {3, 0, 0}, {3, 0, 2}, {2, 0, 2}});
  EXPECT_TRUE(overlap(a, crossing));
  EXPECT_FALSE(overlap(a, meeting));
  EXPECT_TRUE(overlap(a, on_it));
  EXPECT_FALSE(overlap(a, beside));
  const Body post = box_body("post", {0.5, -0.5, 0}, {1, 0.5, 1});
  EXPECT_TRUE(overlap(a, post));
  EXPECT_FALSE(overlap(a, box_body("flush", {0.5, 0, 0}, {1, 0.5, 1})));
}

TEST(DistanceToABody, IsNegativeWithin) {
  const Body post = box_body("post", {1, 1, 0}, {2, 2, 1});
  EXPECT_DOUBLE_EQ(distance_m(post, {1.5, 1.5, 0.8}), -0.2);
  EXPECT_DOUBLE_EQ(distance_m(post, {3, 1.5, 0.5}), 1);
  const Body sheet = sheet_body("sheet", {{0, 0, 0}, {2, 0, 0}, {2, 0, 2}, {0, 0, 2}});
  EXPECT_DOUBLE_EQ(distance_m(sheet, {1, -0.3, 1}), 0.3);
  EXPECT_DOUBLE_EQ(distance_m(sheet, {3, 0, 1}), 1);
}

}  // namespace
}  // namespace scenes
