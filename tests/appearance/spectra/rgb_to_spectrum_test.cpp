#include "appearance/spectra/rgb_to_spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/spectrum_library.h"

namespace spectra {
namespace {

using Eigen::ArrayXd, Eigen::Vector3d;

const SmitsBasis& srgb_basis() {
  static const SmitsBasis basis = smits_basis(rgb_space("srgb"), kTransportGrid);
  return basis;
}

const Spectrum& d65() {
  static const Spectrum light = light_on(kTransportGrid, illuminant("D65"));
  return light;
}

RelativeXyz xyz_of_srgb(const Vector3d& rgb) {
  const Vector3d xyz = 100 * xyz_from_rgb_on(kTransportGrid, rgb_space("srgb")) * rgb;
  return {.x = xyz[0], .y = xyz[1], .z = xyz[2]};
}

void expect_colour(const Spectrum& reflectance, const Vector3d& rgb, double tolerance) {
  const Vector3d is = rgb_of_reflectance(rgb_space("srgb"), reflectance);
  EXPECT_LT((is - rgb).cwiseAbs().maxCoeff(), tolerance) << is.transpose();
}

double squared_slope(const ArrayXd& rho) {
  return (rho.tail(rho.size() - 1) - rho.head(rho.size() - 1)).square().sum();
}

TEST(SmitsBasis, HasItsColoursWithinBounds) {
  for (int c = 0; c < 3; ++c) {
    const Spectrum& primary = srgb_basis()[static_cast<std::size_t>(c)];
    expect_colour(primary, Vector3d::Unit(c), 1e-12);
    EXPECT_GE(primary.values.minCoeff(), -1e-12);
    EXPECT_LE(primary.values.maxCoeff(), 1 + 1e-12);
  }
}

// The set of curves of one colour is convex, so a mixture of two is one more candidate.
TEST(SmitsBasis, IsSmootherThanOtherCurvesOfItsColours) {
  for (int c = 0; c < 3; ++c) {
    const ArrayXd primary = srgb_basis()[static_cast<std::size_t>(c)].values;
    const RelativeXyz xyz = xyz_of_srgb(Vector3d::Unit(c));
    for (const Reconstruction& r :
         {reconstruct_reflectance(xyz, d65()), reconstruct_sigmoid(xyz, d65())}) {
      ASSERT_TRUE(r.converged);
      for (const double share : {1., 0.1, 1e-3}) {
        const ArrayXd other = share * r.reflectance.values + (1 - share) * primary;
        EXPECT_GT(squared_slope(other), squared_slope(primary)) << c << " " << share;
      }
    }
  }
}

TEST(SmitsBasis, NeedsPrimariesThatAReflectanceCanHave) {
  EXPECT_THROW((void)smits_basis(rgb_space("bt2020"), kTransportGrid), std::invalid_argument);
}

TEST(SmitsReflectance, HasTheColourAndGreyIsFlat) {
  for (const Vector3d& rgb :
       {Vector3d(0.2, 0.5, 0.9), Vector3d(0.9, 0.2, 0.5), Vector3d(0.5, 0.9, 0.2),
        Vector3d(0.3, 0.3, 0.8), Vector3d(0.8, 0.3, 0.8), Vector3d(-0.1, 0.4, 0.6)}) {
    const Spectrum rho = smits_reflectance(srgb_basis(), rgb);
    expect_colour(rho, rgb, 1e-12);
    if (rgb.minCoeff() >= 0) {
      EXPECT_GE(rho.values.minCoeff(), 0);
      EXPECT_LE(rho.values.maxCoeff(), 1);
    }
  }
  const Spectrum grey = smits_reflectance(srgb_basis(), Vector3d::Constant(0.4));
  EXPECT_TRUE(grey.values.isApproxToConstant(0.4, 1e-15));
}

// Done by hand: x = -0.4 at 400 nm, 0 at 500 nm, -1.4 at 600 nm.
TEST(SigmoidSpectrum, IsTheSigmoidOfAQuadratic) {
  const Grid grid{.first_nm = 400, .step_nm = 100, .count = 3};
  const Spectrum rho = sigmoid_spectrum(grid, {-9e-5, 8.5e-2, -20});
  EXPECT_NEAR(rho.values[0], 0.5 - 0.2 / std::sqrt(1.16), 1e-14);
  EXPECT_NEAR(rho.values[1], 0.5, 1e-14);
  EXPECT_NEAR(rho.values[2], 0.5 - 0.7 / std::sqrt(2.96), 1e-14);
}

TEST(ReconstructSigmoid, FindsTheSigmoidAgain) {
  for (const Vector3d& c : {Vector3d(-9e-5, 8.5e-2, -20), Vector3d(3e-4, -0.33, 90),
                            Vector3d(0, 0, 0.7), Vector3d(0, 0.03, -17)}) {
    const Spectrum truth = sigmoid_spectrum(kTransportGrid, c);
    const Reconstruction r = reconstruct_sigmoid(relative_xyz(truth, d65()), d65());
    ASSERT_TRUE(r.converged);
    EXPECT_LT((r.reflectance.values - truth.values).abs().maxCoeff(), 1e-7) << c.transpose();
  }
}

TEST(ReconstructSigmoid, HasTheColourOfEveryPaperAndOfTheSrgbCube) {
  for (const NamedSpectrum& paper : atlas("munsell-nickerson").entries) {
    const RelativeXyz xyz = relative_xyz(reflectance_on(kTransportGrid, paper.samples), d65());
    const Reconstruction r = reconstruct_sigmoid(xyz, d65());
    ASSERT_TRUE(r.converged) << paper.name;
    EXPECT_NEAR(relative_xyz(r.reflectance, d65()).x, xyz.x, 1e-9);
    EXPECT_NEAR(relative_xyz(r.reflectance, d65()).z, xyz.z, 1e-9);
  }
  for (int i = 0; i < 125; ++i) {
    const Vector3d rgb = Vector3d(i / 25, i / 5 % 5, i % 5) * 0.24 + Vector3d::Constant(0.02);
    const Reconstruction r = reconstruct_sigmoid(xyz_of_srgb(rgb), d65());
    ASSERT_TRUE(r.converged) << rgb.transpose();
    expect_colour(r.reflectance, rgb, 1e-10);
  }
}

TEST(ReconstructSigmoid, ImpossibleColoursDoNotConverge) {
  EXPECT_FALSE(reconstruct_sigmoid({.x = 100, .y = 120, .z = 100}, d65()).converged);
  EXPECT_FALSE(reconstruct_sigmoid({.x = 90, .y = 20, .z = 5}, d65()).converged);
  EXPECT_FALSE(reconstruct_sigmoid({.x = std::nan(""), .y = 20, .z = 5}, d65()).converged);
  EXPECT_THROW((void)reconstruct_sigmoid({}, constant(kTransportGrid, 0)), std::invalid_argument);
}

}  // namespace
}  // namespace spectra
