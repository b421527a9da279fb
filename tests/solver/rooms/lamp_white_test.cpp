// The light of lamps that no surface has reflected, and how much of the view the paint takes.
#include "solver/rooms/lamp_white.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scenes/files/room_json.h"
#include "scenes/shapes/room_builder.h"
#include "scenes/shapes/shell.h"
#include "solver/response/room_response.h"
#include "solver/rooms/room_light.h"

namespace solver {
namespace {

scenes::Room office() {
  scenes::Room room = scenes::read_room(SOURCE_DIR "/scenes/rooms/office.json");
  room.patch_m = 0.6;
  return room;
}

void paint_all(scenes::Room& room, double reflectance) {
  for (scenes::Surface& s : room.surfaces) {
    s.reflectance = spectra::constant(room.grid, reflectance);
  }
}

double relative_difference(const Eigen::ArrayXd& p, const Eigen::ArrayXd& q) {
  return (p - q).abs().maxCoeff() / q.maxCoeff();
}

TEST(LampWhite, OfABlackRoomIsAllItsLight) {
  scenes::Room room = office();
  paint_all(room, 0);
  const RoomTransport transport = prepare_transport(room);
  const spectra::ViewedLight light = viewed_light(room, transport, solve_room(room, transport));
  EXPECT_LT(relative_difference(light.lamps.values, light.white.values), 1e-12);
  EXPECT_FALSE(light.lamps_by_flux);
}

TEST(LampWhite, DoesNotDependOnPaint) {
  scenes::Room room = office();
  const RoomTransport transport = prepare_transport(room);
  const LampLight before = lamp_light(room, transport, 0, 0);
  paint_all(room, 0.9);
  const LampLight after = lamp_light(room, transport, 0, 0);
  EXPECT_TRUE((before.light.values == after.light.values).all());
}

TEST(LampWhite, OfAWallThatNoLampSeesIsTheFluxIntoTheRoom) {
  scenes::Room room = office();
  for (scenes::Surface& s : room.surfaces) {
    if (s.kind == scenes::SurfaceKind::opening) s.exitance = spectra::constant(room.grid, 0);
  }
  room.point_lights.clear();
  room.suns.clear();
  const scenes::Surface* panel = nullptr;
  for (const scenes::Surface& s : room.surfaces) {
    if (s.kind == scenes::SurfaceKind::panel) panel = &s;
  }
  ASSERT_NE(panel, nullptr);
  // The ceiling, whose own panel does not shine on it.
  room.view = scenes::View{.eye_m = {1.2, 1.2, 1.5},
                           .look_at_m = {1.2, 1.2, room.shell[1].frame.origin_m.z()}};
  room.paint.clear();
  const RoomTransport transport = prepare_transport(room);
  ASSERT_EQ(room.surfaces[static_cast<std::size_t>(transport.viewed[0].at.surface)].kind,
            scenes::SurfaceKind::ceiling);
  const LampLight lamps = lamp_light(room, transport, 0, 0);
  EXPECT_TRUE(lamps.by_flux);
  const Eigen::ArrayXd shape = lamps.light.values / lamps.light.values.maxCoeff();
  EXPECT_LT((shape - panel->exitance.values / panel->exitance.values.maxCoeff()).abs().maxCoeff(),
            1e-12);
}

TEST(LampWhite, ResponseAndSolveAgree) {
  const scenes::Room room = office();
  const RoomTransport transport = prepare_transport(room);
  const ReducedViews views = reduce_views(room, transport);
  const RoomResponse response(views, 0, 0, {});
  const spectra::ViewedLight one = response.light(spectra::constant(room.grid, 0.5));
  const RoomState state{.paints = {spectra::constant(room.grid, 0.5)}};
  const spectra::ViewedLight other =
      viewed_light(room, transport, solve_room(room, transport, {}, state));
  EXPECT_TRUE((one.lamps.values == other.lamps.values).all());
  EXPECT_EQ(one.angle_deg, other.angle_deg);
}

TEST(PaintedAngle, OfAllThatIsInViewIsHalfASphere) {
  scenes::Room room = office();
  room.furniture.clear();
  std::erase_if(room.surfaces, [](const scenes::Surface& s) {
    return s.kind == scenes::SurfaceKind::furniture || s.kind == scenes::SurfaceKind::panel ||
           s.kind == scenes::SurfaceKind::opening;
  });
  room.openings.clear();
  room.panels.clear();
  room.paint[0].surfaces.clear();
  for (int s = 0; s < static_cast<int>(room.surfaces.size()); ++s) {
    room.paint[0].surfaces.push_back(s);
  }
  EXPECT_NEAR(painted_angle_deg(room, prepare_transport(room), 0), 180, 1e-5);
}

// From the middle of a wall's normal a square of half side a at distance d takes
// 4 asin(a^2 / (a^2 + d^2)) of solid angle.
TEST(PaintedAngle, OfASquareWallIsItsSolidAngle) {
  scenes::Room room = scenes::read_room(SOURCE_DIR "/scenes/rooms/box.json");
  room.shell = scenes::prism_shell(scenes::rectangular_plan(3, 3), 3);
  room.receivers.clear();
  room.patch_m = 0.5;
  for (scenes::Panel& panel : room.panels) {
    panel.outline = scenes::rectangle_in(room.shell[1].frame, {1.25, 1.25}, {1.75, 1.75});
  }
  room.view = scenes::View{.eye_m = {1.5, 1.0, 1.5}, .look_at_m = {1.5, 3, 1.5}};
  room.paint = {{.name = "wall", .surfaces = {4}}};  // y = 3
  const double a = 1.5, d = 2,
               share = 4 * std::asin(a * a / (a * a + d * d)) / (2 * std::numbers::pi);
  const double angle = 2 * std::acos(1 - share) * 180 / std::numbers::pi;
  EXPECT_NEAR(painted_angle_deg(room, prepare_transport(room), 0), angle, 0.3);
}

}  // namespace
}  // namespace solver
