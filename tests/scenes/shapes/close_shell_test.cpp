#include "scenes/shapes/close_shell.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "scenes/shapes/room_builder.h"
#include "scenes/shapes/shell.h"
#include "tests/scenes/shapes/volumes.h"

namespace scenes {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

std::vector<ShellFace> l_shape() {
  return prism_shell({{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 5}, {0, 5}}, 2.5);
}

// However the faces are turned, and with corners off by half a micrometre.
TEST(CloseShell, TurnsAndWeldsAnyFaces) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> off(-2e-7, 2e-7);
  for (int k = 0; k < 20; ++k) {
    std::vector<ShellFace> faces = l_shape();
    for (ShellFace& face : faces) {
      if (random() % 2 == 0) std::ranges::reverse(face.outline);
      for (Vector3d& p : face.outline) p += Vector3d(off(random), off(random), off(random));
    }
    EXPECT_TRUE(close_shell(faces).empty());
    EXPECT_LT(gap_m2(faces).norm(), 1e-9);
    EXPECT_NEAR(volume_within(faces), 14 * 2.5, 1e-4);
  }
}

TEST(CloseShell, NamesEveryOpenEdge) {
  std::vector<ShellFace> faces = l_shape();
  faces.erase(faces.begin() + 4);  // the wall from (4, 2) to (2, 2)
  const std::vector<ShellFault> faults = close_shell(faces);
  ASSERT_EQ(faults.size(), 4U);
  EXPECT_TRUE(std::ranges::any_of(faults, [](const ShellFault& f) {
    return f.problem.find("[4, 2, 0]") != f.problem.npos &&
           f.problem.find("[2, 2, 0]") != f.problem.npos;
  }));
}

TEST(CloseShell, RefusesFacesThatCross) {
  std::vector<ShellFace> faces = l_shape();
  // A wall across the room, closed by nothing; and one through the floor.
  faces.push_back({.surface = 0, .outline = {{1, 1, -1}, {1.5, 1, -1}, {1.5, 1, 1}, {1, 1, 1}}});
  const std::vector<ShellFault> faults = close_shell(faces);
  EXPECT_TRUE(std::ranges::any_of(faults, [](const ShellFault& f) {
    return f.problem.find("crosses face 1") != f.problem.npos;
  }));
}

TEST(CloseShell, RefusesTwoShells) {
  std::vector<ShellFace> faces = l_shape();
  for (ShellFace& face : prism_shell(rectangular_plan(1, 1), 1)) {
    for (Vector3d& p : face.outline) p += Vector3d(0.5, 0.5, 0.5);
    faces.push_back(face);
  }
  const std::vector<ShellFault> faults = close_shell(faces);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_THAT(faults[0].problem, HasSubstr("2 shells"));
}

}  // namespace
}  // namespace scenes
