#include <cmath>
#include <numbers>

#include "scenes/skies/sun_position.h"
#include "solver/judges/battery_cases.h"
#include "solver/judges/battery_rooms.h"
#include "solver/judges/battery_targets.h"

// Skies through openings, by formulas: rooms of [CIE171] 5.9 and 5.11, black and 4 x 4 x 3 m.

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr double kPlain_lx = 10000, kGround = 0.3, kTolerance = 1e-6;

void add_sky(scenes::Room& room, int cie_type) {
  room.skies = {scenes::make_sky(room.grid,
                                 scenes::cie_sky(cie_type, scenes::direction_of(180, 60)),
                                 {.spectrum = spectra::constant(room.grid, 1)},
                                 {.horizontal_lx = kPlain_lx,
                                  .beam = ArrayXd::Zero(room.grid.count),
                                  .ground_reflectance = kGround})};
}

/// Irradiance of an open plain, W m^-2 nm^-1.
double plain(const scenes::Room& room) {
  return scenes::irradiance_outside(room.skies[0], Vector3d::UnitZ())[0];
}

ArrayXd received(const SolvedRoom& room) {
  ArrayXd irradiance(static_cast<Eigen::Index>(room.solution.receivers.size()));
  for (Eigen::Index k = 0; k < irradiance.size(); ++k) {
    irradiance[k] = room.solution.receivers[static_cast<std::size_t>(k)].irradiance[0];
  }
  return irradiance;
}

/// A window in the wall y = 0, from x 1 to 3 and z 1 to 2.
scenes::Room facade_room() {
  return black_box({4, 4, 3}).patches(1).opening(0, {1, 1}, {2, 1}).room();
}

/// One of 1 x 1 m in the middle of the roof in its place.
scenes::Room roof_room() {
  scenes::Room room = facade_room();
  room.openings[0].face = 1;
  room.openings[0].outline = {{1.5, 1.5, 3}, {1.5, 2.5, 3}, {2.5, 2.5, 3}, {2.5, 1.5, 3}};
  return room;
}

/// Integral of cos^2 over the solid angle of a rectangle that a surface element faces.
double square_cosine(const Target& target) {
  return target.corners([h = target.distance_m](double a, double b) {
    const double r = std::sqrt(h * h + a * a + b * b);
    return (a * b * h / r * (1 / (h * h + a * a) + 1 / (h * h + b * b)) +
            std::atan(a * b / (h * r))) /
           3;
  });
}

}  // namespace

// 5.9: an even sky gives its plain's irradiance times the configuration factor. The traditional
// overcast sky, L = Lz (1 + 2 cos Z) / 3, gives Lz (pi F + 2 integral of cos^2) / 3, a plain
// 7 pi Lz / 9.
std::vector<Check> check_daylight_roof() {
  std::vector<Check> checks;
  for (const int type : {5, 16}) {
    scenes::Room room = roof_room();
    add_sky(room, type);
    ArrayXd expected(5);
    for (Eigen::Index k = 0; k < 5; ++k) {
      const double y = 0.25 + 0.85 * static_cast<double>(k);
      room.receivers.push_back({.name = "floor", .at_m = {1.8, y, 0}, .normal = {0, 0, 1}});
      const Target roof{{1.5 - 1.8, 1.5 - y}, {2.5 - 1.8, 2.5 - y}, 3};
      const double even = facing_factor(roof);
      expected[k] = type == 5 ? even : 3 / (7 * pi) * (pi * even + 2 * square_cosine(roof));
    }
    expected *= plain(room);
    checks.push_back(
        worst_of({.name = type == 5 ? "roof opening, even sky" : "roof opening, overcast",
                  .quantity = "irradiance, W/m2/nm, 5 points",
                  .tolerance = kTolerance},
                 expected, received(solved(room))));
  }
  return checks;
}

// 5.11: an even sky above the horizon, even ground below it, from the wall opposite the window.
std::vector<Check> check_daylight_facade() {
  scenes::Room room = facade_room();
  add_sky(room, 5);
  ArrayXd expected(4);
  for (Eigen::Index k = 0; k < 4; ++k) {
    const double x = 0.6 + 0.8 * static_cast<double>(k), z = 1.1 + 0.25 * static_cast<double>(k);
    room.receivers.push_back({.name = "wall", .at_m = {x, 4, z}, .normal = {0, -1, 0}});
    const Target sky{{1 - x, 0}, {3 - x, 2 - z}, 4}, ground{{1 - x, 1 - z}, {3 - x, 0}, 4};
    expected[k] = plain(room) * (facing_factor(sky) + kGround * facing_factor(ground));
  }
  return {worst_of({.name = "facade, even sky and ground",
                    .quantity = "irradiance, W/m2/nm, 4 points",
                    .tolerance = kTolerance},
                   expected, received(solved(room)))};
}

// The flux that comes in through a bare window is that of the facade, and all of it arrives.
std::vector<Check> check_daylight_flux() {
  scenes::Room room = facade_room();
  add_sky(room, 12);
  const double facade = scenes::irradiance_outside(room.skies[0], -Vector3d::UnitY())[0];
  return {{"clear sky through a window", "flux that arrives, W/nm", 2 * facade,
           solved(room).solution.energy.absorbed[0], kTolerance}};
}

// An example with published digits [Reda2004]: Golden, Colorado.
std::vector<Check> check_sun_position() {
  const scenes::SunPosition sun =
      scenes::sun_position(39.742476, -105.1786, *scenes::read_moment("2003-10-17T19:30:30Z"));
  constexpr double kHundredth_deg = 0.01;
  return {{"sun over Golden, 2003", "azimuth, degrees", 194.3402, sun.azimuth_deg,
           kHundredth_deg / 194.3402},
          {"sun over Golden, 2003", "altitude, degrees", 39.8721, sun.altitude_deg, 1e-4}};
}

}  // namespace solver
