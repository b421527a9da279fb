#include "solver/rooms/ambient_term.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scenes/files/room_json.h"
#include "solver/rooms/room_light.h"
#include "tests/scenes/test_rooms.h"

namespace solver {
namespace {

using Eigen::ArrayXd;

scenes::Room sample_room(const std::string& name) {
  return scenes::read_room(std::string(SOURCE_DIR) + "/scenes/rooms/" + name + ".json");
}

ArrayXd area_of(const scenes::PatchMesh& mesh) {
  return Eigen::Map<const ArrayXd>(mesh.area_m2.data(), mesh.size());
}

/// W nm^-1 of all sources, from a solve that keeps its energy.
ArrayXd emitted(const scenes::Room& room) {
  return solve_room(room, prepare_transport(room, {.patch_m = 1})).energy.emitted;
}

class AmbientTermOf : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Rooms, AmbientTermOf,
                         testing::Values("box", "office", "l_room", "two_rooms", "daylight",
                                         "tungsten", "corridor"),
                         [](const auto& name) { return std::string(name.param); });

// Whatever stands in the room: area-mean irradiance = flux / (A (1 - rho)).
TEST_P(AmbientTermOf, UniformReflectanceFixesTheMeanIrradiance) {
  scenes::Room room = sample_room(GetParam());
  for (scenes::Surface& s : room.surfaces) s.reflectance.values.setConstant(0.8);
  const AmbientTerm term = solve_ambient_term(room);
  const ArrayXd area = area_of(term.faces);
  const ArrayXd mean =
      (area.matrix().transpose() * term.irradiance().matrix()).transpose().array() / area.sum();
  EXPECT_LT((mean / (emitted(room) / (area.sum() * 0.2)) - 1).abs().maxCoeff(), 1e-6);
}

TEST_P(AmbientTermOf, EnergyIsConserved) {
  const scenes::Room room = sample_room(GetParam());
  const AmbientTerm term = solve_ambient_term(room);
  Bands absorbed = term.irradiance();
  for (Eigen::Index f = 0; f < absorbed.rows(); ++f) {
    const auto surface = static_cast<std::size_t>(term.faces.surface[static_cast<std::size_t>(f)]);
    absorbed.row(f) *= (1 - room.surfaces[surface].reflectance.values).transpose();
  }
  const ArrayXd flux =
      (area_of(term.faces).matrix().transpose() * absorbed.matrix()).transpose().array();
  EXPECT_LT((flux - emitted(room)).abs().sum() / flux.sum(), 1e-6);
}

// A cube whose sides shine and reflect is its own box: the closed six-sided exchange is the truth.
// A point's direct light is that of the point, so the middle of a side is compared by a lamp that
// is the same all over.
TEST(AmbientTerm, UniformlyShiningBoxIsExact) {
  scenes::Room room = sample_room("box");
  room.point_lights.clear();
  for (scenes::Surface& s : room.surfaces) {
    s.reflectance.values.setConstant(0.6);
    s.exitance.values.setConstant(2);
  }
  const Bands h = extended_ambient_term(room, room.receivers);
  EXPECT_LT((h / (2 / (1 - 0.6)) - 1).abs().maxCoeff(), 1e-9);
}

// A black room with a shelf behind one of two windows: what the sun brings through the other falls
// on one face only, so it needs no quasi-shadow and is exact.
TEST(AmbientTerm, EachBeamOfASunIsScaledByItself) {
  scenes::RoomBuilder builder = scenes::rectangular_room(6, 6, 3);
  builder.opening(0, {0.5, 1}, {1, 1}).opening(0, {4.5, 1}, {1, 1});
  builder.box({4.4, 0.5, 0.3}, {5.6, 5.5, 0.5});
  scenes::Room room = builder.room();
  for (scenes::Surface& s : room.surfaces) s.reflectance.values.setZero();
  room.suns.push_back({.name = "sun",
                       .azimuth_deg = 180,
                       .altitude_deg = 30,
                       .normal_irradiance = spectra::constant(room.grid, 1)});
  const Bands h = extended_ambient_term(
      room, {{"lit", {1, 2.6, 0}, {0, 0, 1}}, {"shadowed", {5, 3, 0}, {0, 0, 1}}});
  EXPECT_NEAR(h(0, 0), std::sin(std::numbers::pi / 6), 1e-9);
  EXPECT_LT(h(1, 0), 0.9 * h(0, 0));
}

// The cheap answer in rooms with furniture: tens of percent at worst, and nothing like the truth
// without interreflection.
TEST(AmbientTerm, OfficeReceiversWithinAThird) {
  const scenes::Room room = sample_room("office");
  const RoomSolution full = solve_room(room, prepare_transport(room, {.patch_m = 0.5}));
  const Bands cheap = extended_ambient_term(room, room.receivers);
  for (std::size_t k = 0; k < room.receivers.size(); ++k) {
    const ArrayXd& h = full.receivers[k].irradiance;
    const ArrayXd error = (cheap.row(static_cast<Eigen::Index>(k)).transpose() - h).abs();
    EXPECT_LT(error.maxCoeff() / h.maxCoeff(), 1.0 / 3) << room.receivers[k].name;
  }
}

}  // namespace
}  // namespace solver
