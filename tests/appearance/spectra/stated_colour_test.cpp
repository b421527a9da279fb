#include "appearance/spectra/stated_colour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "appearance/ciede2000.h"
#include "appearance/spectra/spectrum_library.h"

namespace spectra {
namespace {

/// L*, a*, b* of a reflectance against the white of the bands.
appearance::Lab lab_of(const Spectrum& reflectance, const StatedWhite& white) {
  return appearance::cielab(xyz_under(white, reflectance), band_white(white));
}

double apart(const appearance::Lab& p, const Eigen::Vector3d& q) {
  return (Eigen::Vector3d(p.l, p.a, p.b) - q).norm();
}

// ISO/CIE 11664-2 and CIE 15 T.3, 0.03 for sums at 1 nm with light linear between 5 nm.
TEST(StatedWhite, AgreesWithThePublishedTables) {
  const auto expect_white = [](const char* name, double x, double z) {
    const RelativeXyz w = published_white(parse_white(name).value());
    EXPECT_NEAR(w.x, x, 0.03) << name;
    EXPECT_NEAR(w.y, 100, 1e-9) << name;
    EXPECT_NEAR(w.z, z, 0.03) << name;
  };
  expect_white("D65/2", 95.047, 108.883);
  expect_white("D50/2", 96.422, 82.521);
  expect_white("A/2", 109.850, 35.585);
  expect_white("D65/10", 94.811, 107.304);
  expect_white("D50/10", 96.720, 81.427);
  expect_white("A/10", 111.144, 35.200);
}

TEST(StatedWhite, IsParsedAndPrinted) {
  EXPECT_EQ(parse_white("d50 / 10deg"), (StatedWhite{.illuminant = "D50", .observer_deg = 10}));
  EXPECT_EQ(to_string(StatedWhite{}), "D65/2");
  for (const char* word : {"", "D65", "D65/3", "F11/2", "/2", "D65/"}) {
    EXPECT_FALSE(parse_white(word)) << word;
  }
}

TEST(ParseHex, TakesTheFormsOfTheTrade) {
  const Eigen::Vector3d sand = Eigen::Vector3d(0xD8, 0xC9, 0xA7) / 255;
  for (const char* word : {"#D8C9A7", "d8c9a7", " #D8C9a7 "}) EXPECT_EQ(parse_hex(word), sand);
  EXPECT_EQ(parse_hex("#fa0"), parse_hex("#ffaa00"));
  for (const char* word : {"", "#", "#12345", "#1234567", "fa0", "#GG0000", "0xD8C9A7"}) {
    EXPECT_FALSE(parse_hex(word)) << word;
  }
}

TEST(ReconstructStated, LabComesBackUnderEveryWhite) {
  for (const char* name : {"D65/2", "D50/2", "D65/10", "A/10", "C/2"}) {
    const StatedWhite white = parse_white(name).value();
    for (const Eigen::Vector3d& lab :
         {Eigen::Vector3d(81.2, 1.9, 19.8), Eigen::Vector3d(30, 25, -20), Eigen::Vector3d(5, 1, 1),
          Eigen::Vector3d(50, 0, 0)}) {
      const Reconstruction r = reconstruct_stated(from_lab(lab, white));
      ASSERT_TRUE(r.converged) << name;
      EXPECT_LT(apart(lab_of(r.reflectance, white), lab), 1e-6) << name;
    }
    const Reconstruction grey = reconstruct_stated(from_lab({60, 0, 0}, white));
    EXPECT_LT(grey.reflectance.values.maxCoeff() - grey.reflectance.values.minCoeff(), 1e-9);
  }
}

// The same colour, stated in four ways.
TEST(StatedColour, FormsAgree) {
  const StatedWhite d65;
  const RelativeXyz w = published_white(d65);
  const StatedColour lab = from_lab({60, 20, 30}, d65);
  const RelativeXyz b = band_white(d65);
  const RelativeXyz stated{lab.xyz.x * w.x / b.x, lab.xyz.y, lab.xyz.z * w.z / b.z};
  const double sum = stated.x + stated.y + stated.z;
  const RelativeXyz by_xyz = from_xyz(stated, d65).xyz,
                    by_xy = from_xy_y(stated.x / sum, stated.y / sum, stated.y, d65).xyz;
  EXPECT_NEAR(by_xyz.x, lab.xyz.x, 1e-12);
  EXPECT_NEAR(by_xy.x, lab.xyz.x, 1e-12);
  EXPECT_NEAR(by_xy.z, lab.xyz.z, 1e-12);
  EXPECT_TRUE(reconstruct_stated(from_lrv(20)).reflectance.values.isApproxToConstant(0.2, 1e-9));
  EXPECT_THROW((void)from_xy_y(0.3, 0, 20, d65), std::invalid_argument);
}

TEST(ReconstructStated, BlackIsBlackAndImpossibleColoursDoNotConverge) {
  EXPECT_TRUE(reconstruct_stated(from_lab({0, 0, 0}, {})).reflectance.values.isZero(1e-12));
  EXPECT_FALSE(reconstruct_stated(from_lab({50, 120, -120}, {})).converged);
  EXPECT_FALSE(reconstruct_stated(from_lab({101, 0, 0}, {})).converged);
}

// The whole renotation under C, and random sRGB colours: exact to far below a printed digit.
TEST(ReconstructStated, RenotationAndRandomSrgbAreExact) {
  const StatedWhite c{.illuminant = "C"};
  double worst = 0;
  for (const NamedSpectrum& chip : atlas("munsell-renotation").entries) {
    const appearance::Lab lab = lab_of(reflectance_on(kTransportGrid, chip.samples), c);
    const Reconstruction r = reconstruct_stated(from_lab({lab.l, lab.a, lab.b}, c));
    ASSERT_TRUE(r.converged) << chip.name;
    worst = std::max(worst, apart(lab_of(r.reflectance, c), {lab.l, lab.a, lab.b}));
  }
  std::mt19937_64 random(1);
  int refused = 0;
  for (int i = 0; i < 10'000; ++i) {
    const std::uint64_t bits = random();
    Eigen::Vector3d rgb;
    for (unsigned k = 0; k < 3; ++k) rgb[k] = static_cast<double>((bits >> (8 * k)) & 0xFFU) / 255;
    const StatedColour colour = from_srgb(rgb);
    const Reconstruction r = reconstruct_stated(colour);
    refused += r.converged ? 0 : 1;
    const appearance::Lab want = appearance::cielab(colour.xyz, band_white({}));
    worst = std::max(worst, apart(lab_of(r.reflectance, {}), {want.l, want.a, want.b}));
  }
  EXPECT_LT(worst, 1e-6);
  EXPECT_EQ(refused, 0);
  RecordProperty("worst_lab", std::to_string(worst));
}

}  // namespace
}  // namespace spectra
