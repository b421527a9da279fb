#include "solver/rooms/mesh_study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "scenes/files/room_json.h"
#include "tests/solver/box_reference.h"

namespace solver {
namespace {

using Eigen::ArrayXd;

scenes::Room box() { return scenes::read_room(SOURCE_DIR "/scenes/rooms/box.json"); }

/// Of the strongest band, as bars are given.
double true_error(const ReceiverLight& light, const ArrayXd& exact) {
  return (light.irradiance - exact).abs().maxCoeff() / light.irradiance.maxCoeff();
}

struct Bar {
  double told, left, left_by_richardson;
};

/// Of each receiver of the box.
std::vector<Bar> bars(double patch_m, Light light) {
  const scenes::Room room = box();
  const auto exact = salmon_box(room);
  const RoomSolution solution =
      solve_room(room, prepare_transport(room, {.patch_m = patch_m, .light = light}));
  RoomSolution told = solution, moved = solution;
  EXPECT_TRUE(study_mesh(room, {.light = light}, {}, patch_m, false, told));
  EXPECT_TRUE(study_mesh(room, {.light = light}, {}, patch_m, true, moved));
  std::vector<Bar> all;
  for (std::size_t k = 0; k < room.receivers.size(); ++k) {
    const ArrayXd& e = exact.at(room.receivers[k].name);
    all.push_back({*told.receivers[k].mesh_error, true_error(told.receivers[k], e),
                   true_error(moved.receivers[k], e)});
  }
  return all;
}

double largest(const std::vector<Bar>& bars, double Bar::*member) {
  double worst = 0;
  for (const Bar& bar : bars) worst = std::max(worst, bar.*member);
  return worst;
}

// 5 cm from an edge too, once patches are not ten times as long. There the error falls faster with
// the patches than is counted on.
TEST(MeshStudy, BarsCoverWhatTheMeshLeaves) {
  for (const double patch_m : {0.5, 0.35, 0.25}) {
    const std::vector<Bar> all = bars(patch_m, Light::constant);
    for (const Bar& bar : all) EXPECT_GT(bar.told, bar.left) << patch_m;
    EXPECT_LT(largest(all, &Bar::told), 12 * largest(all, &Bar::left)) << patch_m;
  }
}

// The reference itself has a noise of 0.02 %.
TEST(MeshStudy, RichardsonTakesAThirdOfTheLargestError) {
  const std::vector<Bar> all = bars(0.25, Light::constant);
  EXPECT_LT(largest(all, &Bar::left_by_richardson), 2.0 / 3 * largest(all, &Bar::left));
}

TEST(MeshStudy, TellsNothingOfAMeshThatCannotBeCoarser) {
  const scenes::Room room = box();
  RoomSolution solution = solve_room(room, prepare_transport(room, {.patch_m = 20}));
  EXPECT_FALSE(study_mesh(room, {}, {}, 20, false, solution));
  EXPECT_FALSE(solution.receivers[0].mesh_error.has_value());
}

TEST(Tolerance, IsMetAndSaysHow) {
  const scenes::Room room = box();
  const auto exact = salmon_box(room);
  const ToleranceSolution chosen = solve_to_tolerance(room, 0.001, {}, {});
  EXPECT_TRUE(chosen.reached);
  EXPECT_GT(chosen.steps.size(), 1);
  EXPECT_LE(chosen.steps.back().error.sum(), 0.001);
  EXPECT_EQ(chosen.steps.back().patches, chosen.transport.mesh.size());
  for (std::size_t k = 0; k < room.receivers.size(); ++k) {
    EXPECT_LT(true_error(chosen.solution.receivers[k], exact.at(room.receivers[k].name)), 0.001);
  }
}

TEST(Tolerance, ThatDoesNotFitIsNotReached) {
  const ToleranceSolution chosen =
      solve_to_tolerance(box(), 1e-5, {.memory_limit_bytes = 30'000'000}, {});
  EXPECT_FALSE(chosen.reached);
  EXPECT_EQ(chosen.transport.mesh.size(), chosen.steps.back().patches);
  EXPECT_EQ(chosen.solution.radiosity.irradiance.rows(), chosen.transport.exchange.rows());
}

TEST(Tolerance, OutsideZeroToOneIsRefused) {
  const scenes::Room room = box();
  EXPECT_THROW((void)solve_to_tolerance(room, 0, {}, {}), std::invalid_argument);
  EXPECT_THROW((void)solve_to_tolerance(room, 1, {}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace solver
