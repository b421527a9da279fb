#include "scenes/room.h"

#include <gmock/gmock.h>

#include "tests/scenes/test_rooms.h"

namespace scenes {
namespace {

TEST(FindSurface, FollowsTheOrderOfTheRoom) {
  const Room room =
      rectangular_room(5, 4, 2.7).opening(0, {1, 1}, {1, 1}).box({1, 1, 0}, {2, 2, 1}).room();
  EXPECT_EQ(find_surface(room, "floor"), 0);
  EXPECT_EQ(find_surface(room, "wall_4"), 5);
  EXPECT_EQ(find_surface(room, "box_1"), 7);
  EXPECT_EQ(find_surface(room, "sofa"), -1);
}

}  // namespace
}  // namespace scenes
