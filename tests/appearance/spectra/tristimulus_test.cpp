#include "appearance/spectra/tristimulus.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "appearance/spectra/cie_tables.h"
#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/photometry.h"

namespace spectra {
namespace {

TEST(RelativeXyz, PerfectDiffuserHasYOfHundredUnderEveryIlluminant) {  // [Neumann2004] eq. 5-6
  for (const Grid& grid : {kTransportGrid, kClosedFormGrid}) {
    for (const std::string& name : illuminant_names()) {
      const Spectrum light = light_on(grid, illuminant(name));
      EXPECT_NEAR(relative_xyz(constant(grid, 1), light).y, 100, 1e-12) << name;
      EXPECT_NEAR(relative_xyz(constant(grid, 0.18), light).y, 18, 1e-12) << name;
    }
  }
}

TEST(RelativeXyz, IsTheAbsoluteColourDividedByItsWhite) {
  const Spectrum light = light_on(kTransportGrid, planck(3000));
  Spectrum reflectance = constant(kTransportGrid, 0);
  reflectance.values.setLinSpaced(0.1, 0.9);
  const Xyz seen = absolute_xyz({kTransportGrid, light.values * reflectance.values});
  const RelativeXyz expected = relative_xyz(seen, absolute_xyz(light).y);
  const RelativeXyz xyz = relative_xyz(reflectance, light);
  EXPECT_NEAR(xyz.x, expected.x, 1e-12);  // of 100
  EXPECT_NEAR(xyz.y, expected.y, 1e-12);
  EXPECT_NEAR(xyz.z, expected.z, 1e-12);
}

// One watt in the band of 560 nm: 683 V lumen, whatever the step.
TEST(AbsoluteXyz, OneWattGivesItsEfficacy) {
  Spectrum light = constant(kTransportGrid, 0);
  light.values[16] = 0.1;
  EXPECT_NEAR(absolute_xyz(light).y, 683 * 0.995, 1e-10);
}

TEST(Chromaticity, OfEqualEnergyIsAThirdAndOfBlackZero) {
  // The three areas of the table differ by 3e-4.
  const Chromaticity e = chromaticity(absolute_xyz(constant(kClosedFormGrid, 1)));
  EXPECT_NEAR(e.x, 1.0 / 3, 1e-4);
  EXPECT_NEAR(e.y, 1.0 / 3, 1e-4);
  const Chromaticity black = chromaticity(RelativeXyz{});
  EXPECT_EQ(black.x, 0);
  EXPECT_EQ(black.y, 0);
}

TEST(Photometry, ScaledLightHasTheAmountAndItsShape) {
  const Spectrum shape = light_on(kTransportGrid, illuminant("A"));
  for (const double amount : {1e-3, 500.0, 1e5}) {
    const Spectrum light = scaled_to_luminous(shape, amount);
    EXPECT_NEAR(luminous(light) / amount, 1, 1e-14);
    EXPECT_NEAR(light.values[0] / light.values[30], shape.values[0] / shape.values[30], 1e-15);
  }
  EXPECT_EQ(luminous(scaled_to_luminous(shape, 0)), 0);
}

TEST(Photometry, ImpossibleAmountsAreRefused) {
  const Spectrum shape = constant(kTransportGrid, 1);
  EXPECT_THROW((void)scaled_to_luminous(shape, -1), std::invalid_argument);
  EXPECT_THROW((void)scaled_to_luminous(shape, std::nan("")), std::invalid_argument);
  EXPECT_THROW((void)scaled_to_luminous(shape, INFINITY), std::invalid_argument);
  EXPECT_THROW((void)scaled_to_luminous(constant(kTransportGrid, 0), 1), std::invalid_argument);
}

TEST(Tristimulus, MismatchedSpectraAreRefused) {
  const Spectrum bands = constant(kTransportGrid, 1), fine = constant(kClosedFormGrid, 1);
  EXPECT_THROW((void)relative_xyz(bands, fine), std::invalid_argument);
  EXPECT_THROW((void)relative_xyz(bands, constant(kTransportGrid, 0)), std::invalid_argument);
  EXPECT_THROW((void)relative_xyz(Xyz{}, 0), std::invalid_argument);
  EXPECT_THROW((void)absolute_xyz({kTransportGrid, Eigen::ArrayXd::Ones(3)}),
               std::invalid_argument);
}

}  // namespace
}  // namespace spectra
