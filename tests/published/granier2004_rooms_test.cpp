// The rooms of [Granier2004] section 7.1, as far as the text describes them: a Cornell box under
// white and cyan light, and a lounge whose lamps face a blue ceiling.
#include <gtest/gtest.h>

#include "scenes/files/room_json.h"
#include "solver/rooms/room_colour.h"

namespace solver {
namespace {

using Eigen::Array3d;
using Eigen::Vector3d;

scenes::Room room_of(const std::string& name, double patch_m) {
  scenes::Room room =
      scenes::read_room(std::string(SOURCE_DIR) + "/scenes/rooms/colour/" + name + ".json");
  room.patch_m = patch_m;
  return room;
}

/// Of the three components together.
Array3d shares(const Vector3d& rgb) { return rgb.array() / rgb.sum(); }

/// The lamp's light after one reflection.
Vector3d direct_light(const scenes::Room& room, const ColourModel& model, const char* surface) {
  const auto at = static_cast<std::size_t>(scenes::find_surface(room, surface));
  const auto lamp = static_cast<std::size_t>(scenes::find_surface(room, "lamp"));
  return model.reflection(room.surfaces[at].reflectance) *
         spectra::rgb_of_light(model.space, room.surfaces[lamp].exitance);
}

TEST(Granier2004CornellBox, RedWallSurvivesCyanLightThatClassicalProductsExtinguish) {
  const scenes::Room room = room_of("cornell_cyan", 0.1);
  const Array3d classical = shares(direct_light(room, colour_model("rgb:iso"), "left"));
  const Array3d bilinear = shares(direct_light(room, colour_model("bilinear"), "left"));
  EXPECT_LT(classical[0], 0.001);
  EXPECT_GT(bilinear[0], 0.5);
}

TEST(Granier2004CornellBox, RedWallSurvivesCyanLightInTheSolvedBox) {
  const scenes::Room room = room_of("cornell_cyan", 0.1);
  const RoomTransport t = prepare_transport(room);
  const auto seen = [&](const char* name) {
    const ColourSolution solution = solve_room_colour(room, t, colour_model(name));
    const auto left = static_cast<std::size_t>(scenes::find_surface(room, "left"));
    return shares(solution.reflections[left] *
                  Vector3d(solution.light.receivers[0].irradiance.matrix()));
  };
  EXPECT_LT(seen("rgb:iso")[0], 0.001);
  EXPECT_GT(seen("bilinear")[0], 0.5);
}

// By coherence, which the printed matrices have to 2e-10.
TEST(Granier2004CornellBox, WhiteLightIsReflectedAsByClassicalProducts) {
  const scenes::Room room = room_of("cornell_white", 0.1);
  for (const char* surface : {"left", "right", "back"}) {
    const Vector3d classical = direct_light(room, colour_model("rgb:iso"), surface);
    const Vector3d printed = direct_light(room, colour_model("bilinear"), surface);
    const Vector3d derived = direct_light(room, colour_model("bilinear:iso"), surface);
    EXPECT_LT((printed - classical).norm(), 1e-9 * classical.norm());
    EXPECT_LT((derived - classical).norm(), 1e-12 * classical.norm());
  }
}

class Granier2004Lounge : public testing::Test {
 protected:
  /// Mean radiosity of a surface.
  Array3d seen(const char* model, const std::string& surface) const {
    const ColourSolution solution = solve_room_colour(room_, transport_, colour_model(model));
    EXPECT_TRUE(solution.light.radiosity.converged);
    Vector3d sum = Vector3d::Zero();
    for (int p = 0; p < transport_.mesh.size(); ++p) {
      const auto i = static_cast<std::size_t>(p);
      if (room_.surfaces[static_cast<std::size_t>(transport_.mesh.surface[i])].name != surface) {
        continue;
      }
      sum += transport_.mesh.area_m2[i] *
             Vector3d(solution.light.radiosity.radiosity.row(p).transpose().matrix());
    }
    return shares(sum);
  }

  scenes::Room room_ = room_of("lounge", 0.8);
  RoomTransport transport_ = prepare_transport(room_);
};

TEST_F(Granier2004Lounge, RednessOfWallsAndLeftPaintingIsBetterPreserved) {
  for (const char* surface : {"west", "south", "east", "left painting"}) {
    EXPECT_GT(seen("bilinear", surface)[0], 1.2 * seen("rgb:iso", surface)[0]) << surface;
  }
}

TEST_F(Granier2004Lounge, TransferToBlueTurnsItBlue) {
  for (const char* surface : {"west", "south", "east", "left painting"}) {
    EXPECT_GT(seen("bilinear:granier-iso:alpha=0,0,1", surface)[2],
              1.2 * seen("bilinear", surface)[2])
        << surface;
  }
}

}  // namespace
}  // namespace solver
