// Leaving out what a scene does not need changes no result beyond rounding.
#include <gtest/gtest.h>

#include <string>

#include "scenes/files/room_json.h"
#include "solver/rooms/room_light.h"

namespace solver {
namespace {

using Eigen::ArrayXd;

scenes::Room sample_room(const std::string& name) {
  return scenes::read_room(SOURCE_DIR "/scenes/rooms/" + name + ".json");
}

scenes::Room grey(scenes::Room room) {
  for (scenes::Surface& s : room.surfaces) {
    s.reflectance.values.setConstant(s.reflectance.values.mean());
  }
  return room;
}

/// No light above 550 nm.
scenes::Room without_red(scenes::Room room) {
  for (scenes::Surface& s : room.surfaces) s.exitance.values.tail(15).setZero();
  for (scenes::PointLight& p : room.point_lights) p.spectral_flux.values.tail(15).setZero();
  for (scenes::Sun& s : room.suns) s.normal_irradiance.values.tail(15).setZero();
  return room;
}

struct Solved {
  Plan plan;
  RoomSolution solution;
};

Solved solved(const scenes::Room& room, bool skip) {
  const RoomTransport t = prepare_transport(room, {.patch_m = 0.5, .skip = skip});
  return {t.plan, solve_room(room, t, {.relative_error = 1e-13, .skip = skip})};
}

double difference(const ArrayXd& a, const ArrayXd& b) {
  return (a - b).abs().maxCoeff() / b.maxCoeff();
}

/// Over patches, receivers and the viewed point, of every band relative to its brightest patch.
double largest_difference(const RoomSolution& a, const RoomSolution& b) {
  double worst = 0;
  const Bands &h = a.radiosity.irradiance, &g = b.radiosity.irradiance;
  for (Eigen::Index k = 0; k < h.cols(); ++k) {
    if ((g.col(k) > 0).any()) worst = std::max(worst, difference(h.col(k), g.col(k)));
  }
  for (std::size_t r = 0; r < a.receivers.size(); ++r) {
    worst = std::max(worst, difference(a.receivers[r].irradiance, b.receivers[r].irradiance));
  }
  for (std::size_t v = 0; v < a.viewed.size(); ++v) {
    worst = std::max(worst, difference(a.viewed[v].irradiance, b.viewed[v].irradiance));
  }
  return worst;
}

constexpr double kRounding = 1e-12;

void expect_same(const scenes::Room& room, double tolerance) {
  const Solved short_cut = solved(room, true), everything = solved(room, false);
  EXPECT_TRUE(everything.plan.left_out.empty());
  EXPECT_FALSE(short_cut.plan.left_out.empty());
  EXPECT_LT(largest_difference(short_cut.solution, everything.solution), tolerance) << room.name;
}

TEST(Skipping, ChangesNothingInTheBox) { expect_same(sample_room("box"), kRounding); }

TEST(Skipping, ChangesNothingAmongFurniture) { expect_same(sample_room("office"), kRounding); }

TEST(Skipping, ChangesNothingBehindADoor) { expect_same(sample_room("two_rooms"), kRounding); }

TEST(Skipping, ChangesNothingWhereBandsAreDark) {
  const scenes::Room room = without_red(sample_room("box"));
  expect_same(room, kRounding);
  const Plan plan = solved(room, true).plan;
  EXPECT_EQ(plan.bands, 16);
  EXPECT_GT(plan.left_out.back().saved_seconds, 0);
}

TEST(Skipping, SolvesGreySurfacesUnderOneLampOnce) {
  const scenes::Room room = grey(sample_room("box"));
  expect_same(room, kRounding);
  EXPECT_EQ(solved(room, true).plan.solved_bands, 1);
}

TEST(Skipping, BoundsOfARepeatedBandGrowWithItsLight) {
  const Solved one = solved(grey(sample_room("box")), true);
  const auto& bands = one.solution.radiosity.bands;
  const Bands& h = one.solution.radiosity.irradiance;
  EXPECT_NEAR(bands[30].rms_error_bound / bands[0].rms_error_bound, h(0, 30) / h(0, 0), 1e-9);
  EXPECT_GT(bands[30].iterations, 0);
}

TEST(Skipping, IsCountedByBandsThatAreSolved) {
  EXPECT_EQ(solved(sample_room("office"), true).plan.solved_bands, 31);
  EXPECT_EQ(solved(grey(sample_room("office")), false).plan.solved_bands, 31);
}

}  // namespace
}  // namespace solver
