#include "solver/obstacles/patch_rays.h"

#include <gtest/gtest.h>

#include <random>

#include "scenes/shapes/room_builder.h"

namespace solver {
namespace {

using Eigen::Vector3d;

scenes::Room room_with_screen() {
  return scenes::RoomBuilder(scenes::rectangular_plan(4, 4), 3)
      .body(scenes::sheet_body("screen", {{2, 1, 0}, {2, 3, 0}, {2, 3, 2}, {2, 1, 2}}))
      .room();
}

// Front and back of a sheet lie in one place: rays meet the side that looks at them.
TEST(PatchRays, MeetTheSideOfASheetThatLooksAtThem) {
  const scenes::Room room = room_with_screen();
  const scenes::PatchMesh mesh = scenes::mesh_room(room, 0.5);
  const PatchRays rays(mesh);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int k = 0; k < 400; ++k) {
    const double side = k % 2 == 0 ? 1 : -1;
    const Vector3d from(2 - side * (0.1 + unit(random)), 1.2 + 1.6 * unit(random), 1);
    const Vector3d at(2, 1.05 + 1.9 * unit(random), 0.05 + 1.9 * unit(random));
    const RayHit hit = rays.first_hit(from, at - from);
    ASSERT_GE(hit.patch, 0);
    EXPECT_EQ(mesh.surface[static_cast<std::size_t>(hit.patch)], 6);
    EXPECT_EQ(mesh.normal[static_cast<std::size_t>(hit.patch)].x(), -side);
    std::array<Vector3d, kRayPacket> origins{};
    origins.fill(from);
    const ParallelHits hits = rays.first_hits(origins, kRayPacket, (at - from).normalized());
    for (const int patch : hits.patch) EXPECT_EQ(patch, hit.patch);
  }
}

}  // namespace
}  // namespace solver
