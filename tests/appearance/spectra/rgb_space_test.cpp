#include "appearance/spectra/rgb_space.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/tristimulus.h"

namespace spectra {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

void expect_near(const Vector3d& a, const Vector3d& b, double tolerance) {
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), tolerance) << a.transpose() << " | " << b.transpose();
}

// IEC 61966-2-1, four decimals; ITU-R BT.2020 table 4, four decimals of the luminance.
TEST(RgbSpace, MatricesAreThePublishedOnes) {
  Matrix3d srgb;
  srgb << 0.4124, 0.3576, 0.1805,  //
      0.2126, 0.7152, 0.0722,      //
      0.0193, 0.1192, 0.9505;
  EXPECT_LT((rgb_space("srgb").xyz_from_rgb - srgb).cwiseAbs().maxCoeff(), 6e-5);
  expect_near(rgb_space("bt2020").xyz_from_rgb.row(1), {0.2627, 0.6780, 0.0593}, 6e-5);
  expect_near(rgb_space("acescg").xyz_from_rgb.row(1), {0.2722287168, 0.6740817658, 0.0536895174},
              1e-9);
}

TEST(RgbSpace, WhiteIsOneOneOneWithUnitLuminance) {
  for (const RgbSpace& space : rgb_spaces()) {
    const Xyz white = absolute_xyz(light_on(kClosedFormGrid, space.white));
    // The white of ACES is close to daylight, not on its locus.
    expect_near(space.xyz_from_rgb * Vector3d::Ones(),
                Vector3d(white.x, white.y, white.z) / white.y, 1e-3);
    EXPECT_NEAR(space.xyz_from_rgb.row(1).sum(), 1, 1e-14) << space.name;
  }
}

TEST(RgbSpace, GreyUnderWhiteIsGreyOnEveryGrid) {
  const Grid nine{.first_nm = 400, .step_nm = 37, .count = 9};
  for (const RgbSpace& space : rgb_spaces()) {
    for (const Grid& grid : {kTransportGrid, kClosedFormGrid, nine}) {
      const Spectrum white = light_on(grid, space.white);
      const double y = absolute_xyz(white).y;
      expect_near(rgb_of_light(space, white) / y, Vector3d::Ones(), 1e-12);
      expect_near(rgb_of_reflectance(space, constant(grid, 0.3)), Vector3d::Constant(0.3), 1e-12);
    }
  }
}

TEST(RgbSpace, LightGoesToXyzAndBack) {
  const Spectrum lamp = light_on(kTransportGrid, illuminant("A"));
  const Xyz xyz = absolute_xyz(lamp);
  for (const RgbSpace& space : rgb_spaces()) {
    expect_near(xyz_from_rgb_on(kTransportGrid, space) * rgb_of_light(space, lamp) / xyz.y,
                Vector3d(xyz.x, xyz.y, xyz.z) / xyz.y, 1e-12);
  }
}

TEST(RgbSpace, UnknownNameIsAnsweredWithTheKnownOnes) {
  try {
    (void)rgb_space("adobe");
    FAIL() << "accepted";
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(), "no RGB space \"adobe\"; there are srgb, bt2020, acescg, xyz, iso");
  }
}

}  // namespace
}  // namespace spectra
