// The room response against full solves: what it says of a paint is what solving the room with that
// paint says.
#include "solver/response/room_response.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "scenes/files/room_json.h"
#include "solver/rooms/room_light.h"

namespace solver {
namespace {

using spectra::Spectrum;

scenes::Room sample_room(const std::string& name, double patch_m = 0.6) {
  scenes::Room room =
      scenes::read_room(std::string(SOURCE_DIR) + "/scenes/rooms/" + name + ".json");
  room.patch_m = patch_m;
  return room;
}

/// Reflectances from 0 to `highest` in every band, many of them near both ends.
Spectrum random_paint(std::mt19937& random, double highest = 0.999) {
  std::uniform_real_distribution<double> unit(0, 1);
  Spectrum paint = spectra::constant(spectra::kTransportGrid, 0);
  for (double& rho : paint.values) {
    rho = unit(random) < 0.5 ? highest * unit(random) : 1 - std::pow(1 - highest, unit(random));
  }
  return paint;
}

double relative_difference(const Spectrum& found, const Spectrum& expected) {
  double worst = 0;
  for (int k = 0; k < expected.grid.count; ++k) {
    if (expected.values[k] > 0)
      worst = std::max(worst, std::abs(found.values[k] / expected.values[k] - 1));
  }
  return worst;
}

double relative_difference(const spectra::ViewedLight& found,
                           const spectra::ViewedLight& expected) {
  return std::max({relative_difference(found.sample, expected.sample),
                   relative_difference(found.background, expected.background),
                   relative_difference(found.field, expected.field),
                   relative_difference(found.white, expected.white)});
}

/// Worst over random paints of every group, every viewed point and every lighting.
double worst_difference(const scenes::Room& room, const RoomTransport& transport,
                        const ReducedViews& views) {
  std::mt19937 random(7);
  double worst = 0;
  const std::size_t first = room.scenarios.empty() ? 0 : 1;
  for (int trial = 0; trial < 3; ++trial) {
    std::vector<Spectrum> paints;
    for (std::size_t g = 0; g < room.paint.size(); ++g) paints.push_back(random_paint(random));
    if (trial == 1) paints[0].values.setConstant(0.999);
    if (trial == 2) paints[0].values.setZero();
    for (std::size_t l = first; l < transport.lightings.size(); ++l) {
      const RoomSolution solution =
          solve_room(room, transport, {.relative_error = 1e-10}, {.lighting = l, .paints = paints});
      for (int viewed = 0; viewed < views.viewed; ++viewed) {
        const spectra::ViewedLight solved =
            viewed_light(room, transport, solution, static_cast<std::size_t>(viewed));
        for (int varying = 0; varying < views.room.groups; ++varying) {
          const RoomResponse response(views, varying, viewed, paints);
          worst = std::max(
              worst,
              relative_difference(
                  response.light(paints[static_cast<std::size_t>(varying)], l - first), solved));
        }
      }
    }
  }
  return worst;
}

class ResponseOf : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Rooms, ResponseOf,
                         testing::Values("box", "office", "l_room", "two_rooms", "daylight",
                                         "corridor", "living_room"),
                         [](const auto& name) { return std::string(name.param); });

TEST_P(ResponseOf, AgreesWithFullSolvesToAMillionth) {
  const scenes::Room room = sample_room(GetParam());
  const RoomTransport transport = prepare_transport(room);
  const ReducedViews views = reduce_views(room, transport);
  EXPECT_TRUE(views.room.converged);
  EXPECT_LE(views.room.largest_error, 1e-6);
  EXPECT_LE(views.room.solves, 35 * views.room.groups);
  EXPECT_LT(worst_difference(room, transport, views), 1e-6);
  RecordProperty("solves", std::to_string(views.room.solves));
}

// Walls, floor and ceiling painted alike: the stiffest room there is.
TEST_P(ResponseOf, HoldsWhereEverythingIsPainted) {
  scenes::Room room = sample_room(GetParam());
  const scenes::View view{.eye_m = viewed_point(room).eye_m,
                          .look_at_m = viewed_point(room).point_m};
  room.paint = {{.view = view}};
  for (int s = 0; s < static_cast<int>(room.surfaces.size()); ++s) {
    const scenes::SurfaceKind kind = room.surfaces[static_cast<std::size_t>(s)].kind;
    if (kind != scenes::SurfaceKind::opening && kind != scenes::SurfaceKind::panel)
      room.paint[0].surfaces.push_back(s);
  }
  const RoomTransport transport = prepare_transport(room);
  const ReducedViews views = reduce_views(room, transport);
  EXPECT_TRUE(views.room.converged);
  EXPECT_LE(views.room.solves, 30);
  EXPECT_LT(worst_difference(room, transport, views), 1e-6);
}

TEST(RoomResponse, ThreeGroupsAreAnsweredFromOneReduction) {
  scenes::Room room = sample_room("box", 0.5);
  room.paint = {{.surfaces = {2, 3, 4}}, {.surfaces = {5}}, {.surfaces = {0}, .view = room.view}};
  room.paint[2].view = scenes::View{.eye_m = {2.5, 2, 1.5}, .look_at_m = {2, 1, 0}};
  const RoomTransport transport = prepare_transport(room);
  const ReducedViews views = reduce_views(room, transport);
  EXPECT_TRUE(views.room.converged);
  EXPECT_LT(worst_difference(room, transport, views), 1e-6);
}

TEST(RoomResponse, WhiteOfSurfacesCountsNearWhitePaint) {
  scenes::Room room = sample_room("box", 1);
  room.viewing.white = spectra::ReferenceWhite::surfaces;
  const RoomTransport transport = prepare_transport(room);
  const ReducedViews views = reduce_views(room, transport);
  const RoomResponse response(views, 0, 0, {});
  for (const double rho : {0.3, 0.8}) {
    const Spectrum paint = spectra::constant(room.grid, rho);
    const spectra::ViewedLight solved =
        viewed_light(room, transport,
                     solve_room(room, transport, {.relative_error = 1e-10}, {.paints = {paint}}));
    EXPECT_LT(relative_difference(response.light(paint), solved), 1e-6) << rho;
  }
}

TEST(RoomResponse, SlopeAgreesWithDifferences) {
  const scenes::Room room = sample_room("office", 1);
  const ReducedViews views = reduce_views(room, prepare_transport(room));
  const RoomResponse response(views, 0, 0, {});
  std::mt19937 random(3);
  const Spectrum paint = random_paint(random, 0.9);
  const spectra::ViewedLightSlope slope = response.slope(paint);
  constexpr double kStep = 1e-6;
  Spectrum more = paint, less = paint;
  more.values += kStep;
  less.values = (less.values - kStep).max(0);
  const spectra::ViewedLight high = response.light(more), low = response.light(less);
  const Eigen::ArrayXd width = more.values - less.values;
  const auto difference = [&](const Spectrum& h, const Spectrum& l) {
    return Spectrum{room.grid, (h.values - l.values) / width};
  };
  EXPECT_LT(relative_difference(slope.by_reflectance.sample, difference(high.sample, low.sample)),
            1e-4);
  EXPECT_LT(relative_difference(slope.by_reflectance.field, difference(high.field, low.field)),
            1e-4);
  EXPECT_EQ((slope.light.white.values - response.light(paint).white.values).abs().maxCoeff(), 0);
}

// Cost: bands whose other surfaces are grey share their solves, whatever the lamps' spectra are.
TEST(RoomResponse, BandsThatDifferInLightAloneShareTheirSolves) {
  const scenes::Room box = sample_room("box", 1);
  EXPECT_LT(reduce_views(box, prepare_transport(box)).room.solves, 1);
}

TEST(RoomResponse, RoomWithoutLightIsDarkAndNeedsNoSolve) {
  const scenes::Room room = sample_room("box", 1);
  RoomTransport transport = prepare_transport(room);
  transport.lightings[0].emission.setZero();
  const ReducedViews views = reduce_views(room, transport);
  EXPECT_TRUE(views.room.converged);
  EXPECT_EQ(views.room.solves, 0);
  const spectra::ViewedLight dark =
      RoomResponse(views, 0, 0, {}).light(spectra::constant(room.grid, 0.5));
  EXPECT_EQ(dark.sample.values.maxCoeff(), 0);
  EXPECT_EQ(dark.field.values.maxCoeff(), 0);
}

// Only some bands carry light, as under a laser; the others stay dark.
TEST(RoomResponse, BandsWithoutLightStayDark) {
  const scenes::Room room = sample_room("box", 1);
  RoomTransport transport = prepare_transport(room);
  transport.lightings[0].emission.leftCols(20).setZero();
  const ReducedViews views = reduce_views(room, transport);
  EXPECT_LT(worst_difference(room, transport, views), 1e-6);
  const spectra::ViewedLight light =
      RoomResponse(views, 0, 0, {}).light(spectra::constant(room.grid, 0.5));
  EXPECT_EQ(light.sample.values.head(20).maxCoeff(), 0);
  EXPECT_GT(light.sample.values.tail(11).minCoeff(), 0);
}

TEST(RoomResponse, RefusesWhatIsNoPaint) {
  const scenes::Room room = sample_room("box", 1);
  const ReducedViews views = reduce_views(room, prepare_transport(room));
  const RoomResponse response(views, 0, 0, {});
  Spectrum paint = spectra::constant(room.grid, 0.5);
  for (const double bad : {-0.1, 0.9995, 1.0, std::nan("")}) {
    paint.values[3] = bad;
    EXPECT_THROW((void)response.light(paint), std::invalid_argument) << bad;
  }
  EXPECT_THROW((void)response.light(spectra::constant(spectra::kClosedFormGrid, 0.5)),
               std::invalid_argument);
  EXPECT_THROW((void)RoomResponse(views, 1, 0, {}), std::invalid_argument);
  scenes::Room unpainted = room;
  unpainted.paint.clear();
  EXPECT_THROW((void)reduce_views(unpainted, prepare_transport(unpainted)), std::invalid_argument);
}

TEST(RoomResponse, SameBitsForOneAndTwoThreads) {
  const scenes::Room room = sample_room("office", 1);
  const Spectrum paint = spectra::constant(room.grid, 0.5);
  const auto run = [&](int threads) {
    set_threads(threads);
    return RoomResponse(reduce_views(room, prepare_transport(room)), 0, 0, {}).light(paint);
  };
  EXPECT_TRUE((run(1).sample.values == run(2).sample.values).all());
}

}  // namespace
}  // namespace solver
