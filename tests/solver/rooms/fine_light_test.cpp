#include "solver/rooms/fine_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "appearance/spectra/display_colour.h"
#include "scenes/files/room_json.h"

namespace solver {
namespace {

using Eigen::ArrayXd;

scenes::Room sample_room(const std::string& name) {
  return scenes::read_room(std::string(SOURCE_DIR) + "/scenes/rooms/" + name + ".json");
}

/// As if `patch_m` gave too many patches, and those of `coarse_m` were solved in their place.
RoomTransport coarse_transport(const scenes::Room& room, double coarse_m, double patch_m) {
  RoomTransport t = prepare_transport(room, {.patch_m = coarse_m});
  t.plan.fine = {.patch_m = patch_m};
  return t;
}

FineLight fine_light_of(const scenes::Room& room, double coarse_m, double patch_m,
                        const FineOptions& options = {}) {
  const RoomTransport t = coarse_transport(room, coarse_m, patch_m);
  return fine_light(room, t, solve_room(room, t, {.relative_error = 1e-8}), options);
}

/// Of every patch, relative to its strongest band; 0 where there is no light.
ArrayXd deviations(const FineLight& fine, const Bands& h) {
  const ArrayXd deviation = (fine.irradiance - h).abs().rowwise().maxCoeff();
  const ArrayXd strongest = h.rowwise().maxCoeff();
  return (deviation > 0).select(deviation / strongest, 0.0);
}

ArrayXd deviations(const FineLight& fine, const RoomSolution& full) {
  return deviations(fine, full.radiosity.irradiance);
}

double rms(const ArrayXd& values) { return std::sqrt(values.square().mean()); }

// S = (1 - rho) c gives H = c. In an empty convex room nothing is left to chance.
TEST(FineLight, WhiteFurnaceInAnEmptyRoomIsExact) {
  scenes::Room room = sample_room("box");
  double rho = 0;
  for (scenes::Surface& s : room.surfaces) {
    s.reflectance.values.setConstant(rho += 0.12);
    s.exitance.values = 3 * (1 - s.reflectance.values);
  }
  const FineLight fine = fine_light_of(room, 1.0, 0.4, {.rays = 64});
  EXPECT_LT((fine.irradiance / 3 - 1).abs().maxCoeff(), 3e-6);  // float sums
  EXPECT_LT((fine.radiosity / 3 - 1).abs().maxCoeff(), 3e-6);
  EXPECT_LT(fine.energy.relative_defect, 3e-5);  // relative to (1 - rho) c
  EXPECT_EQ(fine.lost_rays, 0);
}

// With furniture, the visible shares of lamps and of reflecting faces come from different rays:
// equal up to the noise, and the noise is told.
TEST(FineLight, WhiteFurnaceInAFurnishedRoomStaysWithinTheNoise) {
  scenes::Room room = sample_room("office");
  for (scenes::Surface& s : room.surfaces) {
    s.reflectance.values.setConstant(0.5);
    s.exitance.values.setConstant(1.5);
  }
  const FineLight fine = fine_light_of(room, 1.0, 0.5, {.rays = 256, .lamp_rays = 64});
  const ArrayXd deviation = (fine.irradiance / 3 - 1).abs().rowwise().maxCoeff();
  EXPECT_LT(rms(deviation), fine.rms_standard_error);
  EXPECT_LT(deviation.maxCoeff(), 4 * fine.largest_standard_error);
  EXPECT_LT(fine.rms_standard_error, 0.02);
}

// Everything black but the lamps: what arrives is their direct light, for which the exchange areas
// of the fine mesh itself are the judge; nothing comes from rays.
TEST(FineLight, LampsInABlackRoomAgreeWithExchangeAreas) {
  scenes::Room room = sample_room("box");
  for (scenes::Surface& s : room.surfaces) s.reflectance.values.setZero();
  const FineLight fine = fine_light_of(room, 1.5, 0.5, {.rays = 8});
  const RoomSolution full =
      solve_room(room, prepare_transport(room, {.patch_m = 0.5, .light = Light::constant}));
  EXPECT_LT(deviations(fine, full).maxCoeff(), 1e-6);
  EXPECT_LT(fine.largest_standard_error, 1e-12);
}

struct Case {
  const char* name;
  double coarse_m, patch_m, target;  ///< RMS deviation
};

class AgainstTheFullSolve : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(Rooms, AgainstTheFullSolve,
                         testing::Values(Case{"box", 0.6, 0.3, 6e-3},
                                         Case{"office", 0.6, 0.35, 1.5e-2}),
                         [](const auto& c) { return std::string(c.param.name); });

TEST_P(AgainstTheFullSolve, EveryPatchAgreesWithinNoiseAndCoarseness) {
  const auto& [name, coarse_m, patch_m, target] = GetParam();
  scenes::Room room = sample_room(name);
  room.receivers.clear();
  const FineLight fine = fine_light_of(room, coarse_m, patch_m, {.rays = 512, .lamp_rays = 256});
  // The judge, constant light on the same patches, is 0.4 % off itself.
  const RoomSolution full =
      solve_room(room, prepare_transport(room, {.patch_m = patch_m, .light = Light::constant}),
                 {.relative_error = 1e-6});
  const ArrayXd deviation = deviations(fine, full);
  RecordProperty("rms_deviation", std::to_string(rms(deviation)));
  RecordProperty("max_deviation", std::to_string(deviation.maxCoeff()));
  RecordProperty("rms_standard_error", std::to_string(fine.rms_standard_error));
  EXPECT_LT(rms(deviation), target);
  EXPECT_LT(fine.rms_standard_error, target);
  EXPECT_LT(fine.energy.relative_defect, target);
}

// The error that is told covers the one that is made: against the same gather with 32 times the
// rays, so that the coarse mesh has no part in the difference.
TEST(FineLight, StandardErrorCoversTheNoise) {
  scenes::Room room = sample_room("office");
  room.receivers.clear();
  const RoomTransport t = coarse_transport(room, 0.8, 0.6);
  const RoomSolution solution = solve_room(room, t);
  const FineLight few = fine_light(room, t, solution, {.rays = 64, .lamp_rays = 64});
  const FineLight many = fine_light(room, t, solution, {.rays = 2048, .lamp_rays = 2048});
  const ArrayXd deviation = deviations(few, many.irradiance);
  EXPECT_LT(rms(deviation), few.rms_standard_error);
  EXPECT_GT(rms(deviation), few.rms_standard_error / 10);  // and does not cry wolf
  EXPECT_LT(many.rms_standard_error, few.rms_standard_error / 4);
}

TEST(FineLight, SameBitsForOneAndTwoThreads) {
  scenes::Room room = sample_room("office");
  const auto run = [&](int threads) {
    set_threads(threads);
    return fine_light_of(room, 1.2, 0.5, {.rays = 64, .lamp_rays = 64});
  };
  const FineLight one = run(1), two = run(2);
  EXPECT_TRUE((one.irradiance == two.irradiance).all());
  EXPECT_TRUE((one.standard_error == two.standard_error).all());
}

// Sun and point lights reach the fine patches themselves, not by way of coarse ones.
TEST(FineLight, FirstShotIsThatOfTheFinePatches) {
  scenes::Room room = sample_room("l_room");
  ASSERT_FALSE(room.suns.empty() && room.point_lights.empty());
  for (scenes::Surface& s : room.surfaces) {
    s.reflectance.values.setZero();
    s.exitance.values.setZero();
  }
  const FineLight fine = fine_light_of(room, 1.2, 0.5, {.rays = 8});
  const RoomSolution full =
      solve_room(room, prepare_transport(room, {.patch_m = 0.5, .light = Light::constant}));
  EXPECT_GT(full.radiosity.irradiance.maxCoeff(), 0);
  EXPECT_LT(deviations(fine, full).maxCoeff(), 1e-12);
}

TEST(FineLight, ThreeNumbersAgreeWithTheSpectralGather) {
  const scenes::Room room = sample_room("box");
  const ColourModel model = colour_model("rgb:srgb");
  scenes::Room grey = room;
  for (scenes::Surface& s : grey.surfaces) s.reflectance.values.setConstant(0.5);
  const RoomTransport t = coarse_transport(grey, 1.0, 0.6);
  const FineLight spectral = fine_light(grey, t, solve_room(grey, t), {.rays = 64});
  const FineLight colour =
      fine_light(grey, t, model, solve_room_colour(grey, t, model), {.rays = 64});
  const Bands projected =
      (spectral.irradiance.matrix() * spectra::rgb_matching(model.space, grey.grid).transpose())
          .array();
  EXPECT_LT((colour.irradiance / projected - 1).abs().maxCoeff(), 1e-4);
}

TEST(FineLight, RefusesWhatWasSolvedInFull) {
  const scenes::Room room = sample_room("box");
  const RoomTransport t = prepare_transport(room, {.patch_m = 1.5});
  EXPECT_THROW((void)fine_light(room, t, solve_room(room, t)), std::invalid_argument);
  EXPECT_THROW((void)fine_light_of(room, 1.5, 0.7, {.rays = 12}), std::invalid_argument);
}

TEST(MakePlan, ManyPatchesAreGatheredFromSomeThousand) {
  const scenes::Room room = sample_room("office");
  const Plan plan = make_plan(room, {.patch_m = 0.02});
  EXPECT_EQ(plan.fine.patch_m, 0.02);
  EXPECT_GT(plan.fine.patches, 100'000);
  EXPECT_GT(plan.patches, 1000);
  EXPECT_LT(plan.patches, 3000);
  EXPECT_GT(plan.patch_m, 0.1);
  const Plan whole = make_plan(room, {.patch_m = 0.25});
  EXPECT_EQ(whole.fine.patch_m, 0);
  EXPECT_EQ(whole.patch_m, 0.25);
}

// 20,000 unknowns want more than a gigabyte; where there is less, coarser ones are solved.
TEST(MakePlan, WhatDoesNotFitInMemoryIsSolvedCoarsely) {
  const scenes::Room room = sample_room("office");
  const Plan plan = make_plan(room, {.patch_m = 0.04, .memory_limit_bytes = 900'000'000});
  EXPECT_EQ(plan.fine.patch_m, 0.04);
  EXPECT_LE(plan.memory_bytes, 900'000'000);
  // and where not even their light fits, the patch size that would is named
  EXPECT_THROW((void)make_plan(room, {.patch_m = 0.005, .memory_limit_bytes = 900'000'000}),
               TooLarge);
}

}  // namespace
}  // namespace solver
