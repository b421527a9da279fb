// tests/data/seen_pixels*.csv hold pixels of a room and how a display shows them, made by
// independent code; tests/README.md.
#include "appearance/display.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "appearance/spectra/text/csv_reader.h"

namespace appearance {
namespace {

const ViewingConditions kRoom{.white = {109.850, 100, 35.585},
                              .adapting_luminance_cd_m2 = 25,
                              .background_y = 55,
                              .surround = {}};

void expect_vectors(const std::string& file, double headroom) {
  const Display display(kRoom, headroom);
  const spectra::CsvTable csv = spectra::read_csv(std::string(TEST_DATA) + "/" + file);
  ASSERT_EQ(csv.rows.size(), 13U);
  for (const spectra::CsvRow& row : csv.rows) {
    SCOPED_TRACE(file + " line " + std::to_string(row.line));
    const auto cell = [&](std::size_t k) { return *spectra::parse_number(row.cells[k]); };
    const DisplayedPixel p = display.show({cell(0), cell(1), cell(2)});
    EXPECT_NEAR(p.lightness, cell(3), 1e-6);
    EXPECT_NEAR(p.chroma, cell(4), 1e-6);
    EXPECT_NEAR(p.hue_deg, cell(5), 1e-6);
    EXPECT_NEAR(p.lightness_shown, cell(6), 1e-6);
    EXPECT_NEAR(p.chroma_shown, cell(7), 1e-6);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(p.srgb[c], cell(8 + static_cast<std::size_t>(c)), 1e-6);
    EXPECT_EQ(p.too_light, cell(3) > cell(6) + 1e-6);
    EXPECT_EQ(p.less_chroma, cell(4) > cell(7) + 1e-6);
    EXPECT_FALSE(p.undefined);
  }
}

TEST(Display, ShowsEveryVectorAsIndependentCodeDoes) { expect_vectors("seen_pixels.csv", 1); }

TEST(Display, ShowsEveryVectorWithHeadroomAsIndependentCodeDoes) {
  expect_vectors("seen_pixels_headroom.csv", Display::kHeadroom);
}

// D = 1: what looks grey in the room is grey on the display, r = g = b to the digits that the first
// row of the cone matrix leaves.
TEST(Display, GreyIsShownGrey) {
  const Display display(kRoom, 1);
  const Adaptation room = adapt(kRoom);
  for (const double j : {5.0, 30.0, 70.0, 99.0}) {
    const DisplayedPixel p = display.show(ciecam02_inverse({j, 0, 0}, room));
    EXPECT_NEAR(p.srgb.maxCoeff() - p.srgb.minCoeff(), 0, 3e-5) << j;
    EXPECT_FALSE(p.too_light) << j;
  }
}

// Below a chroma of 40 only the end of the way is looked at: no colour may be out of the gamut on
// the way there and in it at the end.
TEST(Display, NoColourReturnsIntoTheGamutBelowAChromaOf40) {
  const Display display(kRoom);
  const Adaptation room = adapt(kRoom);
  for (double j = 1; j < 106; j += 3) {
    for (double h = 0; h < 360; h += 4) {
      bool left = false;
      for (double c = 1; c <= 40; c += 1) {
        const DisplayedPixel p = [&] {
          try {
            return display.show(ciecam02_inverse({j, c, h}, room));
          } catch (const std::domain_error&) {  // no stimulus in the room looks so
            return DisplayedPixel{.less_chroma = true};
          }
        }();
        EXPECT_FALSE(left && !p.less_chroma) << "J " << j << " C " << c << " h " << h;
        left = p.less_chroma;
      }
    }
  }
}

// Near h 258, J 21 colours leave the gamut at a C of about 70 and are back from about 90.
TEST(Display, TheFirstExitFromTheGamutCounts) {
  const Display display(kRoom, 1);
  const Adaptation room = adapt(kRoom);
  const auto shown = [&](double c) { return display.show(ciecam02_inverse({21, c, 258}, room)); };
  EXPECT_FALSE(shown(65).less_chroma);
  const double edge = shown(75).chroma_shown;
  EXPECT_GT(edge, 65);
  EXPECT_LT(edge, 75);
  for (const double c : {80.0, 90.0, 95.0, 100.0}) {
    EXPECT_TRUE(shown(c).less_chroma) << c;
    EXPECT_NEAR(shown(c).chroma_shown, edge, 1e-7) << c;
  }
}

TEST(Display, WhatTheModelLeavesUndefinedIsCounted) {
  const Display display(kRoom);
  EXPECT_TRUE(display.show({-5, -5, -5}).undefined);
  EXPECT_EQ(display.show({-5, -5, -5}).srgb, Eigen::Vector3d::Zero());
  EXPECT_THROW((void)display.show({std::numeric_limits<double>::quiet_NaN(), 0, 0}),
               std::domain_error);
  EXPECT_THROW(Display(kRoom, 0.5), std::invalid_argument);
}

TEST(Photograph, DesaturationKeepsLuminanceAndEndsOnTheEdge) {
  const auto luminance = [](const Eigen::Vector3d& rgb) {
    return 0.2126390 * rgb[0] + 0.7151687 * rgb[1] + 0.0721923 * rgb[2];  // of the primaries
  };
  for (const Eigen::Vector3d& rgb :
       {Eigen::Vector3d(1.4, 0.6, 0.2), Eigen::Vector3d(0.4, 0.5, -0.2),
        Eigen::Vector3d(1.9, 0.3, -0.1)}) {
    const Desaturated d = desaturated(rgb);
    EXPECT_TRUE(d.changed);
    EXPECT_NEAR(luminance(d.linear), luminance(rgb), 1e-7);
    EXPECT_NEAR(std::min(d.linear.minCoeff(), 1 - d.linear.maxCoeff()), 0, 1e-12);
  }
  EXPECT_FALSE(desaturated({0.2, 0.9, 1}).changed);
  EXPECT_EQ(desaturated({3, 2, 1}).linear, Eigen::Vector3d::Ones());
}

}  // namespace
}  // namespace appearance
