// Pixels that are known: furnaces, lamps, a single white wall, and mirror symmetry.
#include "solver/rooms/room_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/files/room_json.h"
#include "scenes/shapes/room_builder.h"
#include "solver/exchange/exchange.h"
#include "solver/factors/pair_factor.h"

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr int kWidth = 80, kHeight = 60;

scenes::Room sample_room(const std::string& name) {
  return scenes::read_room(std::string(SOURCE_DIR) + "/scenes/rooms/" + name + ".json");
}

scenes::Surface& surface(scenes::Room& room, const std::string& name) {
  return room.surfaces.at(static_cast<std::size_t>(scenes::find_surface(room, name)));
}

/// A solved room, and its picture.
struct Taken {
  Taken(scenes::Room of, const Vector3d& eye_m, const Vector3d& look_at_m)
      : room(std::move(of)),
        transport(prepare_transport(room, {.eye = false})),
        solution(solve_room(room, transport, {.relative_error = 1e-10})),
        camera(eye_m, look_at_m, 75, kWidth, kHeight),
        picture(room, transport, solution, camera) {}

  scenes::Room room;
  RoomTransport transport;
  RoomSolution solution;
  Camera camera;
  RoomPicture picture;
};

const Vector3d kDoor_m{0.4, 0.4, 1.6}, kDesks_m{3.5, 3, 0.8};

/// Every surface emits what is missing to C = 1, so everything is as bright as everything else.
scenes::Room furnace(double least, double step) {
  scenes::Room room = sample_room("office");
  for (std::size_t s = 0; s < room.surfaces.size(); ++s) {
    const double rho = least + step * static_cast<double>(s % 5);
    room.surfaces[s].reflectance.values.setConstant(rho);
    room.surfaces[s].exitance.values.setConstant(1 - rho);
  }
  return room;
}

TEST(RoomPicture, InAFurnaceEveryPixelIsTheSame) {
  const Taken taken(furnace(0.6, 0), kDoor_m, kDesks_m);
  const PictureRows rows = taken.picture.rows(0, kHeight);
  EXPECT_LT((rows.radiance * pi - 1).abs().maxCoeff(), 1e-6);
}

// The same light by surfaces that reflect differently: what is interpolated is not even, but its
// sum with direct light is.
TEST(RoomPicture, InAFurnaceOfManyReflectancesPixelsKeepTheTarget) {
  const Taken taken(furnace(0.1, 0.2), kDoor_m, kDesks_m);
  const PictureRows rows = taken.picture.rows(0, kHeight);
  const ArrayXd error = (rows.radiance * pi - 1).abs().rowwise().maxCoeff();
  EXPECT_LT(std::sqrt(error.square().mean()), 0.005);
  EXPECT_GE((error < 0.02).cast<double>().mean(), 0.999);
}

// All else is black, so no light comes back to the wall: L = rho S F / pi, F [Lambert1760].
TEST(RoomPicture, LampWhiteWallAndBlackBodyHaveTheirRadiance) {
  scenes::Room room = sample_room("box");
  for (scenes::Surface& s : room.surfaces) s.reflectance.values.setZero();
  surface(room, "north").reflectance.values.setConstant(0.8);
  const int panel = scenes::find_surface(room, "panel");
  const ArrayXd exitance = room.surfaces[static_cast<std::size_t>(panel)].exitance.values;
  const std::vector<Vector3d> lamp = room.panels.front().outline;
  const Taken taken(std::move(room), {2.5, 0.5, 0.5}, {2.5, 4, 2.2});
  const PictureRows rows = taken.picture.rows(0, kHeight);
  int lamps = 0, walls = 0, blacks = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const ArrayXd radiance = rows.radiance.row(Index{y} * kWidth + x).transpose();
      const Vector3d d = taken.camera.direction({x + 0.5, y + 0.5}), eye = taken.camera.eye_m();
      const Vector3d on_wall = eye + (4 - eye.y()) / d.y() * d;
      const Vector3d on_ceiling = eye + (2.7 - eye.z()) / d.z() * d;
      const bool wall = std::abs(on_wall.x() - 2.5) < 2.4 && std::abs(on_wall.z() - 1.35) < 1.3;
      if (wall) {
        ++walls;
        const ArrayXd expected = 0.8 / pi * point_to_polygon(on_wall, {0, -1, 0}, lamp) * exitance;
        EXPECT_LT(((radiance - expected) / exitance.maxCoeff()).abs().maxCoeff(), 1e-12);
      } else if (d.z() > 0 &&
                 (on_ceiling.head<2>() - Eigen::Vector2d(2.5, 2)).cwiseAbs().maxCoeff() < 0.5) {
        ++lamps;
        EXPECT_LT((radiance / (exitance / pi) - 1).abs().maxCoeff(), 1e-12);
      } else if (d.z() > 0 && on_ceiling.y() > 2.7 && on_ceiling.y() < 3.9) {
        ++blacks;
        EXPECT_EQ(radiance.abs().maxCoeff(), 0);
      }
    }
  }
  EXPECT_GT(std::min({lamps, walls, blacks}), 50);
}

/// The patch that x -> 5 - x maps a patch to.
std::size_t mirrored(const scenes::PatchMesh& mesh, std::size_t patch) {
  const Vector3d c = mesh.centre[patch], image(5 - c.x(), c.y(), c.z());
  const auto other = std::ranges::min_element(
      mesh.centre, {}, [&](const Vector3d& centre) { return (centre - image).norm(); });
  return static_cast<std::size_t>(other - mesh.centre.begin());
}

/// The mean of a solution and its mirror image: exchange areas are floats, and alike to 1e-6 alone.
Bands symmetrised(const scenes::PatchMesh& mesh, const Bands& radiosity) {
  const Index n = mesh.size();
  const std::vector<SlopeBasis> bases = slope_bases(facets_of(mesh));
  Bands mean = radiosity;
  for (std::size_t p = 0; p < bases.size(); ++p) {
    const std::size_t q = mirrored(mesh, p);
    const auto own = static_cast<Index>(p), other = static_cast<Index>(q);
    mean.row(own) = (radiosity.row(own) + radiosity.row(other)) / 2;
    for (std::size_t a = 0; a < 2; ++a) {
      const Vector3d& gradient = bases[p].gradient_per_m[a];
      BandRow along = gradient.squaredNorm() * radiosity.row((1 + static_cast<Index>(a)) * n + own);
      for (std::size_t b = 0; b < 2; ++b) {
        const Vector3d& g = bases[q].gradient_per_m[b];
        along += gradient.dot(Vector3d(-g.x(), g.y(), g.z())) *
                 radiosity.row((1 + static_cast<Index>(b)) * n + other);
      }
      mean.row((1 + static_cast<Index>(a)) * n + own) = along / (2 * gradient.squaredNorm());
    }
  }
  return mean;
}

double largest_asymmetry(const PictureRows& rows) {
  double largest = 0;
  for (Index y = 0; y < kHeight; ++y) {
    for (Index x = 0; x < kWidth / 2; ++x) {
      const auto left = rows.radiance.row(y * kWidth + x);
      const auto right = rows.radiance.row(y * kWidth + kWidth - 1 - x);
      largest = std::max(largest, ((left - right) / left.maxCoeff()).abs().maxCoeff());
    }
  }
  return largest;
}

TEST(RoomPicture, AMirrorSymmetricSolutionHasAMirrorSymmetricPicture) {
  Taken taken(sample_room("box"), {2.5, 0.7, 1.2}, {2.5, 4, 1.2});
  EXPECT_LT(largest_asymmetry(taken.picture.rows(0, kHeight)), 2e-6);
  Bands& radiosity = taken.solution.radiosity.radiosity;
  radiosity = symmetrised(taken.transport.mesh, radiosity);
  const RoomPicture picture(taken.room, taken.transport, taken.solution, taken.camera);
  EXPECT_LT(largest_asymmetry(picture.rows(0, kHeight)), 1e-9);
}

TEST(RoomPicture, FurnishedRoomKeepsTheTargetAgainstGatheringEveryPixel) {
  for (const char* name : {"office", "living_room"}) {
    const Taken taken(sample_room(name), kDoor_m, kDesks_m);
    const PictureCheck check = taken.picture.check(800);
    EXPECT_LT(check.rms, 0.005) << name;
    EXPECT_LE(check.share_above_2_percent, 0.00126) << name;
    ;  // one pixel of 800
    ;
  }
}

// Where a patch of sun begins, linear light on the patches falls below 0; beside it no pixel may.
TEST(RoomPicture, NoPixelIsDarkerThanNothingBesideAPatchOfSun) {
  const Taken taken(sample_room("l_room"), {4.9, 2.6, 1.0}, {6, 2.35, 0.05});
  EXPECT_GT(taken.picture.rows(0, kHeight).radiance.minCoeff(), 0);
}

// Bands that are another's times a factor leave rounding of either sign where a window only emits.
TEST(RoomPicture, AGreyRoomUnderAWindowHasLightInEveryPixel) {
  scenes::Room room = scenes::RoomBuilder(scenes::rectangular_plan(5, 4), 2.5)
                          .patches(0.6)
                          .opening(0, {2, 1}, {1, 1})
                          .room();
  room.surfaces.back().exitance.values = Eigen::ArrayXd::LinSpaced(31, 0.7, 1.9).square();
  const Taken taken(std::move(room), {4.5, 2, 1.5}, {0, 2, 1.2});
  EXPECT_GT(taken.picture.rows(0, kHeight).radiance.minCoeff(), 0);
}

TEST(RoomPicture, OneAndTwoThreadsGiveTheSameBits) {
  const auto picture = [](int threads) {
    set_threads(threads);
    const Taken taken(sample_room("living_room"), kDoor_m, kDesks_m);
    return taken.picture.rows(0, kHeight);
  };
  const PictureRows one = picture(1), two = picture(2);
  EXPECT_TRUE((one.radiance == two.radiance).all());
  EXPECT_TRUE((one.illuminance == two.illuminance).all());
}

}  // namespace
}  // namespace solver
