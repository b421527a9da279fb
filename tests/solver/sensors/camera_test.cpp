// The camera by its definition, and what it sees against rays.
#include "solver/sensors/camera.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

#include "scenes/files/room_json.h"
#include "solver/exchange/exchange.h"
#include "solver/obstacles/patch_rays.h"
#include "solver/rooms/room_faces.h"
#include "solver/sensors/film.h"

namespace solver {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// f + tan(fov / 2) [(2 s - W) / W r + (H - 2 t) / W u]
TEST(Camera, LooksAlongTheRaysOfItsDefinition) {
  const Camera camera({1, 2, 1.5}, {1, 5, 1.5}, 60, 400, 300);
  const double tangent = std::tan(30 * std::numbers::pi / 180);
  for (const Vector2d& film : {Vector2d(0, 0), Vector2d(200, 150), Vector2d(399.5, 12.25)}) {
    const Vector3d expected(tangent * (2 * film.x() - 400) / 400, 1,
                            tangent * (300 - 2 * film.y()) / 400);
    EXPECT_LT((camera.direction(film) - expected).norm(), 1e-15);
    const Vector3d point = camera.eye_m() + 3.7 * expected;
    EXPECT_LT((camera.film_of(point) - film).norm(), 1e-12);
    EXPECT_NEAR(camera.depth_m(point), 3.7, 1e-14);
  }
}

TEST(Camera, StraightUpAndDownTheYAxisIsUp) {
  for (const double z : {1.0, -1.0}) {
    const Camera camera({0, 0, 0}, {0, 0, z}, 90, 10, 10);
    EXPECT_LT((camera.direction({5, 0}) - Vector3d(0, 1, z)).norm(), 1e-15) << z;
    EXPECT_LT((camera.direction({10, 5}) - Vector3d(-z, 0, z)).norm(), 1e-15) << z;
  }
}

TEST(Camera, RefusesWhatIsNoCamera) {
  EXPECT_THROW(Camera({0, 0, 0}, {0, 0, 0}, 60, 4, 3), std::invalid_argument);
  EXPECT_THROW(Camera({0, 0, 0}, {0, 1, 0}, 180, 4, 3), std::invalid_argument);
  EXPECT_THROW(Camera({0, 0, 0}, {0, 1, 0}, 60, 0, 3), std::invalid_argument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Camera({0, 0, nan}, {0, 1, 0}, 60, 4, 3), std::invalid_argument);
}

struct Look {
  const char* room;
  Vector3d eye_m, look_at_m;
};

class FilmOfRoom : public testing::TestWithParam<Look> {
 protected:
  FilmOfRoom()
      : room_(scenes::read_room(std::string(SOURCE_DIR) + "/scenes/rooms/" + GetParam().room +
                                ".json")),
        mesh_(whole_mesh(room_)),
        camera_(GetParam().eye_m, GetParam().look_at_m, 75, 64, 48),
        pieces_(film_pieces(camera_, facets_of(mesh_), blockers_of(room_))) {}

  scenes::Room room_;
  scenes::PatchMesh mesh_;
  Camera camera_;
  std::vector<FilmPiece> pieces_;
};

INSTANTIATE_TEST_SUITE_P(Views, FilmOfRoom,
                         testing::Values(Look{"office", {0.4, 0.4, 1.6}, {3.5, 3, 0.8}},
                                         Look{"office", {4.8, 3.8, 2.5}, {1, 1, 0.3}},
                                         Look{"living_room", {5, 0.5, 1.5}, {1, 4, 0.5}},
                                         Look{"box", {2.5, 1, 1.35}, {2.5, 4, 1.35}}),
                         [](const auto& p) { return p.param.room + std::to_string(p.index); });

// No gap and no overlap, whatever hides what.
TEST_P(FilmOfRoom, PiecesFillEveryPixelOnce) {
  Eigen::ArrayXXd covered = Eigen::ArrayXXd::Zero(48, 64);
  for (const FilmPiece& piece : pieces_) {
    for (int row = 0; row < 48; ++row) {
      for_each_fragment(piece, row, [&](const Fragment& f) { covered(row, f.column) += f.area; });
    }
  }
  EXPECT_LT((covered - 1).abs().maxCoeff(), 1e-9);
}

TEST_P(FilmOfRoom, EachPointShowsTheFaceThatARayMeets) {
  const PatchRays rays(mesh_);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  int different = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vector2d film(64 * uniform(random), 48 * uniform(random));
    const int met = rays.first_hit(camera_.eye_m(), camera_.direction(film)).patch;
    for (const FilmPiece& piece : pieces_) {
      bool inside = true;  // outlines run clockwise where rows count downwards
      for (std::size_t v = 0; v < piece.outline.size(); ++v) {
        const Vector2d edge = piece.outline[(v + 1) % piece.outline.size()] - piece.outline[v];
        const Vector2d r = film - piece.outline[v];
        inside = inside && edge.x() * r.y() - edge.y() * r.x() < 0;
      }
      if (inside) different += static_cast<int>(piece.facet) != met ? 1 : 0;
    }
  }
  EXPECT_LE(different, 1);  // rays are float
}

// A triangle's area and centroid, however the pixels cut it.
TEST(Fragments, AddUpToTheirPiece) {
  const FilmPiece piece{
      .facet = 0, .outline = {{1.3, 0.7}, {3.1, 6.9}, {9.4, 2.2}}, .top = 0.7, .bottom = 6.9};
  double area = 0;
  Vector2d moment = Vector2d::Zero();
  for (int row = 0; row < 8; ++row) {
    for_each_fragment(piece, row, [&](const Fragment& f) {
      area += f.area;
      moment += f.area * f.middle;
      EXPECT_GE(f.middle.y(), row);
      EXPECT_LE(f.middle.y(), row + 1);
    });
  }
  const double expected = std::abs(1.8 * 1.5 - 6.2 * 8.1) / 2;
  EXPECT_NEAR(area, expected, 1e-12);
  EXPECT_LT((moment / area - Vector2d(13.8 / 3, 9.8 / 3)).norm(), 1e-12);
}

}  // namespace
}  // namespace solver
