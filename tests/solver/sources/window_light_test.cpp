#include "solver/sources/window_light.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "appearance/spectra/photometry.h"
#include "scenes/mesh/patch_mesh.h"
#include "scenes/shapes/room_builder.h"
#include "scenes/skies/sun_position.h"
#include "solver/exchange/exchange.h"
#include "solver/factors/pair_factor.h"
#include "solver/sources/direct_light.h"

namespace solver {
namespace {

using Eigen::Array3d;
using Eigen::ArrayXd;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr double kPlain_lx = 10000;

spectra::Spectrum even(const scenes::Room& room) { return spectra::constant(room.grid, 1); }

scenes::Sky sky_over(const scenes::Room& room, const scenes::SkyPattern& pattern,
                     double ground = 0.3) {
  return scenes::make_sky(room.grid, pattern, {.spectrum = even(room)},
                          {.horizontal_lx = kPlain_lx,
                           .beam = ArrayXd::Zero(room.grid.count),
                           .ground_reflectance = ground});
}

/// 4 x 4 x 3 m with a window in the wall y = 0, from x 1 to 3 and z 1 to 2.
scenes::Room facade_room() {
  return scenes::RoomBuilder(scenes::rectangular_plan(4, 4), 3, 0)
      .opening(0, {1, 1}, {2, 1})
      .room();
}

/// With 1 x 1 m open in the middle of its roof.
scenes::Room roof_room() {
  scenes::Room room = facade_room();
  room.openings[0].face = 1;
  room.openings[0].outline = {{1.5, 1.5, 3}, {1.5, 2.5, 3}, {2.5, 2.5, 3}, {2.5, 1.5, 3}};
  return room;
}

double percent(const scenes::Room& room, const Vector3d& point, const Vector3d& normal) {
  const auto visibility = std::make_shared<const Visibility>();
  const int opening = scenes::find_surface(room, room.openings[0].name);
  const WindowLight window(room, opening, room.skies[0], visibility);
  return 100 / kPlain_lx * spectra::luminous({room.grid, window.at_point(point, normal)});
}

struct Points {
  scenes::SkyPattern sky;
  std::array<double, 5> roof, facade, glazed;
};

const std::array<std::pair<Vector3d, Vector3d>, 5> kAt{{{{2, 0.25, 0}, Vector3d::UnitZ()},
                                                        {{2, 1.25, 0}, Vector3d::UnitZ()},
                                                        {{2, 2.25, 0}, Vector3d::UnitZ()},
                                                        {{2, 3.75, 0}, Vector3d::UnitZ()},
                                                        {{2, 4, 1.25}, -Vector3d::UnitY()}}};

void expect(scenes::Room room, const scenes::SkyPattern& sky, const std::array<double, 5>& values,
            const char* what) {
  room.skies = {sky_over(room, sky)};
  for (std::size_t k = 0; k < values.size(); ++k) {
    EXPECT_NEAR(percent(room, kAt[k].first, kAt[k].second), values[k], 1e-4 * values[k] + 6e-6)
        << what << ", point " << k;
  }
}

/// The points of [CIE171] 5.9 to 5.12, by an independent quadrature; the sun stands before the
/// facade, 60 degrees high.
TEST(WindowLight, RoofAndFacadeUnderSkies) {
  const Vector3d to_sun = scenes::direction_of(180, 60);
  const std::vector<Points> cases{{scenes::cie_sky(1, to_sun),
                                   {2.33502, 3.83884, 4.29386, 2.33502, 2.26098},
                                   {5.08929, 7.63670, 3.19752, .87263, 1.50809},
                                   {2.15759, 6.43485, 2.78590, .76583, 1.32672}},
                                  {scenes::cie_sky(5, to_sun),
                                   {1.95519, 3.04518, 3.36703, 1.95519, 2.19827},
                                   {4.12807, 7.11359, 3.59155, 1.26557, 3.08843},
                                   {1.74970, 5.99932, 3.13036, 1.11081, 2.71697}},
                                  {scenes::cie_sky(12, to_sun),
                                   {.96471, 2.03452, 3.96804, 5.72259, 4.60939},
                                   {5.02644, 14.55657, 6.12574, 1.99669, 4.93054},
                                   {2.16041, 12.26480, 5.33795, 1.75251, 4.33751}},
                                  {scenes::cie_sky(16, to_sun),
                                   {2.28907, 3.82254, 4.29441, 2.28907, 2.19786},
                                   {5.03723, 7.42136, 3.18758, .94491, 1.70562},
                                   {2.13562, 6.25337, 2.77749, .82930, 1.50048}}};
  scenes::Room glazed = facade_room();
  glazed.openings[0].glass.emplace(
      1, ArrayXd::Constant(glazed.grid.count, scenes::Glass::clear_at_normal(1)));
  for (const Points& c : cases) {
    expect(roof_room(), c.sky, c.roof, "roof");
    expect(facade_room(), c.sky, c.facade, "facade");
    expect(glazed, c.sky, c.glazed, "facade with glass");
  }
}

TEST(WindowLight, PerezThroughTheFacade) {
  scenes::Room room = facade_room();
  const scenes::SkyPattern sky = scenes::perez_sky(
      {.direct_normal_W_m2 = 600, .diffuse_horizontal_W_m2 = 120, .day_of_year = 80},
      scenes::direction_of(180, 35));
  room.skies = {sky_over(room, sky)};
  EXPECT_NEAR(percent(room, kAt[1].first, kAt[1].second), 16.08013, 1.6e-3);
  EXPECT_NEAR(percent(room, kAt[2].first, kAt[2].second), 15.08060, 1.5e-3);
  EXPECT_NEAR(percent(room, kAt[4].first, kAt[4].second), 10.54341, 1e-3);
}

/// An even sky over ground of the same luminance is a window that shines evenly: [Lambert1760].
TEST(WindowLight, EvenSurroundingsAreALambertianWindow) {
  scenes::Room room = facade_room();
  room.skies = {sky_over(room, scenes::cie_sky(5, Vector3d::UnitZ()), 1 - 1e-12)};
  for (const auto& [point, normal] : kAt) {
    const double factor =
        point_to_polygon(point, normal, make_facet(room.openings[0].outline).vertices);
    EXPECT_NEAR(percent(room, point, normal), 100 * factor, 1e-6 * factor * 100);
  }
}

/// What comes in arrives: by quadrature alone to 1e-3, and closed to rounding.
TEST(WindowLight, AllThatComesInArrives) {
  for (const bool glass : {false, true}) {
    scenes::Room room = scenes::RoomBuilder(scenes::rectangular_plan(4, 4), 3, 0.5)
                            .opening(0, {1, 0}, {2, 2.5})
                            .box({1, 1, 0}, {2, 2, 1})
                            .patches(0.5)
                            .room();
    if (glass) room.openings[0].glass.emplace(2, ArrayXd::Constant(room.grid.count, 0.7));
    room.skies = {sky_over(room, scenes::cie_sky(12, scenes::direction_of(200, 30)))};
    const scenes::PatchMesh mesh = scenes::mesh_room(room, 0.5);
    const Visibility visibility(room, mesh);
    const auto facets = facets_of(mesh);
    const DirectLight light = DirectSources(room, visibility).on_patches(mesh, facets);
    EXPECT_LT(light.largest_scaling(), 1e-3);
    const WindowLight window(room, scenes::find_surface(room, room.openings[0].name), room.skies[0],
                             std::make_shared<const Visibility>(visibility));
    double arriving = 0;
    for (std::size_t p = 0; p < facets.size(); ++p) {
      arriving += facets[p].area_m2 * light.irradiance(static_cast<Eigen::Index>(p), 9);
    }
    EXPECT_NEAR(arriving / (5 * window.entering()[9]), 1, 1e-12);
  }
}

/// The flux through a bare window is that of a vertical plane outside.
TEST(WindowLight, EnteringIsTheIrradianceOfTheFacade) {
  scenes::Room room = facade_room();
  room.skies = {sky_over(room, scenes::cie_sky(12, scenes::direction_of(200, 30)))};
  const WindowLight window(room, scenes::find_surface(room, room.openings[0].name), room.skies[0],
                           std::make_shared<const Visibility>());
  const ArrayXd outside = scenes::irradiance_outside(room.skies[0], -Vector3d::UnitY());
  EXPECT_NEAR(window.entering()[0] / outside[0], 1, 1e-8);
}

/// A wall opposite that has no end hides what an angle hides, from each point its own.
TEST(WindowLight, WhatStandsOpposite) {
  scenes::Room room = facade_room();
  room.skies = {sky_over(room, scenes::cie_sky(5, scenes::direction_of(180, 60)), 0)};
  room.skies[0].obstruction = {{.distance_m = 10, .top_m = 11, .reflectance = 0}};
  const double by_wall = percent(room, {2, 2, 0}, Vector3d::UnitZ());
  room.skies[0].obstruction = {{.angle_deg = std::atan2(11, 12) * 180 / pi, .reflectance = 0}};
  EXPECT_NEAR(percent(room, {2, 2, 0}, Vector3d::UnitZ()), by_wall, 1e-9 * by_wall);
  // Light of a bright wall of the sky's own luminance would be as if nothing stood there.
  room.skies[0].obstruction.reset();
  const double free = percent(room, {2, 2, 0}, Vector3d::UnitZ());
  room.skies[0].obstruction = {{.angle_deg = 40, .reflectance = 1}};
  const double white = percent(room, {2, 2, 0}, Vector3d::UnitZ());
  EXPECT_LT(by_wall, white);
  // A vertical wall under an even sky gets half of what the plain gets.
  room.skies[0].obstruction->reflectance = 0;
  const double black = percent(room, {2, 2, 0}, Vector3d::UnitZ());
  EXPECT_NEAR(white - black, (free - black) / 2, 1e-6);
}

TEST(WindowLight, NightIsDark) {
  scenes::Room room = facade_room();
  room.skies = {scenes::make_sky(room.grid, scenes::cie_sky(5, Vector3d::UnitZ()),
                                 {.spectrum = even(room)},
                                 {.horizontal_lx = 0, .beam = ArrayXd::Zero(room.grid.count)})};
  const scenes::PatchMesh mesh = scenes::mesh_room(room, 1);
  const DirectSources sources(room, Visibility(room, mesh));
  EXPECT_FALSE(sources.has_skies());
  EXPECT_EQ(sources.at_point({2, 2, 0}, Vector3d::UnitZ()).maxCoeff(), 0);
}

/// Daylight by direction has the luminance of the pattern, and the colour of its temperature.
TEST(WindowLight, ColourByDirectionKeepsTheLuminance) {
  const scenes::Room room = facade_room();
  const scenes::SkyPattern pattern = scenes::cie_sky(12, scenes::direction_of(180, 40));
  const scenes::SkyAmounts amounts{.horizontal_lx = kPlain_lx,
                                   .beam = ArrayXd::Zero(room.grid.count)};
  const scenes::Sky plain = scenes::make_sky(room.grid, pattern, {.spectrum = even(room)}, amounts);
  const scenes::Sky coloured = scenes::make_sky(room.grid, pattern, {}, amounts);
  for (const double altitude : {5.0, 35.0, 80.0}) {
    const Vector3d direction = scenes::direction_of(150, altitude);
    const spectra::Spectrum a{room.grid, scenes::radiance(plain, direction)},
        b{room.grid, scenes::radiance(coloured, direction)};
    EXPECT_NEAR(spectra::luminous(a) / spectra::luminous(b), 1, 1e-12);
    EXPECT_GT(b.values[3] / b.values[28], a.values[3] / a.values[28]);  // bluer than even
  }
}

}  // namespace
}  // namespace solver
