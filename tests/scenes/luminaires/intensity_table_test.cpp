#include "scenes/luminaires/intensity_table.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "scenes/luminaires/measures.h"
#include "scenes/luminaires/plane_symmetry.h"
#include "tests/scenes/luminaires/luminaire_files.h"

namespace scenes {
namespace {

using Eigen::ArrayXXd;
using Eigen::Index;
using Eigen::Vector3d;
using std::numbers::pi;

std::vector<double> steps(double from, double to, int count) {
  std::vector<double> all;
  for (int k = 0; k <= count; ++k) all.push_back(from + (to - from) * k / count);
  return all;
}

IntensityTable tabulated(Goniometry type, const std::vector<double>& polar,
                         const std::vector<double>& azimuth,
                         const std::function<double(double, double)>& intensity) {
  ArrayXXd cd(static_cast<Index>(azimuth.size()), static_cast<Index>(polar.size()));
  for (Index a = 0; a < cd.rows(); ++a) {
    for (Index p = 0; p < cd.cols(); ++p) {
      cd(a, p) =
          intensity(polar[static_cast<std::size_t>(p)], azimuth[static_cast<std::size_t>(a)]);
    }
  }
  return {type, polar, azimuth, cd};
}

/// A table without symmetry or smoothness.
IntensityTable random_table(Goniometry type, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto dice = [&] { return static_cast<double>(random()) * 0x1p-32; };
  const bool c = type == Goniometry::c;
  std::vector<double> polar{c ? 0.0 : -90.0}, azimuth{c ? 0.0 : -90.0};
  while (polar.back() < (c ? 170 : 80)) polar.push_back(polar.back() + 4 + 6 * dice());
  while (azimuth.back() < (c ? 340 : 75)) azimuth.push_back(azimuth.back() + 5 + 10 * dice());
  polar.push_back(c ? 180 : 90);
  azimuth.push_back(c ? 360 : 90);
  return tabulated(type, polar, azimuth, [&](double, double) { return 100 * dice(); });
}

// A sphere of 100 cd everywhere, and the half of it that types A and B see.
TEST(IntensityTable, ConstantIntensityHasFourPiOfFlux) {
  const auto constant = [](double, double) { return 100; };
  EXPECT_NEAR(tabulated(Goniometry::c, steps(0, 180, 36), {0, 360}, constant).flux_lm(), 400 * pi,
              1e-10);
  EXPECT_NEAR(tabulated(Goniometry::c, {0, 7, 90}, steps(0, 360, 5), constant).flux_lm(), 200 * pi,
              1e-10);
  for (const Goniometry type : {Goniometry::a, Goniometry::b}) {
    EXPECT_NEAR(tabulated(type, steps(-90, 90, 9), steps(-90, 90, 4), constant).flux_lm(), 200 * pi,
                1e-10);
  }
}

// I0 cos gamma has pi I0. Linear between its angles it is low by about step^2 / 12: 2.5e-3, 6.3e-4,
// 1.6e-4, 2.5e-5 at 10, 5, 2.5, 1 degree. Exactly: the integral of sin over a hat of half width h
// at g is 2 sin g (1 - cos h) / h, and the sum of sin 2g / 2 over the inner angles is cot h / 2.
TEST(IntensityTable, CosineIsLowByWhatLinearInterpolationLoses) {
  const auto cosine = [](double gamma, double) { return std::cos(gamma * pi / 180); };
  for (const int count : {9, 18, 36, 90}) {
    const double h = pi / 2 / count;
    const double exact = 2 * pi * (1 - std::sin(h) / h + (1 - std::cos(h)) / (h * std::tan(h)));
    EXPECT_NEAR(tabulated(Goniometry::c, steps(0, 90, count), {0, 360}, cosine).flux_lm(), exact,
                1e-12);
    EXPECT_NEAR(exact / pi, 1 - h * h / 12, 1e-2 * h * h);
  }
}

/// Midpoints of cells so small that kinks of the table hardly count.
double flux_by_sampling(const IntensityTable& table) {
  constexpr int kPolar = 1440, kAzimuth = 2880;
  double sum = 0;
  for (int p = 0; p < kPolar; ++p) {
    const double low = pi * p / kPolar, high = pi * (p + 1) / kPolar, polar = (low + high) / 2;
    for (int a = 0; a < kAzimuth; ++a) {
      const double azimuth = 2 * pi * (a + 0.5) / kAzimuth;
      sum += (std::cos(low) - std::cos(high)) * (2 * pi / kAzimuth) *
             table.at({std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                       std::cos(polar)});
    }
  }
  return sum;
}

TEST(IntensityTable, FluxIsThatOfTheInterpolantForEveryType) {
  for (const Goniometry type : {Goniometry::a, Goniometry::b, Goniometry::c}) {
    const IntensityTable table = random_table(type, 3);
    EXPECT_NEAR(flux_by_sampling(table) / table.flux_lm(), 1, 2e-5);
  }
}

TEST(IntensityTable, ZonesAddUpToTheFlux) {
  for (const Goniometry type : {Goniometry::a, Goniometry::b, Goniometry::c}) {
    const IntensityTable table = random_table(type, 5);
    double sum = 0;
    for (const Zone& zone : zones(table)) sum += zone.flux_lm;
    EXPECT_NEAR(sum / table.flux_lm(), 1, type == Goniometry::c ? 1e-13 : 1e-4);
  }
}

// Directions written down as the formulas of the types have them [LM63].
TEST(IntensityTable, FindsItsAnglesByDirection) {
  const auto both = [](double polar, double azimuth) { return 1000 * polar + azimuth + 1e6; };
  const IntensityTable c = tabulated(Goniometry::c, {0, 180}, {0, 360}, both),
                       b = tabulated(Goniometry::b, {-90, 90}, {-90, 90}, both),
                       a = tabulated(Goniometry::a, {-90, 90}, {-90, 90}, both);
  for (const double first : {-70., -30., 10., 60.}) {
    for (const double second : {-80., -15., 20., 55.}) {
      const double u = first * pi / 180, v = second * pi / 180;
      EXPECT_NEAR(a.at({std::cos(u) * std::cos(v), -std::cos(u) * std::sin(v), std::sin(u)}),
                  both(first, second), 1e-6);  // vertical u, horizontal v
      EXPECT_NEAR(b.at({std::cos(u) * std::sin(v), -std::sin(u), -std::cos(u) * std::cos(v)}),
                  both(first, second), 1e-6);  // horizontal u, vertical v
      EXPECT_NEAR(c.at(direction_c(second + 90, first + 90)), both(first + 90, second + 90), 1e-6);
    }
  }
}

TEST(IntensityTable, ThereIsNoLightBeyondItsAngles) {
  const auto one = [](double, double) { return 1; };
  const IntensityTable down = tabulated(Goniometry::c, {0, 90}, {0, 360}, one);
  EXPECT_EQ(down.at(direction_c(10, 89.999)), 1);
  EXPECT_EQ(down.at(direction_c(10, 90)), 1);
  EXPECT_EQ(down.at(direction_c(10, 90.001)), 0);
  const IntensityTable front = tabulated(Goniometry::b, {-90, 90}, {-90, 90}, one);
  EXPECT_EQ(front.at({0.5, 0.2, -0.3}), 1);
  EXPECT_EQ(front.at({0.5, 0.2, 0.3}), 0);
}

TEST(IntensityTable, NothingWithinAnAngleIsBrighterThanIsSaid) {
  std::mt19937 random(11);
  const auto dice = [&] { return static_cast<double>(random()) * 0x1p-31 - 1; };
  for (const Goniometry type : {Goniometry::a, Goniometry::b, Goniometry::c}) {
    const IntensityTable table = random_table(type, 7);
    for (int k = 0; k < 2000; ++k) {
      const Vector3d centre = Vector3d(dice(), dice(), dice()).normalized();
      const double radius = 0.3 * (1 + dice());
      const Vector3d side = centre.cross(Vector3d(dice(), dice(), dice())).normalized();
      const double angle = radius * (1 + dice()) / 2;
      EXPECT_LE(table.at(std::cos(angle) * centre + std::sin(angle) * side),
                table.most_within(centre, radius) + 1e-9);
    }
  }
}

TEST(PlaneSymmetry, WrittenOutPlanesGoFrom0To360) {
  HalfPlanes stored{.angle_deg = {0, 45, 90}, .intensity_cd = ArrayXXd(3, 1)};
  stored.intensity_cd << 1, 2, 3;
  const HalfPlanes all = all_around(stored, PlaneSymmetry::both);
  EXPECT_EQ(all.angle_deg, (std::vector<double>{0, 45, 90, 135, 180, 225, 270, 315, 360}));
  EXPECT_EQ(all.intensity_cd.col(0).transpose().matrix(),
            (Eigen::RowVectorXd(9) << 1, 2, 3, 2, 1, 2, 3, 2, 1).finished());
}

// 100 and 260 are mirrored to 80 and 280: plane 0 lies 80 degrees from both.
TEST(PlaneSymmetry, APlane0ThatNobodyStoredIsInterpolated) {
  HalfPlanes stored{.angle_deg = {90, 100, 260, 270}, .intensity_cd = ArrayXXd(4, 1)};
  stored.intensity_cd << 1, 2, 6, 7;
  const HalfPlanes all = all_around(stored, PlaneSymmetry::about_90_270);
  EXPECT_EQ(all.angle_deg.front(), 0);
  EXPECT_EQ(all.intensity_cd(0, 0), 4);
  EXPECT_EQ(all.intensity_cd(all.intensity_cd.rows() - 1, 0), 4);
}

}  // namespace
}  // namespace scenes
