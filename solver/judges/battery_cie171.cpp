#include <cmath>
#include <numbers>

#include "solver/factors/facet.h"
#include "solver/judges/battery_cases.h"
#include "solver/judges/battery_rooms.h"
#include "solver/judges/battery_targets.h"

// The analytical cases of [CIE171] by formulas derived here, not by the tables printed there.
// Rooms and lamps are our own, of the size and kind that the report uses.

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr double kUnoccluded = 1e-6, kOccluded = 1e-4;

ArrayXd received(const SolvedRoom& room) {
  ArrayXd irradiance(static_cast<Eigen::Index>(room.solution.receivers.size()));
  for (Eigen::Index k = 0; k < irradiance.size(); ++k) {
    irradiance[k] = room.solution.receivers[static_cast<std::size_t>(k)].irradiance[0];
  }
  return irradiance;
}

void add_point_light(scenes::Room& room, const Vector3d& at_m, double flux) {
  room.point_lights = {
      {.name = "bulb", .at_m = at_m, .spectral_flux = spectra::constant(room.grid, flux)}};
}

/// 5.2, 5.3, 5.4: the black room of 4 x 4 x 3 m.
scenes::RoomBuilder hall() { return black_box({4, 4, 3}).patches(0.5); }

/// 5.3, 5.4: with a square diffuse panel in the middle of the ceiling that emits 1 W m^-2 nm^-1.
scenes::Room panel_hall(double edge_m) {
  scenes::Room room = hall().panel(1, {2, 2}, {edge_m, edge_m}).room();
  room.surfaces.back().exitance.values.setOnes();
  return room;
}

/// The panel seen from a point of the floor.
Target panel_above(const Vector2d& point_m, double edge_m) {
  const Vector2d middle(2, 2), half(edge_m / 2, edge_m / 2);
  return {middle - half - point_m, middle + half - point_m, 3};
}

/// 5.6, 5.7: the floor alone reflects, and the sun through a window of 2 x 2 m, at 45 degrees in
/// front of it, lights exactly the square [1, 3] x [1, 3] of it, which the floor's grid follows:
/// half a patch, then whole ones.
constexpr double kFloorReflectance = 0.8, kSunNormal = 2;

constexpr double kSunlitPatch_m = 4.0 / 18;  ///< with constant light

scenes::RoomBuilder sunlit_hall() {
  return black_box({4, 4, 3}).patches(kSunlitPatch_m).opening(0, {1, 1}, {2, 2});
}

void light_floor(scenes::Room& room) {
  room.suns = {{.name = "sun",
                .azimuth_deg = 180,
                .altitude_deg = 45,
                .normal_irradiance = spectra::constant(room.grid, kSunNormal)}};
  room.surfaces[0].reflectance.values.setConstant(kFloorReflectance);
}

double lit_radiosity() { return kFloorReflectance * kSunNormal * std::sqrt(0.5); }

/// The lit square up to y = `far_m`, seen from the wall y = 4 at (x, z).
Target lit_square(const Vector2d& at_m, double far_m) {
  return {{4 - far_m, 1 - at_m.x()}, {3, 3 - at_m.x()}, at_m.y()};
}

constexpr double kScreenTop_m = 1, kScreenGap_m = 0.5;

/// What a point of the wall y = 4 at height z sees of the lit square above the edge of the screen,
/// 0.5 m before the wall and 1 m high: the floor up to 0.5 z / (z - 1) from the wall is hidden.
double seen_up_to_m(double height_m) {
  return std::min(3.0, 4 - kScreenGap_m * height_m / (height_m - kScreenTop_m));
}

/// At three places along the wall y = 4, at each of the heights.
void add_receivers_behind_screen(scenes::Room& room, const std::vector<double>& heights_m,
                                 std::vector<double>& expected) {
  for (const double x : {0.4, 2.0, 3.3}) {
    for (const double z : heights_m) {
      room.receivers.push_back({.name = "wall", .at_m = {x, 4, z}, .normal = {0, -1, 0}});
      expected.push_back(lit_radiosity() * sideways_factor(lit_square({x, z}, seen_up_to_m(z))));
    }
  }
}

}  // namespace

// 5.2 Point light: E = I cos / r^2 with I = flux / 4pi; flux on the floor by its solid angle, the
// sum over four corners of atan(x y / (h sqrt(x^2 + y^2 + h^2))).
std::vector<Check> check_cie171_5_2() {
  constexpr double kFlux = 100;
  const Vector3d lamp(1.6, 2.3, 2.4);
  scenes::Room room = hall().room();
  add_point_light(room, lamp, kFlux);
  for (const double s : {0.3, 1.6, 2.9, 3.7}) {
    room.receivers.push_back({.name = "floor", .at_m = {s, 1.1, 0}, .normal = {0, 0, 1}});
    room.receivers.push_back({.name = "wall", .at_m = {4, s, 0.7}, .normal = {-1, 0, 0}});
    room.receivers.push_back({.name = "desk", .at_m = {s, s, 0.8}, .normal = {0, 0.6, 0.8}});
  }
  ArrayXd expected(static_cast<Eigen::Index>(room.receivers.size()));
  for (Eigen::Index k = 0; k < expected.size(); ++k) {
    const scenes::Receiver& at = room.receivers[static_cast<std::size_t>(k)];
    const Vector3d r = lamp - at.at_m;
    expected[k] = std::max(0.0, kFlux / (4 * pi) * at.normal.dot(r) / std::pow(r.norm(), 3));
  }
  const double h = lamp.z();
  const Target floor{-lamp.head<2>(), Vector2d(4, 4) - lamp.head<2>(), h};
  const double angle_sr = floor.corners([h](double x, double y) {
    return std::atan(x * y / (h * std::sqrt(x * x + y * y + h * h)));
  });
  const SolvedRoom lit = solved(room);
  return {worst_of({.name = "CIE 171 5.2, point light",
                    .quantity = "irradiance, W/m2/nm, 12 points",
                    .tolerance = kUnoccluded},
                   expected, received(lit)),
          {"CIE 171 5.2, point light", "flux on the floor, W/nm", kFlux * angle_sr / (4 * pi),
           lit.flux_on(0)[0], kUnoccluded}};
}

// 5.3 Area light: E = exitance x configuration factor.
std::vector<Check> check_cie171_5_3() {
  std::vector<Check> checks;
  for (const double edge_m : {1.0, 3.0}) {
    scenes::Room room = panel_hall(edge_m);
    std::vector<double> expected;
    for (const double s : {0.2, 1.3, 2.0, 3.5}) {
      const Vector2d on_floor(s, 0.9);
      room.receivers.push_back({.name = "floor", .at_m = {s, 0.9, 0}, .normal = {0, 0, 1}});
      expected.push_back(facing_factor(panel_above(on_floor, edge_m)));
      // From the wall x = 0 the panel lies along the normal, 3 - z above.
      const double z = 0.8 * s;
      Target along_wall = panel_above({0, s}, edge_m);
      along_wall.distance_m = 3 - z;
      room.receivers.push_back({.name = "wall", .at_m = {0, s, z}, .normal = {1, 0, 0}});
      expected.push_back(sideways_factor(along_wall));
    }
    checks.push_back(worst_of(
        {.name = "CIE 171 5.3, area light of " + std::to_string(static_cast<int>(edge_m)) + " m",
         .quantity = "irradiance, W/m2/nm, 8 points",
         .tolerance = kUnoccluded},
        Eigen::Map<ArrayXd>(expected.data(), static_cast<Eigen::Index>(expected.size())),
        received(solved(room))));
  }
  return checks;
}

// 5.4 Conservation of flux: what leaves openings of growing size arrives inside, and on the floor
// as much as the configuration factor integrates to.
std::vector<Check> check_cie171_5_4() {
  const ArrayXd edge_m{{1.0, 2.0, 3.0, 3.9}};
  ArrayXd all(4), floor(4);
  for (Eigen::Index k = 0; k < 4; ++k) {
    const SolvedRoom lit = solved(panel_hall(edge_m[k]));
    all[k] = lit.solution.energy.absorbed[0];
    floor[k] = lit.flux_on(0)[0];
  }
  ArrayXd expected_on_floor = ArrayXd::Zero(4);
  for (Eigen::Index k = 0; k < 4; ++k) {
    for (const QuadraturePoint& p : quadrature({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, 8)) {
      const Target panel = panel_above(p.position.head<2>(), edge_m[k]);
      expected_on_floor[k] += 4 * p.weight_m2 * facing_factor(panel);  // a quarter of the floor
    }
  }
  return {worst_of({.name = "CIE 171 5.4, conservation of flux",
                    .quantity = "on all surfaces, W/nm, lamps of 1 to 3.9 m",
                    .tolerance = kUnoccluded},
                   edge_m.square(), all),
          worst_of({.name = "CIE 171 5.4, conservation of flux",
                    .quantity = "on the floor, W/nm, lamps of 1 to 3.9 m",
                    .tolerance = kUnoccluded},
                   expected_on_floor, floor)};
}

// 5.6 Reflection by a diffuse surface that parallel light falls on: E = rho E_0 sin(altitude) x
// configuration factor of the lit square.
std::vector<Check> check_cie171_5_6() {
  scenes::Room room = sunlit_hall().room();
  light_floor(room);
  std::vector<double> expected;
  for (const double s : {0.3, 1.4, 2.0, 3.8}) {
    const double z = 1.2 + 0.45 * s;
    room.receivers.push_back({.name = "wall", .at_m = {s, 4, z}, .normal = {0, -1, 0}});
    expected.push_back(lit_radiosity() * sideways_factor(lit_square({s, z}, 3)));
    room.receivers.push_back({.name = "ceiling", .at_m = {s, 0.7, 3}, .normal = {0, 0, -1}});
    expected.push_back(lit_radiosity() * facing_factor({{1 - s, 0.3}, {3 - s, 2.3}, 3}));
  }
  return {worst_of({.name = "CIE 171 5.6, diffuse reflection",
                    .quantity = "irradiance, W/m2/nm, 8 points",
                    .tolerance = kUnoccluded},
                   Eigen::Map<ArrayXd>(expected.data(), static_cast<Eigen::Index>(expected.size())),
                   received(solved(room, Light::constant)))};
}

// 5.7 The same behind a screen that stands on the floor from wall to wall: of the lit square only
// what is seen above its edge counts. The edge of the shadow falls between patches, or across them.
std::vector<Check> check_cie171_5_7() {
  scenes::Room room = sunlit_hall().box({0, 3.5, 0}, {4, 3.55, kScreenTop_m}).room();
  light_floor(room);
  std::vector<double> expected;
  // Up to y = 13/9, 19/9 and 23/9, where patches meet.
  add_receivers_behind_screen(room, {46.0 / 37, 34.0 / 25, 26.0 / 17}, expected);
  add_receivers_behind_screen(room, {1.28, 1.35, 1.45}, expected);
  const Eigen::Map<ArrayXd> exact(expected.data(), static_cast<Eigen::Index>(expected.size()));
  const ArrayXd computed = received(solved(room, Light::constant));
  return {worst_of({.name = "CIE 171 5.7, screen, shadow along patches",
                    .quantity = "irradiance, W/m2/nm, 9 points",
                    .tolerance = kOccluded},
                   exact.head(9), computed.head(9)),
          worst_of({.name = "CIE 171 5.7, screen, shadow across patches",
                    .quantity = "irradiance, W/m2/nm, 9 points",
                    .tolerance = kOccluded},
                   exact.tail(9), computed.tail(9))};
}

// 5.8 Internally reflected light, all surfaces alike: in a sphere it is flux rho / (A (1 - rho))
// everywhere (check_sphere), in any closed room this is its mean.
std::vector<Check> check_cie171_5_8() {
  constexpr double kFlux = 10000;
  scenes::Room room = black_box({4, 4, 4}, spectra::kTransportGrid).patches(1).room();
  add_point_light(room, {2, 2, 2}, kFlux);
  const ArrayXd reflectance = ArrayXd::LinSpaced(31, 0.05, 0.9999);
  for (scenes::Surface& s : room.surfaces) s.reflectance.values = reflectance;
  const SolvedRoom lit = solved(room);
  const Eigen::Index patches = lit.transport.mesh.size();
  const ArrayXd area_m2 = lit.transport.exchange.area_m2.head(patches);
  const Bands reflected =
      (lit.solution.radiosity.irradiance - lit.transport.lightings[0].direct).topRows(patches);
  const ArrayXd mean =
      (area_m2.matrix().transpose() * reflected.matrix()).transpose().array() / area_m2.sum();
  return {worst_of({.name = "CIE 171 5.8, reflected light",
                    .quantity = "mean irradiance, W/m2/nm, rho 0.05 to 0.9999",
                    .tolerance = kUnoccluded},
                   kFlux * reflectance / (96 * (1 - reflectance)), mean)};
}

}  // namespace solver
