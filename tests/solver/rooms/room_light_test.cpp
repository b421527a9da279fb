#include "solver/rooms/room_light.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "appearance/spectra/photometry.h"
#include "scenes/files/room_json.h"
#include "scenes/shapes/bodies.h"
#include "solver/exchange/exchange.h"
#include "solver/sources/direct_light.h"
#include "tests/solver/box_reference.h"

namespace solver {
namespace {

using Eigen::ArrayXd;

scenes::Room sample_room(const std::string& name) {
  return scenes::read_room(std::string(SOURCE_DIR) + "/scenes/rooms/" + name + ".json");
}

/// Everything reflects rho, lamps too.
scenes::Room uniform(scenes::Room room, double rho) {
  for (scenes::Surface& s : room.surfaces) s.reflectance.values.setConstant(rho);
  return room;
}

double largest_error(const scenes::Room& room, const RoomSolution& solution,
                     const std::map<std::string, ArrayXd>& exact) {
  double worst = 0;
  for (std::size_t k = 0; k < room.receivers.size(); ++k) {
    const ArrayXd& e = exact.at(room.receivers[k].name);
    const double error = (solution.receivers[k].irradiance / e - 1).abs().maxCoeff();
    worst = std::max(worst, error);
    testing::Test::RecordProperty(room.receivers[k].name, std::to_string(error));
  }
  return worst;
}

// Every band of every receiver, 5 cm from an edge included; the reference's own noise is below 0.02
// %.
TEST(BoxAgainstPathTracing, SalmonWallsWithinOnePerMille) {
  const scenes::Room room = sample_room("box");
  EXPECT_LT(largest_error(room, solve_room(room, prepare_transport(room)), salmon_box(room)), 7e-4);
}

class UniformBox : public testing::TestWithParam<std::pair<double, double>> {};

INSTANTIATE_TEST_SUITE_P(Reflectances, UniformBox,
                         testing::Values(std::pair{0.95, 5e-4}, std::pair{0.999, 2e-5}),
                         [](const auto& p) {
                           return "rho_" + std::to_string(static_cast<int>(1000 * p.param.first));
                         });

// Past the last bounce of the series the light is even: its coefficients have reached lamp area /
// room area.
TEST_P(UniformBox, ReceiversWithinTheirTarget) {
  const auto [rho, target] = GetParam();
  const scenes::Room room = uniform(sample_room("box"), rho);
  const double even = 1.2 * 1.2 / (2 * (5 * 4 + 5 * 2.7 + 4 * 2.7));
  std::map<std::string, ArrayXd> exact;
  for (const auto& [receiver, c] : box_reference("uniform")) {
    constexpr std::size_t kEven =
        25;  // by then bounces differ from even light by less than the noise
    double sum = 0;
    for (std::size_t m = 0; m < kEven; ++m) sum += c[m] * std::pow(rho, m);
    sum += even * std::pow(rho, kEven) / (1 - rho);
    exact[receiver] = room.surfaces.back().exitance.values * sum;
  }
  EXPECT_LT(largest_error(room, solve_room(room, prepare_transport(room), {.relative_error = 1e-7}),
                          exact),
            target);
}

class EverySampleRoom : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Rooms, EverySampleRoom,
                         testing::Values("box", "office", "l_room", "two_rooms", "daylight",
                                         "tungsten"),
                         [](const auto& name) { return std::string(name.param); });

// Identities that hold whatever the mesh and however visibility was sampled.
TEST_P(EverySampleRoom, ClosesAndKeepsItsEnergy) {
  scenes::Room room = sample_room(GetParam());
  room.patch_m = 0.5;
  const RoomTransport t = prepare_transport(room);
  EXPECT_LT(t.closure_defect, 1e-12);
  EXPECT_LT(t.reciprocity_defect, 1e-12);
  EXPECT_TRUE(t.exchange.isolated.empty());
  const RoomSolution solution = solve_room(room, t, {.relative_error = 1e-9});
  ASSERT_TRUE(solution.radiosity.converged);
  EXPECT_LT(solution.energy.relative_defect, 1e-8);
}

// S = (1 - rho) c must give B = c at every patch and receiver, to 1e-6 from float storage.
TEST_P(EverySampleRoom, WhiteFurnaceWithRandomReflectances) {
  scenes::Room room = sample_room(GetParam());
  room.patch_m = 0.5;
  room.point_lights.clear();
  room.suns.clear();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform_rho(0, 0.9999);
  for (scenes::Surface& s : room.surfaces) {
    s.reflectance.values =
        ArrayXd::NullaryExpr(room.grid.count, [&] { return uniform_rho(random); });
    s.exitance.values = 3 * (1 - s.reflectance.values);
  }
  room.surfaces[0].reflectance.values.setConstant(0.9999);
  room.surfaces[0].exitance.values.setConstant(3 * 0.0001);
  const RoomTransport t = prepare_transport(room);
  const RoomSolution solution = solve_room(room, t, {.relative_error = 1e-8});
  const Bands& radiosity = solution.radiosity.radiosity;  // means, then slopes
  EXPECT_LT((radiosity.topRows(t.mesh.size()) / 3 - 1).abs().maxCoeff(), 1e-6);
  EXPECT_LT((radiosity.bottomRows(t.exchange.rows() - t.mesh.size()) / 3).abs().maxCoeff(), 1e-6);
  for (const ReceiverLight& r : solution.receivers) {
    EXPECT_LT((r.irradiance / 3 - 1).abs().maxCoeff(), 1e-6);
  }
}

TEST_P(EverySampleRoom, SameBitsForOneAndTwoThreads) {
  scenes::Room room = sample_room(GetParam());
  room.patch_m = 0.6;
  const auto run = [&](int threads) {
    set_threads(threads);
    return solve_room(room, prepare_transport(room));
  };
  const RoomSolution one = run(1), two = run(2);
  EXPECT_TRUE((one.radiosity.radiosity == two.radiosity.radiosity).all());
  for (std::size_t k = 0; k < one.receivers.size(); ++k) {
    EXPECT_TRUE((one.receivers[k].irradiance == two.receivers[k].irradiance).all());
  }
}

// Area-mean irradiance of a uniform room is flux / (A (1 - rho)) whatever the lamps and furniture.
TEST_P(EverySampleRoom, UniformReflectanceFixesTheMeanIrradiance) {
  scenes::Room room = uniform(sample_room(GetParam()), 0.8);
  room.patch_m = 0.5;
  const RoomTransport t = prepare_transport(room);
  const RoomSolution solution = solve_room(room, t, {.relative_error = 1e-9});
  const ArrayXd area = t.exchange.area_m2.head(t.mesh.size());
  const Bands irradiance = solution.radiosity.irradiance.topRows(t.mesh.size());
  const ArrayXd mean =
      (area.matrix().transpose() * irradiance.matrix()).transpose().array() / area.sum();
  const ArrayXd expected = solution.energy.emitted / (area.sum() * (1 - 0.8));
  EXPECT_LT((mean / expected - 1).abs().maxCoeff(), 1e-8);
}

TEST(RoomTransport, EmptyConvexRoomTestsNoVisibility) {
  const RoomTransport t = prepare_transport(sample_room("box"));
  EXPECT_EQ(t.plan.occludable_pairs, 0);
  EXPECT_EQ(t.exchange.tested_pairs, 0);
}

TEST(RoomTransport, FluxOfLampsIsMetInTheBandSum) {
  const scenes::Room room = sample_room("box");
  const RoomTransport t = prepare_transport(room);
  const RoomSolution solution = solve_room(room, t);
  EXPECT_NEAR(spectra::luminous({room.grid, solution.energy.emitted}), 4000, 4000 * 1e-12);
}

TEST(RoomTransport, WhatDoesNotFitIsRefusedWithThePatchSizeThatWould) {
  const scenes::Room room = sample_room("office");
  try {
    (void)prepare_transport(room, {.memory_limit_bytes = 1'000'000});
    FAIL() << "a megabyte was enough";
  } catch (const TooLarge& error) {
    EXPECT_NE(std::string(error.what()).find("patch_m"), std::string::npos);
  }
  // A patch size that would take years to mesh is refused at once.
  EXPECT_THROW((void)prepare_transport(room, {.patch_m = 1e-6}), TooLarge);
}

TEST(DirectLight, SolidAnglesOfARoomSumToFourPi) {
  const scenes::Room room = sample_room("box");
  const scenes::PatchMesh mesh = scenes::mesh_room(room, 0.7);
  double sum = 0;
  for (const auto& polygon : mesh.polygon) sum += solid_angle({0.3, 3.1, 1.9}, polygon);
  EXPECT_NEAR(sum, 4 * M_PI, 1e-12);
}

TEST(DirectLight, SunComesFromItsAzimuthAndAltitude) {
  const Eigen::Vector3d east = towards_sun({.azimuth_deg = 90, .altitude_deg = 30});
  EXPECT_NEAR((east - Eigen::Vector3d(std::sqrt(0.75), 0, 0.5)).norm(), 0, 1e-15);
  const Eigen::Vector3d north = towards_sun({.azimuth_deg = 0, .altitude_deg = 0});
  EXPECT_NEAR((north - Eigen::Vector3d::UnitY()).norm(), 0, 1e-15);
}

// A square box between a floor point and a lamp that covers, seen from the point, exactly its left
// half.
TEST(Visibility, HalfHiddenLampIsHalfSeen) {
  scenes::Room room = sample_room("box");
  room.furniture.push_back(scenes::box_body("screen", {2.5, 0.5, 1.0}, {4.9, 3.5, 1.2}));
  scenes::Surface black = room.surfaces[0];
  black.name = "screen";
  black.kind = scenes::SurfaceKind::furniture;
  black.index = 0;
  black.exitance.values.setZero();
  room.surfaces.push_back(black);
  room.receivers = {{.name = "below the edge", .at_m = {2.5, 2, 0}, .normal = {0, 0, 1}}};
  const RoomTransport t = prepare_transport(room);
  double seen = 0, whole = 0;
  const scenes::Room empty = sample_room("box");
  const scenes::PatchMesh empty_mesh = scenes::mesh_room(empty, room.patch_m);
  const Visibility clear(empty, empty_mesh);
  const std::vector<Facet> empty_facets = facets_of(empty_mesh);
  const GatherRow open = PointGather(empty_mesh, empty_facets, clear).row({2.5, 2, 0}, {0, 0, 1});
  const auto on_panel = [](const scenes::Room& r, int surface) {
    return r.surfaces[static_cast<std::size_t>(surface)].kind == scenes::SurfaceKind::panel;
  };
  for (int p = 0; p < t.mesh.size(); ++p) {
    if (on_panel(room, t.mesh.surface[static_cast<std::size_t>(p)]))
      seen += t.receivers[0].gather.weights[p];
  }
  for (int p = 0; p < empty_mesh.size(); ++p) {
    if (on_panel(empty, empty_mesh.surface[static_cast<std::size_t>(p)])) whole += open.weights[p];
  }
  EXPECT_NEAR(seen / whole, 0.5, 1e-3);
}

}  // namespace
}  // namespace solver
