#include "solver/sources/direct_light.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>
#include <vector>

#include "scenes/mesh/patch_mesh.h"
#include "solver/exchange/exchange.h"
#include "solver/obstacles/visibility.h"
#include "tests/scenes/test_rooms.h"

namespace solver {
namespace {

using Eigen::Vector3d;

/// A room of 5 x 5 x 2.5 m with a box turned by an angle, and what stands on it.
scenes::Room room_with_box(double rotate_z_deg, int stacked, const Vector3d& lamp_m) {
  scenes::RoomBuilder builder = scenes::rectangular_room(5, 5, 2.5);
  builder.opening(0, {1, 1}, {3, 1});
  builder.box({2.5, 2.8, 0}, {3.5, 3.3, 1}, rotate_z_deg);
  if (stacked > 0) builder.box({2.5, 2.8, 1}, {3.5, 3.3, 1.5}, stacked == 1 ? rotate_z_deg : 0);
  if (stacked > 1) builder.box({2.5, 3.3, 0}, {3.5, 3.8, 1}, 0);
  scenes::Room room = builder.room();
  const spectra::Spectrum one = spectra::constant(room.grid, 1);
  room.point_lights.push_back({.name = "lamp", .at_m = lamp_m, .spectral_flux = one});
  room.suns.push_back(
      {.name = "sun", .azimuth_deg = 180, .altitude_deg = 30, .normal_irradiance = one});
  return room;
}

/// Flux on each surface in one band, W nm^-1.
std::vector<double> flux_by_surface(const scenes::Room& room, double patch_m) {
  const scenes::PatchMesh mesh = scenes::mesh_room(room, patch_m);
  const Visibility visibility(room, mesh);
  const DirectLight light = DirectSources(room, visibility).on_patches(mesh, facets_of(mesh));
  EXPECT_TRUE(light.irradiance.isFinite().all());
  EXPECT_GE(light.irradiance.minCoeff(), 0);
  EXPECT_LT(light.largest_scaling(), 1e-7);  // of boxes that touch, one turned by 1e-3 degrees
  std::vector<double> flux(room.surfaces.size(), 0);
  for (std::size_t i = 0; i < mesh.polygon.size(); ++i) {
    flux[static_cast<std::size_t>(mesh.surface[i])] +=
        mesh.area_m2[i] * light.irradiance(static_cast<Eigen::Index>(i), 0);
  }
  return flux;
}

// Angles made by atan2 are a little off: the silhouettes of a box then nearly lie in its faces, in
// those of boxes that touch it, and in the edges of the patches beside it. A turn of 1e-3 degrees
// moves a corner by 1e-5 m, which a flux of 1 W nm^-1 shows by less than the turn in degrees.
TEST(DirectLight, BoxesThatAreHardlyTurnedAreLitLikeThoseThatAreNot) {
  for (const Vector3d& lamp : {Vector3d(4, 0.8, 1.9), Vector3d(1, 1, 2), Vector3d(3.5, 1, 1.9),
                               Vector3d(3, 2.8, 1.9), Vector3d(4, 2.8, 1), Vector3d(4.5, 3.3, 0.5),
                               Vector3d(2.5, 2.5, 1.5), Vector3d(3.5, 4, 2.2)}) {
    for (int stacked = 0; stacked < 3; ++stacked) {
      for (const double patch_m : {1.0, 0.45}) {
        const std::vector<double> straight =
            flux_by_surface(room_with_box(0, stacked, lamp), patch_m);
        for (const double exponent : {-12., -10., -9., -8., -7.5, -7., -6.5, -6., -5., -4., -3.}) {
          const double turn_deg = std::pow(10, exponent);
          SCOPED_TRACE(testing::Message() << "lamp " << lamp.transpose() << ", stacked " << stacked
                                          << ", patch_m " << patch_m << ", turn " << turn_deg);
          EXPECT_THAT(flux_by_surface(room_with_box(turn_deg, stacked, lamp), patch_m),
                      testing::Pointwise(testing::DoubleNear(1e-8 + turn_deg), straight));
        }
      }
    }
  }
}

// Boxes on and beside each other, each turned a little: nothing negative, nothing undefined.
TEST(DirectLight, RandomStacksThatAreHardlyTurnedGetLightOfZeroOrMore) {
  std::mt19937 random(1);
  const auto dice = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) * 0x1p-32;
  };
  for (int k = 0; k < 3000; ++k) {
    const auto turn_deg = [&] { return std::pow(10, dice(-10, -4)); };
    scenes::RoomBuilder builder = scenes::rectangular_room(5, 5, 2.5);
    builder.opening(0, {1, 1}, {3, 1});
    const double height_m = std::round(dice(1, 10)) / 10, edge_m = std::round(dice(5, 15)) / 10;
    builder.box({2, 2, 0}, {2 + edge_m, 3, height_m}, turn_deg());
    builder.box({2, 2, height_m}, {2 + edge_m, 3, height_m + 0.5}, turn_deg());
    builder.box({2.25, 2.25, height_m + 0.5}, {2.75, 2.75, height_m + 0.8}, turn_deg());
    builder.box({2, 3, 0}, {2.5, 3.5, height_m}, 0);
    scenes::Room room = builder.room();
    const spectra::Spectrum one = spectra::constant(room.grid, 1);
    room.point_lights.push_back(
        {.name = "lamp",
         .at_m = {std::round(dice(2, 48)) / 10, std::round(dice(2, 19)) / 10, dice(0.1, 2.4)},
         .spectral_flux = one});
    SCOPED_TRACE(k);
    flux_by_surface(room, 1);
    if (testing::Test::HasFailure()) break;
  }
}

// Over a polygon cut into parts, and far off its foot.
TEST(SolidAngleMoment, IsTheSumOverSmallParts) {
  const Vector3d lamp(0.3, -0.4, 0.7), normal(0, 0, 1);
  const std::vector<Vector3d> whole{{0, 0, 0}, {1.2, 0.1, 0}, {0.9, 1, 0}, {-0.2, 0.8, 0}};
  Vector3d sum = Vector3d::Zero();
  for (const auto& part : parts_of(whole)) {
    for (const auto& small : parts_of(part)) {
      for (const QuadraturePoint& q : quadrature(small, 3)) {
        const Vector3d r = q.position - lamp;
        sum += q.weight_m2 * -normal.dot(r) / std::pow(r.norm(), 3) * r;
      }
    }
  }
  const Vector3d moment = solid_angle_moment(lamp, whole, normal);
  EXPECT_LT((moment - sum).head<2>().norm(), 1e-9);
}

// Means with psi_1 and psi_2 of what falls on a patch, against points; shadows and all.
TEST(DirectLight, SlopesAreMomentsOfTheLightAtPoints) {
  scenes::Room room = room_with_box(20, 0, {1.1, 1.3, 2.1});
  const scenes::PatchMesh mesh = scenes::mesh_room(room, 0.8);
  const std::vector<Facet> facets = facets_of(mesh);
  const std::vector<SlopeBasis> bases = slope_bases(facets);
  const Visibility visibility(room, mesh);
  const DirectSources sources(room, visibility);
  const DirectLight light = sources.on_patches(mesh, facets, bases);
  const Eigen::Index n = mesh.size();
  ASSERT_EQ(light.irradiance.rows(), 3 * n);
  const double brightest = light.irradiance.topRows(n).maxCoeff();
  for (Eigen::Index p = 0; p < n; p += 3) {
    const auto i = static_cast<std::size_t>(p);
    Vector3d moments = Vector3d::Zero();
    constexpr int kSteps = 60;  // shadow edges cost a hundredth
    for (int s = 0; s < kSteps; ++s) {
      for (int t = 0; t < kSteps; ++t) {
        const Vector3d at = area_point(facets[i], (s + 0.5) / kSteps, (t + 0.5) / kSteps);
        Vector3d psi;
        psi << 1, bases[i].at(at - facets[i].centre);
        moments += sources.at_point(at, mesh.normal[i])[0] / (kSteps * kSteps) * psi;
      }
    }
    for (int a = 0; a < 3; ++a) {
      EXPECT_NEAR(light.irradiance(a * n + p, 0), moments[a], 0.01 * brightest) << p << " " << a;
    }
  }
}

// Squares of 2 cm all over the floor, against 64 x 64 points in each. Where shadows cross them the
// points err by up to 2 / 64 of the whole, and the light of a middle by little more.
TEST(DirectLight, OverAPixelIsTheMeanOfItsPoints) {
  const scenes::Room room = room_with_box(20, 1, {4, 0.8, 1.9});
  const DirectSources sources(room, Visibility(room, scenes::mesh_room(room, 1)));
  constexpr double kSide_m = 0.02;
  constexpr int kPoints = 64;
  int crossed = 0;
  for (double x = 0.113; x < 4.9; x += 0.191) {
    for (double y = 0.113; y < 2.7; y += 0.067) {
      const std::vector<Vector3d> pixel{
          {x, y, 0}, {x + kSide_m, y, 0}, {x + kSide_m, y + kSide_m, 0}, {x, y + kSide_m, 0}};
      const Vector3d middle(x + kSide_m / 2, y + kSide_m / 2, 0), up(0, 0, 1);
      double mean = 0, largest = 0, least = 1e300;
      for (int k = 0; k < kPoints * kPoints; ++k) {
        const double s = (k % kPoints + 0.5) / kPoints, t = (k / kPoints + 0.5) / kPoints;
        const double light = sources.at_point({x + s * kSide_m, y + t * kSide_m, 0}, up)[0];
        mean += light / (kPoints * kPoints);
        largest = std::max(largest, light);
        least = std::min(least, light);
      }
      crossed += least < 0.5 * largest ? 1 : 0;
      EXPECT_NEAR(sources.over(pixel, middle, up)[0], mean, 0.035 * largest) << x << ' ' << y;
    }
  }
  EXPECT_GT(crossed, 5);
}

}  // namespace
}  // namespace solver
