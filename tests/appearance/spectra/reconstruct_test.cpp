#include "appearance/spectra/reconstruct.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "appearance/spectra/illuminants.h"

namespace spectra {
namespace {

const Spectrum& light_c() {
  static const Spectrum light = light_on(kTransportGrid, illuminant("C"));
  return light;
}

void expect_same(const RelativeXyz& a, const RelativeXyz& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

double squared_slope(const Eigen::ArrayXd& rho) {
  const Eigen::ArrayXd z = (2 * rho - 1).unaryExpr([](double v) { return std::atanh(v); });
  return (z.tail(z.size() - 1) - z.head(z.size() - 1)).square().sum();
}

// A flat curve has no slope, so it is the smoothest one of its colour.
TEST(ReconstructReflectance, GreyIsFlat) {
  for (const double level : {0.001, 0.2, 0.5, 0.9, 0.999}) {
    const RelativeXyz grey = relative_xyz(constant(kTransportGrid, level), light_c());
    const Reconstruction r = reconstruct_reflectance(grey, light_c());
    ASSERT_TRUE(r.converged) << level;
    EXPECT_TRUE(r.reflectance.values.isApproxToConstant(level, 1e-9)) << level;
  }
}

TEST(ReconstructReflectance, HasTheColourAndIsSmootherThanTheCurveItCameFrom) {
  Spectrum paint = constant(kTransportGrid, 0);
  for (int k = 0; k < 31; ++k) paint.values[k] = 0.4 + 0.3 * std::sin(0.4 * k) + 0.005 * k;
  const RelativeXyz xyz = relative_xyz(paint, light_c());
  const Reconstruction r = reconstruct_reflectance(xyz, light_c());
  ASSERT_TRUE(r.converged);
  expect_same(relative_xyz(r.reflectance, light_c()), xyz, 1e-9);
  EXPECT_LT(squared_slope(r.reflectance.values), squared_slope(paint.values));
}

TEST(ReconstructReflectance, WorksAtOneNanometre) {
  const Spectrum light = light_on(kClosedFormGrid, illuminant("E"));
  const RelativeXyz xyz{.x = 30, .y = 20, .z = 10};
  const Reconstruction r = reconstruct_reflectance(xyz, light);
  ASSERT_TRUE(r.converged);
  expect_same(relative_xyz(r.reflectance, light), xyz, 1e-9);
}

TEST(ReconstructReflectance, ImpossibleColoursDoNotConverge) {
  const double nan = std::nan("");
  for (const RelativeXyz& xyz :
       {RelativeXyz{100, 120, 100}, RelativeXyz{90, 20, 5}, RelativeXyz{-1, 10, 10},
        RelativeXyz{nan, 20, 20}, RelativeXyz{INFINITY, 20, 20}}) {
    EXPECT_FALSE(reconstruct_reflectance(xyz, light_c()).converged) << xyz.x;
  }
  EXPECT_THROW((void)reconstruct_reflectance({20, 20, 20}, constant(kTransportGrid, 0)),
               std::invalid_argument);
}

// 9^3 colours of the cube, saturated corners and the darkest and lightest 8-bit steps included.
TEST(ReconstructSrgb, ReachesTheWholeCubeButWhite) {
  const std::vector<double> levels{0, 1, 2, 30, 80, 128, 200, 254, 255};
  for (const double r : levels) {
    for (const double g : levels) {
      for (const double b : levels) {
        const Reconstruction c = reconstruct_srgb(r / 255, g / 255, b / 255);
        const bool is_white = r + g + b == 3 * 255;
        EXPECT_EQ(c.converged, !is_white) << r << " " << g << " " << b;
        if (!c.converged) continue;
        EXPECT_GE(c.reflectance.values.minCoeff(), 0);
        EXPECT_LT(c.reflectance.values.maxCoeff(), 1);
      }
    }
  }
}

// IEC 61966-2-1: linear below 0.04045 with slope 1/12.92, 0.5 stands for 0.214041.
TEST(ReconstructSrgb, GreysAreFlatAtTheirLinearValue) {
  EXPECT_TRUE(
      reconstruct_srgb(0.5, 0.5, 0.5).reflectance.values.isApproxToConstant(0.214041, 1e-6));
  EXPECT_TRUE(
      reconstruct_srgb(0.04, 0.04, 0.04).reflectance.values.isApproxToConstant(0.04 / 12.92, 1e-9));
  EXPECT_TRUE(reconstruct_srgb(0, 0, 0).reflectance.values.isZero(0));
}

// The luminances of the primaries in the standard, to its four digits; 1e-3 because the white here
// is that of 31 bands, not (0.3127, 0.3290).
TEST(ReconstructSrgb, PrimariesHaveTheirLuminance) {
  const Spectrum d65 = light_on(kTransportGrid, illuminant("D65"));
  EXPECT_NEAR(relative_xyz(reconstruct_srgb(1, 0, 0).reflectance, d65).y, 21.26, 0.1);
  EXPECT_NEAR(relative_xyz(reconstruct_srgb(0, 1, 0).reflectance, d65).y, 71.52, 0.1);
  EXPECT_NEAR(relative_xyz(reconstruct_srgb(0, 0, 1).reflectance, d65).y, 7.22, 0.1);
}

TEST(ReconstructSrgb, ComponentsOutOfRangeAreRefused) {
  EXPECT_THROW((void)reconstruct_srgb(-0.1, 0, 0), std::invalid_argument);
  EXPECT_THROW((void)reconstruct_srgb(0, 1.1, 0), std::invalid_argument);
  EXPECT_THROW((void)reconstruct_srgb(0, 0, std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace spectra
