// [Neumann2004] on the cube: the opening example, and the closed form of section 4.3.
#include <gmock/gmock.h>

#include <Eigen/Dense>

#include "solver/judges/closed_form.h"

namespace solver {
namespace {

// Section 1: walls of (0.95, 0.90, 0.80) turn the light of a lamp into (19, 9, 4) by
// interreflection, the geometric series rho + rho^2 + ... In a cube that emits 1 everywhere that is
// what B holds beyond the lamp itself.
TEST(Neumann2004, WarmWhiteWallsMakeSaturatedOrange) {
  Parts reflectance(6, 3);
  reflectance.rowwise() = Eigen::Array3d(0.95, 0.90, 0.80).transpose();
  const Parts lamp = Parts::Ones(6, 3);
  for (const CubeFactors& factors : {CubeFactors{}, exact_cube_factors()}) {
    const Parts reflected = cube_radiosity(lamp, reflectance, factors) - lamp;
    for (int i = 0; i < 6; ++i) {
      EXPECT_NEAR(reflected(i, 0), 19, 1e-12);
      EXPECT_NEAR(reflected(i, 1), 9, 1e-12);
      EXPECT_NEAR(reflected(i, 2), 4, 1e-12);
    }
  }
}

Parts column(std::array<double, 6> values) { return Eigen::Map<Parts>(values.data(), 6, 1); }

struct Example {
  Parts reflectance, emission, radiosity;
};

/// Eq. 15-16 with 0.2, evaluated once by an independent program in double precision.
std::vector<Example> examples() {
  return {{column({0.9430561055723676, 0.5113275528143616, 0.9762437057077041, 0.08083602389560218,
                   0.6073558319950296, 0.37648658437727256}),
           column({4.009506034929037, 0, 0, 2.719707003817491, 0, 0}),
           column({5.828852064170681, 1.435720177840345, 2.527881894649982, 2.9226413525747934,
                   1.6761462952152477, 1.083621892875092})},
          {column({0.1776925857619811, 0.6088516168445476, 0.7048647455647425, 0.9428036791291672,
                   0.6656574169657534, 0.13339575545169313}),
           column({2.4893379939268723, 0, 0, 4.792911430546236, 1.749686999111274, 0}),
           column({3.0387018965613284, 2.007881551848456, 2.2853936364910843, 6.967009198585792,
                   3.7173232119722055, 0.4806598431196496})}};
}

TEST(Neumann2004, CubeOfEquations15And16) {
  for (const Example& e : examples()) {
    const Parts found = cube_radiosity(e.emission, e.reflectance);
    EXPECT_LT((found / e.radiosity - 1).abs().maxCoeff(), 1e-14);
    // Eq. 13 itself: (I - 0.2 rho (ones - I)) B = S.
    const Parts arriving = 0.2 * (found.sum() - found);
    EXPECT_LT((found - e.reflectance * arriving - e.emission).abs().maxCoeff(), 1e-14);
  }
}

// Section 4.3 calls 0.2 "a very good approximation": over random cubes B differs by up to 8.5e-4.
TEST(Neumann2004, APointTwoIsAGoodApproximation) {
  for (const Example& e : examples()) {
    const Parts exact = cube_radiosity(e.emission, e.reflectance, exact_cube_factors());
    const double difference = (exact / e.radiosity - 1).abs().maxCoeff();
    EXPECT_LT(difference, 8.5e-4);
    EXPECT_GT(difference, 1e-6);
  }
}

}  // namespace
}  // namespace solver
