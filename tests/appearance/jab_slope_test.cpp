#include "appearance/jab_slope.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/photometry.h"
#include "appearance/spectra/spectrum_library.h"
#include "appearance/viewing_conditions.h"

namespace appearance {
namespace {

using Eigen::ArrayXd;
using spectra::Background;
using spectra::kTransportGrid;
using spectra::Spectrum;
using spectra::Surround;
using spectra::ViewedLightSlope;

Spectrum on_grid(const ArrayXd& values) { return {kTransportGrid, values}; }

/// An integrating sphere of which the share `painted` is paint, the rest of reflectance 0.5: the
/// irradiance is E / (1 - mean reflectance). The field also sees the lamps, `direct` of them.
struct Sphere {
  ArrayXd lamp;
  double painted = 0.6, direct = 0.3;

  ViewedLightSlope operator()(const ArrayXd& rho) const {
    const ArrayXd fade = 1 / (1 - painted * rho - (1 - painted) * 0.5);
    const ArrayXd h = lamp * fade, dh = h * fade * painted;
    const ArrayXd mean = painted * rho + (1 - painted) * 0.5;
    return {.light = {.sample = on_grid(rho * h),
                      .background = on_grid((0.8 * rho + 0.1) * h),
                      .field = on_grid(mean * h + direct * lamp),
                      .white = on_grid(h)},
            .by_reflectance = {.sample = on_grid(h + rho * dh),
                               .background = on_grid(0.8 * h + (0.8 * rho + 0.1) * dh),
                               .field = on_grid(painted * h + mean * dh),
                               .white = on_grid(dh)}};
  }
};

Sphere sphere_lx(double illuminance_lx) {
  const Spectrum a = spectra::light_on(kTransportGrid, spectra::illuminant("A"));
  return {.lamp = spectra::scaled_to_luminous(a, illuminance_lx).values};
}

ArrayXd paper(std::size_t index) {
  return spectra::reflectance_on(kTransportGrid,
                                 spectra::atlas("munsell-nickerson").entries[index].samples)
      .values;
}

Eigen::Vector3d jab_in(const spectra::ViewedLight& light, const spectra::ViewingChoices& choices) {
  const RoomView view = view_of_room(light, choices);
  const Correlates k = ciecam02_forward(view.sample, adapt(view.conditions));
  return {k.lightness, k.a_c, k.b_c};
}

/// The largest error of any derivative against a central difference of 4th order.
double slope_error(const Sphere& room, const ArrayXd& rho,
                   const spectra::ViewingChoices& choices = {}, double step = 1e-3) {
  const JabSlope slope = jab_slope(room(rho), choices);
  double worst = 0;
  for (int band = 0; band < rho.size(); ++band) {
    const auto at = [&](double offset) {
      ArrayXd moved = rho;
      moved[band] += offset;
      return jab_in(room(moved).light, choices);
    };
    const Eigen::Vector3d difference =
        (8 * (at(step) - at(-step)) - (at(2 * step) - at(-2 * step))) / (12 * step);
    worst = std::max(worst, (slope.by_reflectance.col(band) - difference).cwiseAbs().maxCoeff());
  }
  return worst;
}

TEST(JabSlope, MeetsCentralDifferencesForPapersAndAmountsOfLight) {
  for (const std::size_t index : {5U, 117U, 231U, 400U}) {
    for (const double lx : {0.5, 20.0, 1000.0}) {
      EXPECT_LT(slope_error(sphere_lx(lx), paper(index)), 1e-6) << index << " at " << lx << " lx";
    }
  }
}

TEST(JabSlope, MeetsCentralDifferencesForEveryViewingChoice) {
  for (const Surround surround : {Surround::neumann, Surround::cie, Surround::illuminance,
                                  Surround::average, Surround::dim, Surround::dark}) {
    for (const Background background : {Background::ring, Background::sample}) {
      EXPECT_LT(slope_error(sphere_lx(300), paper(117), {surround, background}), 1e-6)
          << to_string(surround) << ", " << to_string(background);
    }
  }
}

// L_A / L_Aw below 0.2, between, and clamped at 1, where the surround follows no more.
TEST(JabSlope, FollowsTheSurroundOnEachOfItsPieces) {
  Sphere room = sphere_lx(300);
  room.painted = 1;
  for (const double direct : {-0.05, 0.3, 3.0}) {
    room.direct = direct;
    const ArrayXd rho = 0.15 + 0.2 * paper(117);
    const double ratio = view_of_room(room(rho).light).surround_ratio;
    EXPECT_EQ(ratio, std::clamp(ratio, direct > 0 ? 0.2 : 0.01, direct > 1 ? 1 : 0.99));
    EXPECT_LT(slope_error(room, rho), 1e-6) << ratio;
  }
}

TEST(JabSlope, GivesTheValuesOfTheModelItself) {
  const Sphere room = sphere_lx(300);
  const JabSlope slope = jab_slope(room(paper(117)));
  EXPECT_EQ(slope.jab, jab_in(room(paper(117)).light, {}));
  EXPECT_TRUE(slope.status.all_defined());
  EXPECT_EQ(slope.by_reflectance.cols(), 31);
}

TEST(JabSlope, OfTheEightSumsIsThatOfTheRoom) {
  const ViewedLightSlope light = sphere_lx(300)(paper(117));
  const ViewedSums sums = viewed_sums(light.light);
  EXPECT_NEAR(sums[4], view_of_room(light.light).illuminance_lx, 1e-9);
  for (const Surround surround : {Surround::neumann, Surround::cie, Surround::dim}) {
    const Eigen::Vector3d wanted = jab_in(light.light, {.surround = surround});
    EXPECT_LT((jab_of(sums, {.choices = {.surround = surround}}) - wanted).norm(), 1e-10);
    EXPECT_LT((jab_slope(sums, {.choices = {.surround = surround}}).jab - wanted).norm(), 1e-10);
  }
}

// Brighter paint everywhere: a lighter wall.
TEST(JabSlope, LeadsOutOfBlack) {
  const JabSlope slope = jab_slope(sphere_lx(300)(ArrayXd::Zero(31)));
  EXPECT_EQ(slope.jab, Eigen::Vector3d::Zero());
  EXPECT_TRUE(slope.by_reflectance.allFinite());
  EXPECT_GT(slope.by_reflectance.row(0).sum(), 0);
}

// The grey that the model calls neutral in this light, from its own inverse; three bands make it.
TEST(JabSlope, StaysFiniteAtNeutrals) {
  ViewedLightSlope light = sphere_lx(300)(ArrayXd::Constant(31, 0.4));
  const RoomView view = view_of_room(light.light);
  const auto grey = ciecam02_inverse({50, 0, 0}, adapt(view.conditions));
  Eigen::Matrix3d of_bands;
  for (const int i : {0, 1, 2}) {
    Spectrum band = spectra::constant(kTransportGrid, 0);
    band.values[5 + 8 * i] = 1;
    const auto xyz = spectra::absolute_xyz(band);
    of_bands.col(i) << xyz.x, xyz.y, xyz.z;
  }
  const Eigen::Vector3d amounts =
      of_bands.inverse() * Eigen::Vector3d(grey.x, grey.y, grey.z) * view.illuminance_lx / 100;
  light.light.sample.values.setZero();
  for (const int i : {0, 1, 2}) light.light.sample.values[5 + 8 * i] = amounts[i];

  const JabSlope slope = jab_slope(light);
  EXPECT_NEAR(slope.jab[0], 50, 1e-9);
  EXPECT_LT(slope.jab.tail<2>().norm(), 1e-9);
  EXPECT_TRUE(slope.by_reflectance.allFinite());
  EXPECT_GT(slope.by_reflectance.row(1).norm(), 0);
}

// A wall that sends only violet, seen under a bluish white: A < 0.
TEST(JabSlope, IsZeroWhereTheModelDefinesNothing) {
  const Spectrum white = spectra::scaled_to_luminous(
      spectra::light_on(kTransportGrid, spectra::daylight(20000)), 1000);
  ViewedLightSlope light = Sphere{.lamp = white.values}(ArrayXd::Constant(31, 0.9));
  light.light.sample.values.tail(27).setZero();
  const JabSlope slope = jab_slope(light);
  EXPECT_TRUE(slope.status.negative_achromatic);
  EXPECT_EQ(slope.jab, Eigen::Vector3d::Zero());
  EXPECT_LT(slope.by_reflectance.norm(), 1e-300);  // what underflows depends on the compiler
}

TEST(JabSlope, RefusesDarknessAndMixedGrids) {
  ViewedLightSlope light = sphere_lx(300)(paper(117));
  light.by_reflectance.white = spectra::constant(spectra::kClosedFormGrid, 1);
  EXPECT_THROW((void)jab_slope(light), std::invalid_argument);
  EXPECT_THROW((void)jab_slope(sphere_lx(0)(paper(117))), std::domain_error);
}

}  // namespace
}  // namespace appearance
