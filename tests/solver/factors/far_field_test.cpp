#include "solver/factors/far_field.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "solver/factors/pair_factor.h"

namespace solver {
namespace {

using Eigen::Vector3d;

/// Rectangles with sides in a ratio of 1 to 3, every fourth cut to a triangle, at `ratio` sizes and
/// some more from the first, all of which face it.
std::vector<Facet> around_first(double ratio, bool aligned, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const auto direction = [&] {
    return Vector3d(2 * unit(random) - 1, 2 * unit(random) - 1, 2 * unit(random) - 1).normalized();
  };
  const auto facet = [&](const Vector3d& centre, const Vector3d& u, const Vector3d& v,
                         bool triangle) {
    const Vector3d corner = centre - (u + v) / 2;
    std::vector<Vector3d> vertices{corner, corner + u, corner + u + v, corner + v};
    if (triangle) vertices.pop_back();
    return make_facet(std::move(vertices));
  };
  std::vector<Facet> facets{facet({5, 3, 1}, {0.2 + 0.4 * unit(random), 0, 0}, {0, 0.2, 0}, false)};
  const Facet first = facets[0];
  while (facets.size() < kFarPatches) {
    const Vector3d normal = aligned ? -Vector3d::Unit(random() % 3) : direction();
    const Vector3d u = (aligned ? Vector3d(normal.y(), normal.z(), normal.x())
                                : normal.cross(direction()).normalized());
    const double edge_m = 0.1 + 0.1 * unit(random);
    const Vector3d centre =
        first.centre + direction() * ratio * (1 + 0.1 * unit(random)) * first.size_m;
    const Facet other = facet(centre, edge_m * u, edge_m * (1 + 2 * unit(random)) * normal.cross(u),
                              facets.size() % 4 == 0);
    const auto faces = [](const Facet& a, const Facet& b) {
      return std::all_of(b.vertices.begin(), b.vertices.end(),
                         [&](const Vector3d& v) { return a.plane().height_m(v) > 0; });
    };
    const bool far = (other.centre - first.centre).norm() >= ratio * first.size_m;
    if (other.size_m <= first.size_m && far && faces(first, other) && faces(other, first)) {
      facets.push_back(other);
    }
  }
  return facets;
}

// What a pair of the assembly leaves: its rule's error, as estimated, and one rounding to float.
TEST(FarField, KeepsTheEstimatedErrorAndOneRoundingAtEverySwitch) {
  constexpr double kRounding = 7e-8;
  std::mt19937 random(5);
  for (const double ratio : {7.0, 9.0, 12.7, 14.0, 20.0, 63.6, 70.0, 100.0}) {
    for (const bool aligned : {true, false}) {
      const std::vector<Facet> facets = around_first(ratio, aligned, random);
      const FarField far(facets);
      FarRow row;
      far.start(0, 0, row);
      std::array<int, kFarPatches> order{};
      for (std::size_t j = 1; j < kFarPatches; ++j)
        order[j] = far_field_order(row.distance_over_size[j]);
      std::array<float, kFarPatches> exchange_area_m2{};
      far.exchange(row, order, exchange_area_m2.data());
      EXPECT_EQ(exchange_area_m2[0], 0);
      for (std::size_t j = 1; j < kFarPatches; ++j) {
        const Facet &a = facets[0], &b = facets[j];
        const double exact =
            far_exchange(quadrature(a.vertices, 6), a.normal, quadrature(b.vertices, 6), b.normal);
        EXPECT_NEAR(static_cast<double>(exchange_area_m2[j]), exact,
                    exchange_error_m2(a, b) + kRounding * exact)
            << ratio << " " << aligned << " " << j;
      }
    }
  }
}

// Rounding level: what is stored of rectangles with edges along common axes and sides of 1 to 3.
TEST(FarField, RectanglesAlongCommonAxesKeepRoundingToFloat) {
  std::mt19937 random(6);
  for (const double ratio : {7.0, 14.0, 70.0}) {
    std::vector<Facet> facets = around_first(ratio, true, random);
    std::erase_if(facets, [](const Facet& f) { return !f.rectangle; });
    const FarField far(facets);
    FarRow row;
    far.start(0, 0, row);
    std::array<int, kFarPatches> order{};
    for (std::size_t j = 1; j < facets.size(); ++j) {
      order[j] = far_field_order(row.distance_over_size[j]);
    }
    std::array<float, kFarPatches> exchange_area_m2{};
    far.exchange(row, order, exchange_area_m2.data());
    for (std::size_t j = 1; j < facets.size(); ++j) {
      const double exact = far_exchange(quadrature(facets[0].vertices, 6), facets[0].normal,
                                        quadrature(facets[j].vertices, 6), facets[j].normal);
      EXPECT_NEAR(static_cast<double>(exchange_area_m2[j]) / exact, 1, 1.2e-7) << ratio << " " << j;
    }
  }
}

}  // namespace
}  // namespace solver
