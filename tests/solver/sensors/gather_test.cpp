#include "solver/sensors/gather.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <random>

#include "scenes/files/room_json.h"
#include "scenes/shapes/room_builder.h"
#include "solver/exchange/exchange.h"
#include "solver/factors/pair_factor.h"

namespace solver {
namespace {

using Eigen::Vector3d;

scenes::Room sample_room(const std::string& name) {
  return scenes::read_room(std::string(SOURCE_DIR) + "/scenes/rooms/" + name + ".json");
}

// Triangles to hexagons at random, also backs, across the horizon and below it.
TEST(PointFactors, AgreeWithEachPolygonAlone) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto anywhere = [&] { return Vector3d(unit(random), unit(random), unit(random)); };
  std::vector<std::vector<Vector3d>> polygons;
  PointFactors factors;
  for (int k = 0; k < 300; ++k) {
    const Vector3d middle = 2 * anywhere(), u = anywhere(), v = u.cross(anywhere());
    std::vector<Vector3d> polygon;
    for (int corner = 0; corner < 3 + k % 4; ++corner) {
      const double angle = 2 * std::numbers::pi * corner / (3 + k % 4);
      polygon.push_back(middle + std::cos(angle) * u + std::sin(angle) * v);
    }
    factors.add(polygon);
    polygons.push_back(std::move(polygon));
  }
  for (int point = 0; point < 10; ++point) {
    const Vector3d at = anywhere(), normal = anywhere().normalized();
    const Eigen::VectorXd all = factors.from(at, normal);
    ASSERT_EQ(all.size(), 300);
    for (std::size_t k = 0; k < polygons.size(); ++k) {
      EXPECT_NEAR(all[static_cast<Eigen::Index>(k)], point_to_polygon(at, normal, polygons[k]),
                  1e-14);
    }
  }
}

// The point lies in the plane of the first, the second reaches up to the horizon.
TEST(PointFactors, NothingIsSeenOfWhatDoesNotRiseAboveTheHorizon) {
  PointFactors factors;
  factors.add({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
  factors.add({{1, -1, 0}, {1, -1, -1}, {1, 1, -1}, {1, 1, 0}});
  EXPECT_EQ(factors.from({0.1, 0.2, 0}, {0, 0, 1}), Eigen::Vector2d::Zero());
  EXPECT_EQ(factors.from({0.1, 0.2, 0}, {0, 0, -1})[0], 0);
}

class GatherIn : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(SampleRooms, GatherIn,
                         testing::Values("box", "office", "l_room", "two_rooms", "living_room",
                                         "corridor"),
                         [](const auto& p) { return std::string(p.param); });

// What a point sees of all patches fills its sky: nothing is seen twice, nothing that is hidden.
TEST_P(GatherIn, VisibleFormFactorsSumToOne) {
  const scenes::Room room = sample_room(GetParam());
  const scenes::PatchMesh mesh = scenes::mesh_room(room, 0.7);
  const std::vector<Facet> facets = facets_of(mesh);
  const Visibility visibility(room, mesh);
  const PointGather gather(mesh, facets, visibility);
  for (std::size_t p = 0; p < facets.size(); p += 7) {
    const GatherRow row = gather.row(facets[p].centre, facets[p].normal);
    EXPECT_LT(row.closure_defect, 1e-9)
        << room.surfaces[static_cast<std::size_t>(mesh.surface[p])].name;
    EXPECT_NEAR(row.weights.sum(), 1, 1e-12);
    EXPECT_GE(row.weights.minCoeff(), -1e-15);
  }
}

// In sharp and blunt corners too, off the edge never leads behind the point's own wall. The point
// is moved by 1e-7 m, a millionth of the smallest patches here: so much may be missing of its sky.
TEST(Gather, PointsOnEdgesSeeAllOfTheRoom) {
  for (const auto& plan :
       {std::vector<Eigen::Vector2d>{{0, 0}, {4, 0}, {0, 3}},
        std::vector<Eigen::Vector2d>{{0, 0}, {4, 0}, {4, 3}, {2, 0.8}, {0, 3}}}) {
    const scenes::Room room = scenes::RoomBuilder(plan, 2.5).room();
    const scenes::PatchMesh mesh = scenes::mesh_room(room, 1.2);
    const std::vector<Facet> facets = facets_of(mesh);
    const Visibility visibility(room, mesh);
    const PointGather gather(mesh, facets, visibility);
    for (const Facet& f : facets) {
      for (const Vector3d& v : f.vertices) {
        EXPECT_LT(gather.row(v, f.normal).closure_defect, 1e-5) << v.transpose();
      }
    }
  }
}

// Light that is linear on every surface of a box, 1 + x + y + z: a gather with slopes is the
// integral over the surfaces, to what parts of a patch leave of the kernel's bend.
TEST(PointGather, ReadsLinearLightAsItsIntegral) {
  const scenes::Room room = sample_room("box");
  const scenes::PatchMesh mesh = scenes::mesh_room(room, 0.8);
  const std::vector<Facet> facets = facets_of(mesh);
  const SlopeMoments slopes(facets);
  const Visibility visibility(room, mesh);
  const PointGather gather(mesh, facets, visibility, &slopes);
  const Vector3d slope(1, 1, 1);
  const Eigen::Index n = mesh.size();
  Eigen::VectorXd light(3 * n);
  for (Eigen::Index p = 0; p < n; ++p) {
    const auto i = static_cast<std::size_t>(p);
    light[p] = 1 + slope.dot(facets[i].centre);
    for (Eigen::Index a = 0; a < 2; ++a) {  // <psi_a, light> / A, in the plane
      const Vector3d& g = slopes.bases()[i].gradient_per_m[static_cast<std::size_t>(a)];
      light[(a + 1) * n + p] = g.norm() > 0 ? slope.dot(g) / g.squaredNorm() : 0;
    }
  }
  const scenes::PatchMesh fine = scenes::mesh_room(room, 0.05);
  for (const auto& [at, normal] : {std::pair(Vector3d(2.5, 2, 0), Vector3d(0, 0, 1)),
                                   std::pair(Vector3d(1.3, 4, 0.9), Vector3d(0, -1, 0)),
                                   std::pair(Vector3d(0.4, 0.6, 1.1), Vector3d(0.6, 0, 0.8))}) {
    double exact = 0;
    for (std::size_t j = 0; j < fine.polygon.size(); ++j) {
      exact += point_to_polygon(at, normal, fine.polygon[j]) * (1 + slope.dot(fine.centre[j]));
    }
    EXPECT_NEAR(gather.row(at, normal).weights.dot(light), exact, 2e-4 * exact);
  }
}

}  // namespace
}  // namespace solver
