#include "solver/judges/battery_rooms.h"

#include <cmath>
#include <numbers>

#include "solver/judges/battery_cases.h"

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Vector2d;

constexpr double kSolved = 1e-9;  ///< relative error asked of a solve
constexpr double kPanelExitance = 5, kPointFlux = 40, kSunIrradiance = 3;  ///< W nm^-1, m^-2

/// A room to test, and what its lamps give, W nm^-1.
struct Sample {
  const char* name;
  scenes::Room room;
  double flux = 0;
};

scenes::RoomBuilder bare(const scenes::Polygon& plan_m, double height_m) {
  return scenes::RoomBuilder(plan_m, height_m, 0).patches(0.6);
}

scenes::RoomBuilder lit_box() {
  return bare(scenes::rectangular_plan(5, 4), 2.7).panel(1, {2.5, 2}, {1.2, 1.2});
}

/// Panel on the ceiling.
Sample empty_box() {
  return {.name = "empty box", .room = lit_box().room(), .flux = kPanelExitance * 1.2 * 1.2};
}

/// Desk on the floor, a turned cupboard, a shelf in the air; panel and point light.
Sample furnished() {
  Sample s = empty_box();
  s.name = "furnished";
  s.room = lit_box()
               .box({1.7, 1.6, 0}, {3.3, 2.4, 0.75})
               .box({3.8, 3, 0}, {4.6, 3.4, 2}, 30)
               .box({0.5, 1, 1.2}, {1, 3, 1.25})
               .room();
  s.room.point_lights = {{.name = "bulb",
                          .at_m = {1.2, 0.6, 1.8},
                          .spectral_flux = spectra::constant(s.room.grid, kPointFlux)}};
  s.flux += kPointFlux;
  return s;
}

/// A reflex corner, and the sun through a window.
Sample l_shaped() {
  Sample s{.name = "L-shaped, sun",
           .room = bare({{0, 0}, {5, 0}, {5, 2}, {2.5, 2}, {2.5, 4.5}, {0, 4.5}}, 2.6)
                       .opening(0, {0.7, 0.9}, {1.6, 1.2}, 0.7)
                       .room()};
  const scenes::Sun sun{.name = "sun",
                        .azimuth_deg = 200,
                        .altitude_deg = 35,
                        .normal_irradiance = spectra::constant(s.room.grid, kSunIrradiance)};
  s.room.suns = {sun};
  constexpr double kDegree = std::numbers::pi / 180;  // the window looks to azimuth 180
  const double cosine = std::cos(20 * kDegree) * std::cos(35 * kDegree);
  s.flux = kSunIrradiance * 0.7 * 1.6 * 1.2 * cosine;
  return s;
}

/// A door without a leaf, in a thick wall; the lamp is in one of the rooms.
Sample two_rooms() {
  Sample s{.name = "two rooms",
           .room = bare({{0, 0},
                         {3, 0},
                         {3, 1},
                         {3.2, 1},
                         {3.2, 0},
                         {6, 0},
                         {6, 3},
                         {3.2, 3},
                         {3.2, 1.9},
                         {3, 1.9},
                         {3, 3},
                         {0, 3}},
                        2.5)
                       .room()};
  s.room.point_lights = {{.name = "bulb",
                          .at_m = {1.4, 1.7, 2.1},
                          .spectral_flux = spectra::constant(s.room.grid, kPointFlux)}};
  s.flux = kPointFlux;
  return s;
}

/// Slopes over two walls and a level strip between; a round column, a sofa around a corner, a
/// screen, steps; a panel on the strip and a point light.
Sample attic() {
  const scenes::Polygon plan_m = scenes::rectangular_plan(5, 4);
  scenes::RoomBuilder builder(plan_m,
                              {scenes::pitched_plane(scenes::edge_line(plan_m, 0), 1, 45),
                               scenes::pitched_plane(scenes::edge_line(plan_m, 2), 1, 45),
                               {.height_m = 2.4}},
                              0);
  builder.patches(0.6)
      .panel(3, {2.5, 2}, {0.8, 0.8})
      .body(scenes::prism_body("column", scenes::regular_polygon({1.2, 2}, 0.15, 12), 0, 2.4))
      .body(scenes::prism_body(
          "sofa", {{2.5, 1}, {4.5, 1}, {4.5, 3}, {3.7, 3}, {3.7, 1.8}, {2.5, 1.8}}, 0, 0.45))
      .body(scenes::sheet_body("screen", {{2, 1, 0}, {2, 2, 0}, {2, 2, 1.6}, {2, 1, 1.6}}))
      .body(scenes::stairs_body("steps", {.foot_m = {3.4, 3.5, 0},
                                          .direction_deg = 180,
                                          .width_m = 0.6,
                                          .rise_m = 0.15,
                                          .going_m = 0.3,
                                          .steps = 3}));
  Sample s{.name = "attic", .room = builder.room()};
  s.room.point_lights = {{.name = "bulb",
                          .at_m = {1.7, 1.2, 1.8},
                          .spectral_flux = spectra::constant(s.room.grid, kPointFlux)}};
  s.flux = kPanelExitance * 0.8 * 0.8 + kPointFlux;
  return s;
}

std::vector<Sample> samples() {
  return {empty_box(), furnished(), l_shaped(), two_rooms(), attic()};
}

/// Every surface another reflectance in every band.
void paint_at_random(scenes::Room& room, double most, unsigned seed) {
  Dice dice(seed);
  for (scenes::Surface& s : room.surfaces) {
    s.reflectance.values = ArrayXd::NullaryExpr(room.grid.count, [&] { return dice(0, most); });
  }
}

}  // namespace

scenes::RoomBuilder black_box(const Eigen::Vector3d& size_m, const spectra::Grid& grid) {
  return {scenes::rectangular_plan(size_m.x(), size_m.y()), size_m.z(), 0, grid};
}

ArrayXd SolvedRoom::flux_on(int surface) const {
  ArrayXd flux = ArrayXd::Zero(solution.radiosity.irradiance.cols());
  for (std::size_t p = 0; p < transport.mesh.area_m2.size(); ++p) {
    if (transport.mesh.surface[p] != surface) continue;
    const auto row = static_cast<Eigen::Index>(p);
    flux += transport.mesh.area_m2[p] * solution.radiosity.irradiance.row(row).transpose();
  }
  return flux;
}

SolvedRoom solved(const scenes::Room& room, Light light) {
  SolvedRoom s{.transport = prepare_transport(room, {.light = light}), .solution = {}};
  s.solution = solve_room(room, s.transport, {.relative_error = kSolved});
  return s;
}

// Where every surface emits S = (1 - rho) c, all light is even: B = H = c, whatever the shape.
std::vector<Check> check_white_furnace() {
  constexpr double kLight = 3;
  std::vector<Check> checks;
  for (Sample& sample : samples()) {
    scenes::Room& room = sample.room;
    room.point_lights.clear();
    room.suns.clear();
    paint_at_random(room, 0.9999, 11);
    room.surfaces[0].reflectance.values.setConstant(0.9999);
    for (scenes::Surface& s : room.surfaces) {
      s.exitance.values = kLight * (1 - s.reflectance.values);
    }
    const SolvedRoom furnace = solved(room);
    const Bands& all = furnace.solution.radiosity.radiosity;  // means, then slopes, which are 0
    const Bands radiosity = all.topRows(furnace.transport.mesh.size());
    checks.push_back(worst_of({.name = std::string("white furnace, ") + sample.name,
                               .quantity = "radiosity, W/m2/nm, rho to 0.9999",
                               .tolerance = 1e-6},
                              ArrayXd::Constant(radiosity.size(), kLight), flat(radiosity)));
  }
  return checks;
}

// Absorbed is emitted: sum_i A_i (1 - rho_i) H_i = flux of panels, point lights and sun.
std::vector<Check> check_flux() {
  std::vector<Check> checks;
  for (Sample& sample : samples()) {
    scenes::Room& room = sample.room;
    paint_at_random(room, 0.95, 12);
    for (scenes::Surface& s : room.surfaces) {
      if (s.kind == scenes::SurfaceKind::panel) s.exitance.values.setConstant(kPanelExitance);
    }
    const ArrayXd absorbed = solved(room).solution.energy.absorbed;
    checks.push_back(worst_of({.name = std::string("flux conservation, ") + sample.name,
                               .quantity = "absorbed, W/nm",
                               .tolerance = 1e-8},
                              ArrayXd::Constant(absorbed.size(), sample.flux), absorbed));
  }
  return checks;
}

}  // namespace solver
