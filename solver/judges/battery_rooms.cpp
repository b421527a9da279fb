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

scenes::Room bare(std::vector<Vector2d> plan_m, double height_m) {
  return {.grid = spectra::kTransportGrid,
          .plan_m = std::move(plan_m),
          .height_m = height_m,
          .patch_m = 0.6};
}

/// Panel on the ceiling.
Sample empty_box() {
  Sample s{.name = "empty box", .room = bare({{0, 0}, {5, 0}, {5, 4}, {0, 4}}, 2.7)};
  add_ceiling_panel(s.room, 1.2);
  s.flux = kPanelExitance * 1.2 * 1.2;
  return s;
}

/// Desk on the floor, a turned cupboard, a shelf in the air; panel and point light.
Sample furnished() {
  Sample s = empty_box();
  s.name = "furnished";
  s.room.furniture = {
      {.name = "desk", .min_m = {1.7, 1.6, 0}, .max_m = {3.3, 2.4, 0.75}},
      {.name = "cupboard", .min_m = {3.8, 3, 0}, .max_m = {4.6, 3.4, 2}, .rotate_z_deg = 30},
      {.name = "shelf", .min_m = {0.5, 1, 1.2}, .max_m = {1, 3, 1.25}}};
  s.room.point_lights = {{.name = "bulb",
                          .at_m = {1.2, 0.6, 1.8},
                          .spectral_flux = spectra::constant(s.room.grid, kPointFlux)}};
  s.flux += kPointFlux;
  return s;
}

/// A reflex corner, and the sun through a window.
Sample l_shaped() {
  Sample s{.name = "L-shaped, sun",
           .room = bare({{0, 0}, {5, 0}, {5, 2}, {2.5, 2}, {2.5, 4.5}, {0, 4.5}}, 2.6)};
  s.room.openings = {{.name = "window",
                      .wall = 0,
                      .offset_m = 0.7,
                      .sill_m = 0.9,
                      .width_m = 1.6,
                      .height_m = 1.2,
                      .transmittance = spectra::constant(s.room.grid, 0.7)}};
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
                        2.5)};
  s.room.point_lights = {{.name = "bulb",
                          .at_m = {1.4, 1.7, 2.1},
                          .spectral_flux = spectra::constant(s.room.grid, kPointFlux)}};
  s.flux = kPointFlux;
  return s;
}

std::vector<Sample> samples() { return {empty_box(), furnished(), l_shaped(), two_rooms()}; }

/// Every surface another reflectance in every band.
void paint_at_random(scenes::Room& room, double most, unsigned seed) {
  Dice dice(seed);
  for (scenes::Surface& s : room.surfaces) {
    s.reflectance.values = ArrayXd::NullaryExpr(room.grid.count, [&] { return dice(0, most); });
  }
}

}  // namespace

void add_surfaces(scenes::Room& room, double reflectance) {
  using scenes::SurfaceKind;
  const auto add = [&](const std::string& name, SurfaceKind kind, std::size_t index) {
    room.surfaces.push_back({.name = name,
                             .kind = kind,
                             .index = static_cast<int>(index),
                             .reflectance = spectra::constant(room.grid, reflectance),
                             .exitance = spectra::constant(room.grid, 0)});
  };
  add("floor", SurfaceKind::floor, 0);
  add("ceiling", SurfaceKind::ceiling, 0);
  for (std::size_t i = 0; i < room.plan_m.size(); ++i) {
    add("wall_" + std::to_string(i + 1), SurfaceKind::wall, i);
  }
  for (std::size_t i = 0; i < room.openings.size(); ++i) {
    add(room.openings[i].name, SurfaceKind::opening, i);
  }
  for (std::size_t i = 0; i < room.panels.size(); ++i) {
    add(room.panels[i].name, SurfaceKind::panel, i);
  }
  for (std::size_t i = 0; i < room.furniture.size(); ++i) {
    add(room.furniture[i].name, SurfaceKind::furniture, i);
  }
}

scenes::Room black_box(const Eigen::Vector3d& size_m, double patch_m) {
  const double w = size_m.x(), d = size_m.y();
  return {.grid = {.first_nm = 550, .step_nm = 10, .count = 1},
          .plan_m = {{0, 0}, {w, 0}, {w, d}, {0, d}},
          .height_m = size_m.z(),
          .patch_m = patch_m};
}

void add_ceiling_panel(scenes::Room& room, double edge_m) {
  room.panels.push_back(
      {.name = "panel", .on = 1, .center_m = room.plan_m[2] / 2, .size_m = {edge_m, edge_m}});
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
    add_surfaces(room, 0);
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
    add_surfaces(room, 0);
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
