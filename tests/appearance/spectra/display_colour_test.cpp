#include "appearance/spectra/display_colour.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/spectrum_library.h"
#include "appearance/spectra/tristimulus.h"

namespace spectra {
namespace {

using Eigen::Array3d, Eigen::ArrayXd, Eigen::Matrix3d, Eigen::Matrix3Xd, Eigen::MatrixXd,
    Eigen::Vector3d;

ArrayXd paper(const char* name) {
  return reflectance_on(kTransportGrid, find_paint(name).spectrum->samples).values;
}

ArrayXd lamp(const char* name) { return light_on(kTransportGrid, illuminant(name)).values; }

Matrix3Xd srgb_matching() { return rgb_matching(rgb_space("srgb"), kTransportGrid); }

DisplayConversion srgb_conversion() {
  return least_squares_conversion(srgb_matching(), room_lights_second_moment());
}

TEST(DisplayConversion, ThreeComponentsConvertExactly) {
  Matrix3d a;  // a display that mixes its reference
  a << 0.9, 0.2, -0.1, 0.05, 0.8, 0.1, 0, 0.1, 0.7;
  const Array3d object(0.7, 0.3, 0.1), light(1, 2, 3);
  const DisplayConversion c = three_component_conversion(a);
  const Vector3d reflected = a * (object * light).matrix();
  const Matrix3d colour = object_matrix(c, object);
  EXPECT_LT((colour * (a * light.matrix()) - reflected).norm(), 1e-14);
  EXPECT_LT((colour - a * object.matrix().asDiagonal() * a.inverse()).norm(), 1e-14);
  // L = L_ref: one reflection of light that is still in the reference.
  const Matrix3d direct = object_matrix_for_reference_light(a, object);
  EXPECT_LT((direct * light.matrix() - reflected).norm(), 1e-14);
}

// Lights that span three dimensions leave nothing to approximate, whatever the number of bands.
TEST(DisplayConversion, IsExactForALinearModelOfThreeLights) {
  MatrixXd lights(31, 3);
  lights << lamp("A").matrix(), lamp("D65").matrix(), lamp("E").matrix();
  const DisplayConversion c =
      least_squares_conversion(srgb_matching(), lights * lights.transpose());
  const ArrayXd object = paper("munsell-nickerson:117");
  for (const Vector3d& mix : {Vector3d(1, 0, 0), Vector3d(0.2, 0.5, 3)}) {
    const Eigen::VectorXd light = lights * mix;
    const Vector3d truth = srgb_matching() * (object * light.array()).matrix();
    const Vector3d matrix = object_matrix(c, object) * (srgb_matching() * light);
    EXPECT_LT((matrix - truth).norm(), 1e-9 * truth.norm());
  }
}

TEST(DisplayConversion, IsTheLeastSquaresSolutionOverTheLights) {
  MatrixXd lights(31, 7);
  for (Eigen::Index i = 0; i < 7; ++i) {
    lights.col(i) = lamp(illuminant_names()[static_cast<std::size_t>(i)].c_str());
  }
  lights.col(5).array() *= paper("munsell-nickerson:231");
  const Matrix3Xd a = srgb_matching();
  const ArrayXd object = paper("munsell-nickerson:117");
  const Matrix3Xd seen = a * lights, wanted = a * object.matrix().asDiagonal() * lights;
  const Matrix3d truth =
      seen.transpose().colPivHouseholderQr().solve(wanted.transpose()).transpose();
  const DisplayConversion c = least_squares_conversion(a, lights * lights.transpose());
  EXPECT_LT((object_matrix(c, object) - truth).norm(), 1e-7);
}

TEST(DisplayConversion, GreyObjectsOnlyDim) {
  const DisplayConversion c = srgb_conversion();
  EXPECT_LT((c.from_reference * c.to_reference - Matrix3d::Identity()).norm(), 1e-10);
  const Matrix3d grey = object_matrix(c, ArrayXd::Constant(31, 0.3));
  EXPECT_LT((grey - 0.3 * Matrix3d::Identity()).norm(), 1e-10);
}

// C' = T C T^-1, also where T adapts to another white: colours come out the same on every display.
TEST(DisplayConversion, DependsOnNoDisplay) {
  const ArrayXd object = paper("munsell-nickerson:40"), light = lamp("A");
  const Vector3d xyz_through_srgb =
      xyz_from_rgb_on(kTransportGrid, rgb_space("srgb")) *
      (object_matrix(srgb_conversion(), object) * (srgb_matching() * light.matrix()));
  const Matrix3d adapt = linear_adaptation({1.0985, 1, 0.3558}, {0.95047, 1, 1.08883});
  const Matrix3Xd other = adapt * rgb_matching(rgb_space("xyz"), kTransportGrid);
  const DisplayConversion c = least_squares_conversion(other, room_lights_second_moment());
  const Vector3d xyz_through_other =
      xyz_from_rgb_on(kTransportGrid, rgb_space("xyz")) *
      (adapt.inverse() * (object_matrix(c, object) * (other * light.matrix())));
  EXPECT_LT((xyz_through_srgb - xyz_through_other).norm(), 1e-8 * xyz_through_srgb.norm());
}

// Glass before a wall: two objects in a row are two matrices in a row.
TEST(DisplayConversion, TransmissionThenReflectionIsExactForThreeComponents) {
  const Matrix3d a = rgb_space("srgb").xyz_from_rgb.inverse() * rgb_space("bt2020").xyz_from_rgb;
  const Array3d glass(0.9, 0.8, 0.5), wall(0.2, 0.6, 0.3), light(1, 2, 3);
  const DisplayConversion c = three_component_conversion(a);
  const Vector3d shown = object_matrix(c, wall) * object_matrix(c, glass) * (a * light.matrix());
  EXPECT_LT((shown - a * (wall * glass * light).matrix()).norm(), 1e-14);
}

TEST(DisplayConversion, TransmissionThenReflectionIsCloserThanRgb) {
  const Spectrum wall{kTransportGrid, paper("munsell-nickerson:117")},
      light{kTransportGrid, lamp("A")},
      glass{kTransportGrid, 0.5 + 0.4 * ArrayXd::LinSpaced(31, -1.5, 1).sin()};
  const RgbSpace& srgb = rgb_space("srgb");
  const DisplayConversion c = srgb_conversion();
  const Vector3d shown = rgb_of_light(srgb, light);
  const Vector3d truth = srgb_matching() * (glass.values * wall.values * light.values).matrix();
  const Vector3d matrices = object_matrix(c, wall.values) * object_matrix(c, glass.values) * shown;
  const Vector3d rgb = rgb_of_reflectance(srgb, wall).array() *
                       rgb_of_reflectance(srgb, glass).array() * shown.array();
  EXPECT_LT((matrices - truth).norm(), 0.5 * (rgb - truth).norm());
}

TEST(ObjectDiagonal, IsExactForTheRepresentativeLight) {
  const ArrayXd object = paper("munsell-nickerson:117"), light = lamp("A");
  const Vector3d c = object_diagonal(srgb_matching(), object, light);
  const Vector3d shown = srgb_matching() * light.matrix(),
                 truth = srgb_matching() * (object * light).matrix();
  EXPECT_LT((c.cwiseProduct(shown) - truth).norm(), 1e-12 * truth.norm());
  EXPECT_THROW((void)object_diagonal(srgb_matching(), object, ArrayXd::Zero(31)),
               std::invalid_argument);
}

// [Kolchin2001] after eq. 6: from an RGB reference in its own white, C_i = sum A c / sum A.
TEST(ObjectDiagonal, OfAnRgbReferenceIsThePrintedRatio) {
  const Matrix3d a = rgb_space("bt2020").xyz_from_rgb.inverse() * rgb_space("srgb").xyz_from_rgb;
  const Array3d object(0.7, 0.3, 0.1);
  const Vector3d c = object_diagonal(a, object, Array3d::Ones());
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(c[i], a.row(i).dot(object.matrix()) / a.row(i).sum(), 1e-15);
  }
}

TEST(RgbMatching, IsRgbOfLight) {
  const Spectrum light = light_on(kTransportGrid, illuminant("C"));
  for (const RgbSpace& space : rgb_spaces()) {
    const Vector3d rgb = rgb_matching(space, kTransportGrid) * light.values.matrix();
    EXPECT_LT((rgb - rgb_of_light(space, light)).norm(), 1e-11 * rgb.norm()) << space.name;
  }
}

// The matrix from D65 to D50 of the ICC profile of sRGB, four decimals.
TEST(LinearAdaptation, IsThePublishedOneFromD65ToD50) {
  Matrix3d published;
  published << 1.0479, 0.0229, -0.0502, 0.0296, 0.9904, -0.0171, -0.0092, 0.0151, 0.7519;
  const Vector3d d65(0.9505, 1, 1.0890), d50(0.9642, 1, 0.8249);
  const Matrix3d m = linear_adaptation(d65, d50);
  EXPECT_LT((m - published).cwiseAbs().maxCoeff(), 2e-4);
  EXPECT_LT((m * d65 - d50).norm(), 1e-14);
  EXPECT_LT((linear_adaptation(d50, d65) * m - Matrix3d::Identity()).norm(), 1e-14);
}

TEST(DisplayConversion, RefusesWhatHasNoAnswer) {
  EXPECT_THROW((void)three_component_conversion(Matrix3d::Ones()), std::invalid_argument);
  EXPECT_THROW((void)least_squares_conversion(srgb_matching(), MatrixXd::Identity(30, 30)),
               std::invalid_argument);
  EXPECT_THROW((void)least_squares_conversion(srgb_matching(), MatrixXd::Ones(31, 31)),
               std::invalid_argument);
  EXPECT_THROW((void)linear_adaptation({0, 0, 0}, {1, 1, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace spectra
