#include "solver/exchange/slopes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "scenes/files/room_json.h"
#include "solver/bounce/radiosity.h"
#include "solver/exchange/exchange.h"
#include "solver/factors/pair_factor.h"
#include "solver/rooms/room_light.h"
#include "tests/support/stability_rooms.h"

namespace solver {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

std::vector<Vector3d> polygon(int corners, const Vector3d& middle, const Vector3d& u,
                              const Vector3d& v) {
  std::vector<Vector3d> vertices;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    vertices.push_back(middle + std::cos(angle) * u + std::sin(angle) * v);
  }
  return vertices;
}

Vector3d functions(const SlopeBasis& basis, const Vector3d& offset_m) {
  Vector3d psi;
  psi << 1, basis.at(offset_m);
  return psi;
}

TEST(SlopeBasis, FunctionsAreOrthonormalOnAnyPolygon) {
  for (int corners = 3; corners <= 6; ++corners) {
    const Facet f = make_facet(polygon(corners, {1, 2, 3}, {0.5, 0.1, 0}, {0, 0.02, 0.9}));
    const SlopeBasis basis = slope_basis(f);
    Matrix3d products = Matrix3d::Zero();
    for (const QuadraturePoint& q : quadrature(f.vertices, 4)) {
      const Vector3d psi = functions(basis, q.position - f.centre);
      products += q.weight_m2 / f.area_m2 * psi * psi.transpose();
    }
    EXPECT_LT((products - Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-12) << corners;
  }
}

/// <psi_a, K psi_b> by Gauss points on a grid of parts of both.
Matrix3d by_brute_force(const Facet& i, const Facet& j) {
  const SlopeBasis of_i = slope_basis(i), of_j = slope_basis(j);
  Matrix3d m = Matrix3d::Zero();
  for (const auto& part_i : parts_of(i.vertices)) {
    for (const QuadraturePoint& p : quadrature(part_i, 4)) {
      for (const auto& part_j : parts_of(j.vertices)) {
        for (const QuadraturePoint& q : quadrature(part_j, 4)) {
          const Vector3d r = q.position - p.position;
          const double r2 = r.squaredNorm();
          const double kernel = -i.normal.dot(r) * j.normal.dot(r) / (std::numbers::pi * r2 * r2);
          m += p.weight_m2 * q.weight_m2 * kernel * functions(of_i, p.position - i.centre) *
               functions(of_j, q.position - j.centre).transpose();
        }
      }
    }
  }
  return m;
}

// Facets over each other at distances where each far rule begins; of A F.
TEST(FarMoments, AgreeWithBruteForceToAThousandthOfTheExchange) {
  for (const double distance : {1.65, 3.6, 8.2, 20.0}) {
    std::vector<Facet> facets{
        make_facet(polygon(4, {0, 0, 0}, {0.7, 0, 0}, {0, 0.7, 0})),
        make_facet(polygon(4, {0.5 * distance, 0, 0.87 * distance}, {0, 0.6, 0}, {0.7, 0.1, 0})),
        make_facet(polygon(3, {0, -0.5 * distance, 0.87 * distance}, {0, 0.6, 0}, {0.7, 0.1, 0}))};
    const std::vector<SlopeBasis> bases = slope_bases(facets);
    const FarField far(facets, bases);
    FarRow row;
    far.start(0, 0, row);
    std::array<int, kFarPatches> order{};
    for (const std::size_t j : {1, 2}) order[j] = slope_order(row.distance_over_size[j]);
    ASSERT_GT(order[1], 0);
    FarField::Moments moments;
    far.moments(row, order, moments);
    for (const std::size_t j : {1, 2}) {
      const Matrix3d exact = by_brute_force(facets[0], facets[j]);
      for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
          EXPECT_NEAR(moments[static_cast<std::size_t>(3 * a + b)][j], exact(a, b),
                      1e-3 * exact(0, 0))
              << distance << " " << j << " " << a << b;
        }
      }
    }
  }
}

/// The same by exact exchange areas between 16 x 16 parts of each: for patches that touch.
Matrix3d by_small_parts(const Facet& i, const Facet& j) {
  struct Part {
    Facet facet;
    Vector3d psi;
  };

  const auto cut = [](const Facet& f) {
    const SlopeBasis basis = slope_basis(f);
    std::vector<Part> parts;
    for (const auto& quarter : parts_of(f.vertices)) {
      for (const auto& part : parts_of(quarter)) {
        const Facet small = make_facet(part);
        parts.push_back({small, functions(basis, small.centre - f.centre)});
      }
    }
    return parts;
  };
  Matrix3d m = Matrix3d::Zero();
  const std::vector<Part> of_j = cut(j);
  for (const Part& p : cut(i)) {
    for (const Part& q : of_j) m += exchange_area(p.facet, q.facet) * p.psi * q.psi.transpose();
  }
  return m;
}

// Face to face at the distance of their edge, and at right angles with a common edge.
TEST(NearMoments, AgreeWithSmallPartsToOneAndAHalfPercent) {
  const std::vector<Facet> facets{make_facet({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}),
                                  make_facet({{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}),
                                  make_facet({{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}})};
  const SlopeMoments slopes(facets);
  for (const std::size_t j : {1, 2}) {
    const Matrix3d near = slopes.near(0, j), exact = by_small_parts(facets[0], facets[j]);
    EXPECT_LT((near - exact).cwiseAbs().maxCoeff(), 1.5e-2 * exact(0, 0)) << j;
    EXPECT_LT((near - slopes.near(j, 0).transpose()).cwiseAbs().maxCoeff(), 5e-3 * exact(0, 0));
  }
}

class LinearRoom : public testing::TestWithParam<const char*> {
 protected:
  scenes::Room room_ =
      scenes::read_room(std::string(SOURCE_DIR) + "/scenes/rooms/" + GetParam() + ".json");
};

INSTANTIATE_TEST_SUITE_P(Rooms, LinearRoom,
                         testing::Values("box", "office", "l_room", "two_rooms", "living_room"),
                         [](const auto& p) { return std::string(p.param); });

// Light that is even stays even, and what it is made of is symmetric.
TEST_P(LinearRoom, EvenLightHasNoSlopesAndEntriesAreReciprocal) {
  const RoomTransport t = prepare_transport(room_, {.patch_m = 0.5});
  const ExchangeAreas& x = t.exchange;
  ASSERT_EQ(x.rows(), 3 * t.mesh.size());
  Bands even = Bands::Zero(x.rows(), 1);
  even.topRows(t.mesh.size()) = 1;
  EXPECT_LT((gather(x, even) - even).abs().maxCoeff(), 1e-12);
  for (int i = 0; i < x.rows(); i += 7) {
    for (int j = 0; j < x.rows(); j += 11) {
      const double there = x.area_m2[i] * x.form_factor(i, j);
      EXPECT_NEAR(there, x.area_m2[j] * x.form_factor(j, i), 1e-12 * x.area_m2[i]);
    }
  }
}

// What the rules leave of that, of the patch's area; more where rays decide.
TEST_P(LinearRoom, MomentsNearlyCloseByThemselves) {
  const RoomTransport t = prepare_transport(room_);
  EXPECT_LT(t.exchange.largest_slope_defect, room_.furniture.empty() ? 0.02 : 0.1);
  EXPECT_LT(t.exchange.without_slopes, t.mesh.size() / 20);
}

TEST_P(LinearRoom, ViewedAndMeasuredLightAgreesWithThreeTimesThePatches) {
  room_.suns.clear();  // patches do not follow their edges
  if (room_.receivers.empty()) GTEST_SKIP();
  const auto solved = [&](double patch_m) {
    return solve_room(room_, prepare_transport(room_, {.patch_m = patch_m, .rays = 256}));
  };
  const RoomSolution coarse = solved(0.3), fine = solved(0.17);
  for (std::size_t k = 0; k < coarse.receivers.size(); ++k) {
    const Eigen::ArrayXd difference = coarse.receivers[k].irradiance - fine.receivers[k].irradiance;
    EXPECT_LT(difference.abs().maxCoeff(), 2e-3 * fine.receivers[k].irradiance.maxCoeff())
        << room_.receivers[k].name;
  }
}

// One system, whoever solves it.
TEST(LinearLight, AllMethodsAgreeWithTheDirectSolve) {
  const RoomTransport t = prepare_transport(stability::two_rooms(), {.patch_m = 0.8});
  const Lighting& light = t.lightings.front();
  const Bands reflectance = Bands::Constant(t.exchange.rows(), light.emission.cols(), 0.9);
  const auto solved = [&](Method method) {
    const RadiositySolution s =
        solve_radiosity(t.exchange, light.emission, light.direct, reflectance,
                        {.method = method, .relative_error = 1e-9});
    EXPECT_TRUE(s.converged) << to_string(method);
    EXPECT_FALSE(s.proven);
    return s.irradiance;
  };
  const Bands exact = solved(Method::direct);
  for (const Method method : {Method::conjugate_gradients, Method::jacobi, Method::gauss_seidel,
                              Method::progressive, Method::bicgstab}) {
    EXPECT_LT((solved(method) - exact).abs().maxCoeff(), 1e-7 * exact.maxCoeff())
        << to_string(method);
  }
}

// Light that crosses a corridor by many bounces: constant light on half as long patches is
// four times as wrong.
TEST(LinearLight, CorridorIsRightWithinAThousandth) {
  scenes::Room room = stability::corridor();
  for (const double x : {1.0, 7.5, 12.0, 15.0, 20.0, 29.0}) {
    room.receivers.push_back({.name = "floor", .at_m = {x, 0.75, 0}, .normal = {0, 0, 1}});
  }
  const auto solved = [&](double patch_m, Light light) {
    return solve_room(room, prepare_transport(room, {.patch_m = patch_m, .light = light}));
  };
  const auto worst = [&](const RoomSolution& solution, const RoomSolution& exact) {
    double error = 0;
    for (std::size_t k = 0; k < room.receivers.size(); ++k) {
      error = std::max(
          error,
          std::abs(solution.receivers[k].irradiance[0] / exact.receivers[k].irradiance[0] - 1));
    }
    return error;
  };
  const RoomSolution exact = solved(0.15, Light::linear);
  EXPECT_LT(worst(solved(0.5, Light::linear), exact), 1.5e-3);
  EXPECT_GT(worst(solved(0.5, Light::constant), exact), 5e-3);
}

// A slot of a hundredth of its depth: light is even there, and nothing grows from bounce to bounce.
TEST(LinearLight, SlotsKeepConstantLight) {
  const scenes::Room room = stability::room_of(
      stability::box_members({.x_m = 4, .y_m = 4, .z_m = 0.04}, 0.4, 0.9) + ", " +
      stability::panel_member(R"({"on": "ceiling", "center_m": [1, 1], "size_m": [1, 1]})"));
  const RoomTransport t = prepare_transport(room);
  EXPECT_GT(t.exchange.without_slopes, 0);
  EXPECT_LT(stability::furnace_error(room), 1e-6);
}

}  // namespace
}  // namespace solver
