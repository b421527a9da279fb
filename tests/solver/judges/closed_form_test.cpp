#include "solver/judges/closed_form.h"

#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <limits>
#include <random>

#include "tests/solver/office_brick.h"

namespace solver {
namespace {

using Matrix10 = Eigen::Matrix<double, 10, 10>;

/// One column per wavelength, values in 0..0.999.
Parts random_parts(Eigen::Index parts, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 0.999);
  return Parts::NullaryExpr(parts, 25, [&] { return uniform(random); });
}

/// Eq. 13 as it stands, solved directly.
Parts solve(const Eigen::MatrixXd& factors, const Parts& emission, const Parts& reflectance) {
  Parts radiosity(emission.rows(), emission.cols());
  for (Eigen::Index k = 0; k < emission.cols(); ++k) {
    const Eigen::MatrixXd bounces = reflectance.col(k).matrix().asDiagonal() * factors;
    const Eigen::MatrixXd system =
        Eigen::MatrixXd::Identity(factors.rows(), factors.rows()) - bounces;
    radiosity.col(k) = system.fullPivLu().solve(emission.col(k).matrix());
  }
  return radiosity;
}

Eigen::MatrixXd cube_matrix(const CubeFactors& f) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Constant(6, 6, f.adjacent);
  for (Eigen::Index i = 0; i < 6; ++i) {
    matrix(i, i) = 0;
    matrix(i, i ^ 1) = f.opposite;
  }
  return matrix;
}

TEST(CubeFactors, OfTheUnitCube) {
  const CubeFactors exact = exact_cube_factors();
  EXPECT_NEAR(exact.opposite, 0.19982489569838746, 1e-15);
  EXPECT_NEAR(exact.adjacent, 0.20004377607540316, 1e-15);
}

TEST(CubeRadiosity, SolvesTheSystemOfEquation13) {
  const Parts emission = random_parts(6, 1), reflectance = random_parts(6, 2);
  for (const CubeFactors& factors : {CubeFactors{}, exact_cube_factors()}) {
    const Parts expected = solve(cube_matrix(factors), emission, reflectance);
    const Parts found = cube_radiosity(emission, reflectance, factors);
    EXPECT_LT(((found - expected) / expected).abs().maxCoeff(), 1e-13);
  }
}

TEST(CubeRadiosity, FurnaceIsWhite) {
  const Parts reflectance = random_parts(6, 3);
  const Parts found = cube_radiosity(1 - reflectance, reflectance, exact_cube_factors());
  EXPECT_LT((found - 1).abs().maxCoeff(), 1e-13);
}

TEST(CubeRadiosity, BlackCubeOnlyEmits) {
  const Parts emission = random_parts(6, 4);
  EXPECT_TRUE((cube_radiosity(emission, 0 * emission) == emission).all());
}

TEST(CubeRadiosity, RefusesWhatHasNoAnswer) {
  const Parts good = Parts::Constant(6, 2, 0.5);
  Parts bad = good;
  for (const double rho : {1.0, 1.5, -0.1, std::numeric_limits<double>::quiet_NaN()}) {
    bad(3, 1) = rho;
    EXPECT_THROW((void)cube_radiosity(good, bad), std::invalid_argument) << rho;
  }
  for (const double s : {-0.1, std::numeric_limits<double>::infinity()}) {
    bad(3, 1) = s;
    EXPECT_THROW((void)cube_radiosity(bad, good), std::invalid_argument) << s;
  }
  EXPECT_THROW((void)cube_radiosity(Parts::Zero(5, 2), good), std::invalid_argument);
  EXPECT_THROW((void)cube_radiosity(Parts::Zero(6, 1), good), std::invalid_argument);
}

std::vector<BrickShape> shapes() {
  BrickShape no_furniture = kOffice, no_window = kOffice, glass_wall = kOffice, corner = kOffice,
             slit = kOffice, corridor = kOffice, shaft = kOffice;
  no_furniture.furniture_height = 0;
  no_window.window_width_m = 0;
  glass_wall.window_width_m = 5, glass_wall.window_offset_m = 0;
  glass_wall.window_height_m = 2.7, glass_wall.window_sill_m = 0;
  corner.window_offset_m = 3, corner.window_sill_m = 1.3;
  slit.window_width_m = 0.01;
  corridor.depth_m = 50;
  shaft.height_m = 100, shaft.furniture_height = 0.01;
  return {kOffice, no_furniture, no_window, glass_wall, corner, slit, corridor, shaft};
}

class EveryBrick : public testing::TestWithParam<BrickShape> {
 protected:
  const Matrix10 factors_ = brick_form_factors(GetParam());
  const Eigen::Array<double, 10, 1> area_m2_ = brick_areas_m2(GetParam());
};

INSTANTIATE_TEST_SUITE_P(Shapes, EveryBrick, testing::ValuesIn(shapes()));

TEST_P(EveryBrick, RowsSumToOne) {
  for (int i = 0; i < 10; ++i) {
    EXPECT_NEAR(factors_.row(i).sum(), area_m2_[i] > 0 ? 1 : 0, 1e-13) << i;
  }
  EXPECT_GE(factors_.minCoeff(), 0);
}

TEST_P(EveryBrick, IsReciprocal) {
  const Matrix10 exchange = area_m2_.matrix().asDiagonal() * factors_;
  EXPECT_LT((exchange - exchange.transpose()).cwiseAbs().maxCoeff(), 1e-14 * area_m2_.maxCoeff());
}

TEST_P(EveryBrick, AreasCoverTheBrick) {
  const BrickShape& s = GetParam();
  const double surface =
      2 * (s.width_m * s.depth_m + s.depth_m * s.height_m + s.height_m * s.width_m);
  EXPECT_NEAR(area_m2_.sum(), surface, 1e-14 * surface);
}

TEST_P(EveryBrick, AbsorbsWhatItEmits) {
  const Parts emission = random_parts(10, 5), rho = random_parts(10, 6);
  const Parts radiosity = brick_radiosity(GetParam(), emission, rho);
  const Parts irradiance = (factors_ * radiosity.matrix()).array();
  const Eigen::ArrayXXd emitted = (emission.colwise() * area_m2_).colwise().sum();
  const Eigen::ArrayXXd absorbed = (((1 - rho) * irradiance).colwise() * area_m2_).colwise().sum();
  EXPECT_LT((absorbed / emitted - 1).abs().maxCoeff(), 1e-12);
}

TEST_P(EveryBrick, FurnaceIsWhite) {
  Parts reflectance = random_parts(10, 7);
  const Parts radiosity = brick_radiosity(GetParam(), 1 - reflectance, reflectance);
  for (int i = 0; i < 10; ++i) {
    if (area_m2_[i] > 0) {
      EXPECT_LT((radiosity.row(i) - 1).abs().maxCoeff(), 1e-12) << i;
    }
  }
}

TEST(BrickFormFactors, OfACubeAreThoseOfTheCube) {
  const Matrix10 factors = brick_form_factors({.width_m = 3, .depth_m = 3, .height_m = 3});
  const CubeFactors cube = exact_cube_factors();

  enum { kFloor, kCeiling, kWindowWall, kWindow, kWall1, kWall2, kWall3 };

  EXPECT_NEAR(factors(kFloor, kCeiling), cube.opposite, 1e-14);
  EXPECT_NEAR(factors(kWindowWall, kWall2), cube.opposite, 1e-14);
  EXPECT_NEAR(factors(kWall3, kWall1), cube.opposite, 1e-14);
  EXPECT_NEAR(factors(kFloor, kWall3), cube.adjacent, 1e-14);
  EXPECT_NEAR(factors(kWindowWall, kWall1), cube.adjacent, 1e-14);
  EXPECT_EQ(factors(kFloor, kWindow), 0);
}

// Additivity: furniture strips and window are parts of whole walls.
TEST(BrickFormFactors, PartsAddUpToWholeWalls) {
  BrickShape parted = shapes()[0], whole = parted;
  whole.furniture_height = 0;
  whole.window_width_m = 0;
  const Matrix10 f = brick_form_factors(parted), g = brick_form_factors(whole);
  EXPECT_NEAR(f(0, 2) + f(0, 3), g(0, 2), 1e-13);  // floor to window wall
  for (int wall = 4; wall < 7; ++wall) {
    EXPECT_NEAR(f(0, wall) + f(0, wall + 3), g(0, wall), 1e-13) << wall;
    EXPECT_NEAR(f(1, wall) + f(1, wall + 3), g(1, wall), 1e-13) << wall;
  }
}

// A window next to the right-hand corner sees the right-hand wall as much as its mirror image
// sees the left-hand one.
TEST(BrickFormFactors, MirrorImagesAgree) {
  BrickShape right = shapes()[0];
  right.window_offset_m = 2.9;
  BrickShape left = right;
  left.window_offset_m = 0.1;
  const Matrix10 f = brick_form_factors(right), g = brick_form_factors(left);
  EXPECT_NEAR(f(3, 4), g(3, 6), 1e-14);
  EXPECT_NEAR(f(3, 7), g(3, 9), 1e-14);
  EXPECT_GT(f(3, 4), 2 * f(3, 6));
}

TEST(BrickRadiosity, OfACubeIsThatOfTheCube) {
  const BrickShape shape{.width_m = 2, .depth_m = 2, .height_m = 2};
  const std::array brick{6, 4, 2, 5, 0, 1};  // the parts in the order x0, x1, y0, y1, z0, z1
  const Parts emission = random_parts(6, 8), reflectance = random_parts(6, 9);
  Parts s = Parts::Zero(10, emission.cols()), rho = s;
  s(brick, Eigen::all) = emission;
  rho(brick, Eigen::all) = reflectance;
  const Parts found = brick_radiosity(shape, s, rho)(brick, Eigen::all);
  const Parts expected = cube_radiosity(emission, reflectance, exact_cube_factors());
  EXPECT_LT((found / expected - 1).abs().maxCoeff(), 1e-12);
}

TEST(BrickRadiosity, RefusesShapesThatAreNoBrick) {
  const Parts parts = Parts::Constant(10, 1, 0.5);
  const auto refuses = [&](auto change) {
    BrickShape bad = kOffice;
    change(bad);
    EXPECT_THROW((void)brick_form_factors(bad), std::invalid_argument);
    EXPECT_THROW((void)brick_areas_m2(bad), std::invalid_argument);
    EXPECT_THROW((void)brick_radiosity(bad, parts, parts), std::invalid_argument);
  };
  refuses([](BrickShape& s) { s.width_m = 0; });
  refuses([](BrickShape& s) { s.depth_m = -4; });
  refuses([](BrickShape& s) { s.height_m = std::numeric_limits<double>::infinity(); });
  refuses([](BrickShape& s) { s.furniture_height = 1; });
  refuses([](BrickShape& s) { s.furniture_height = std::numeric_limits<double>::quiet_NaN(); });
  refuses([](BrickShape& s) { s.window_offset_m = 3.1; });
  refuses([](BrickShape& s) { s.window_sill_m = -0.1; });
  EXPECT_THROW((void)brick_radiosity(kOffice, Parts::Zero(9, 1), parts), std::invalid_argument);
}

}  // namespace
}  // namespace solver
