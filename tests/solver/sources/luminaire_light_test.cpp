#include "solver/sources/luminaire_light.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "scenes/mesh/patch_mesh.h"
#include "solver/exchange/exchange.h"
#include "solver/obstacles/visibility.h"
#include "solver/sources/direct_light.h"
#include "tests/scenes/test_rooms.h"

namespace solver {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

// A point at height 2 over a corner of 1.2 x 0.8 with intensity cos^n, by closed forms (n 0 to 2)
// and quadrature to all digits.
TEST(IntensityQuadrature, PowersOfTheCosineOverACorner) {
  const Facet floor = make_facet({{0, 0, 0}, {1.2, 0, 0}, {1.2, 0.8, 0}, {0, 0.8, 0}});
  for (const auto& [n, flux] : std::vector<std::pair<int, double>>{{0, 0.192261208506},
                                                                   {1, 0.179383383086},
                                                                   {2, 0.167737673267},
                                                                   {3, 0.157184824218},
                                                                   {4, 0.147602946922},
                                                                   {8, 0.117034434976}}) {
    const Intensity intensity{
        .at = [power = n](const Vector3d& d) { return std::pow(-d.z() / d.norm(), power); }};
    EXPECT_NEAR(lit_flux(floor.vertices, floor, nullptr, {0, 0, 2}, intensity, 1e-7)[0], flux, 1e-8)
        << n;
  }
}

// A peak a degree wide between the points of the first rule is found: pi times its half width
// squared, as a cone, over 3.
TEST(IntensityQuadrature, ANarrowPeakIsNotMissed) {
  const Facet floor = make_facet({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
  const double width = pi / 360;
  const Vector3d peak = Vector3d(0.31, 0.17, -2).normalized();
  const auto from_peak = [&](const Vector3d& d) {
    return std::atan2(peak.cross(d).norm(), peak.dot(d));
  };
  const Intensity intensity{
      .at = [&](const Vector3d& d) { return std::max(0.0, 1 - from_peak(d) / width); },
      .most_within = [&](const Vector3d& d,
                         double radius) { return from_peak(d) < width + radius ? 1.0 : 0.0; },
      .finest_rad = width};
  EXPECT_NEAR(lit_flux(floor.vertices, floor, nullptr, {0, 0, 2}, intensity, 1e-8)[0],
              pi * width * width / 3, 1e-3 * width * width);
}

/// A luminaire without symmetry, 5 x 15 degree table.
std::shared_ptr<const scenes::Luminaire> lopsided(const Vector3d& size_m) {
  std::vector<double> gamma, c;
  for (int g = 0; g <= 180; g += 5) gamma.push_back(g);
  for (int k = 0; k <= 360; k += 15) c.push_back(k);
  Eigen::ArrayXXd cd(static_cast<Eigen::Index>(c.size()), static_cast<Eigen::Index>(gamma.size()));
  for (Eigen::Index a = 0; a < cd.rows(); ++a) {
    for (Eigen::Index p = 0; p < cd.cols(); ++p) {
      const double g = gamma[static_cast<std::size_t>(p)] * pi / 180,
                   h = c[static_cast<std::size_t>(a)] * pi / 180;
      cd(a, p) = 300 + 200 * std::cos(g) + 150 * std::sin(g) * std::cos(h) +
                 80 * std::sin(g) * std::sin(2 * h);
    }
  }
  scenes::Luminaire lamp{.path = "",
                         .format = "",
                         .name = "",
                         .symmetry = "",
                         .intensity = {scenes::Goniometry::c, gamma, c, cd}};
  lamp.flux_lm = lamp.intensity.flux_lm();
  lamp.size_m = size_m;
  lamp.shape = size_m.z() > 0   ? scenes::LuminousShape::box
               : size_m.x() > 0 ? scenes::LuminousShape::rectangle
                                : scenes::LuminousShape::point;
  return std::make_shared<const scenes::Luminaire>(std::move(lamp));
}

scenes::Room lit_room(const Vector3d& size_m, const Vector3d& at_m, const Vector3d& aim) {
  scenes::Room room = scenes::rectangular_room(5, 4, 2.5).box({3, 2, 0}, {4, 3, 1}, 20).room();
  room.luminaires.push_back({.name = "lamp",
                             .type = lopsided(size_m),
                             .at_m = at_m,
                             .axes = scenes::luminaire_axes(aim, 30),
                             .spectral_flux = spectra::constant(room.grid, 1)});
  return room;
}

// In free air all of the flux arrives, of the point as of the elements of an area or a body, with
// shadows; quadrature alone meets it before anything is scaled.
TEST(LuminaireLight, AllFluxOfALuminaireInTheAirArrives) {
  for (const Vector3d& size_m :
       {Vector3d(0, 0, 0), Vector3d(1.2, 0.3, 0), Vector3d(0.6, 0.3, 0.1)}) {
    const scenes::Room room = lit_room(size_m, {2.2, 1.8, 1.7}, {0.2, 0.1, -1});
    const scenes::PatchMesh mesh = scenes::mesh_room(room, 0.5);
    const DirectLight light =
        DirectSources(room, Visibility(room, mesh)).on_patches(mesh, facets_of(mesh));
    double flux = 0;
    for (std::size_t i = 0; i < mesh.polygon.size(); ++i) {
      flux += mesh.area_m2[i] * light.irradiance(static_cast<Eigen::Index>(i), 0);
    }
    EXPECT_NEAR(flux, 1, 1e-12);
    EXPECT_LT(light.largest_scaling(), 1e-5) << size_m.transpose();
  }
}

// E = I cos / r^2, exactly, far from it; behind the box nothing.
TEST(LuminaireLight, APointGetsIntensityTimesCosineOverSquare) {
  const scenes::Room room = lit_room({0, 0, 0}, {2.2, 1.8, 1.7}, {0.2, 0.1, -1});
  const scenes::PlacedLuminaire& lamp = room.luminaires[0];
  const DirectSources sources(room, Visibility(room, scenes::mesh_room(room, 1)));
  const Vector3d point(1, 0.5, 0), ray = point - lamp.at_m;
  const double lx =
      lamp.type->intensity.at(lamp.axes.transpose() * ray) * -ray.z() / std::pow(ray.norm(), 3);
  EXPECT_NEAR(sources.at_point(point, Vector3d::UnitZ())[0] / (lx / lamp.type->flux_lm), 1, 1e-12);
  EXPECT_EQ(sources.at_point({4.5, 3.4, 0}, Vector3d::UnitZ())[0], 0);
}

// A Lambertian square of edge 1 seen from below its middle at its own distance: the point is 33 %
// too bright there, elements meet the view factor of a square on its axis.
TEST(LuminaireLight, NearItASquareIsNoPoint) {
  std::vector<double> gamma;
  Eigen::ArrayXXd cd(2, 361);
  for (int k = 0; k <= 360; ++k) gamma.push_back(k / 4.0);
  for (Eigen::Index k = 0; k < 361; ++k) {
    cd.col(k) = std::cos(gamma[static_cast<std::size_t>(k)] * pi / 180);
  }
  cd.col(360) = 0;
  scenes::Luminaire square{.path = "",
                           .format = "",
                           .name = "",
                           .symmetry = "",
                           .intensity = {scenes::Goniometry::c, gamma, {0, 360}, cd}};
  square.flux_lm = 1;
  square.size_m = {1, 1, 0};
  const LuminaireSource source({.name = "",
                                .type = std::make_shared<const scenes::Luminaire>(square),
                                .at_m = {0, 0, 2},
                                .axes = Eigen::Matrix3d::Identity(),
                                .spectral_flux = spectra::constant(spectra::kTransportGrid, 1)},
                               {});
  const auto exact = [](double distance_m) {  // pi times the factor of four quarters
    const double a = 0.5 / distance_m, b = a / std::sqrt(1 + a * a);
    return 4 * b * std::atan(b);
  };
  for (const double distance_m : {1.0, 2.0, 5.0}) {
    const double lx = source.at_point({0, 0, 2 - distance_m}, Vector3d::UnitZ());
    EXPECT_NEAR(lx / exact(distance_m), 1, 4e-3) << distance_m;
  }
}

// Straight down: nothing turns but rotate_deg; aimed at +x, its x axis has come up.
TEST(LuminaireAxes, TurnFirstThenAim) {
  const Eigen::Matrix3d down = scenes::luminaire_axes({0, 0, -1}, 90);
  EXPECT_LT((down.col(0) - Vector3d(0, 1, 0)).norm(), 1e-12);
  const Eigen::Matrix3d east = scenes::luminaire_axes({2, 0, 0}, 0);
  EXPECT_LT((east * Vector3d(0, 0, -1) - Vector3d(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((east.col(0) - Vector3d(0, 0, 1)).norm(), 1e-12);
  const Eigen::Matrix3d up = scenes::luminaire_axes({0, 0, 1}, 0);
  EXPECT_LT((up - Vector3d(1, -1, -1).asDiagonal().toDenseMatrix()).norm(), 1e-12);
}

}  // namespace
}  // namespace solver
