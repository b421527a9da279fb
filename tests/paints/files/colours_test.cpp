// Catalogues without spectra, and what is told about a file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "appearance/spectra/text/input_error.h"
#include "paints/files/paint_reader.h"

namespace paints {
namespace {

using testing::Contains;
using testing::HasSubstr;

spectra::RelativeXyz xyz_of(const FilePaint& paint, const spectra::StatedWhite& white = {}) {
  return spectra::xyz_under(white,
                            spectra::reflectance_on(spectra::kTransportGrid, paint.reflectance));
}

void expect_colour(const FilePaint& paint, const spectra::StatedColour& want) {
  const spectra::RelativeXyz xyz = xyz_of(paint, want.white);
  EXPECT_NEAR(xyz.x, want.xyz.x, 1e-9);
  EXPECT_NEAR(xyz.y, want.xyz.y, 1e-9);
  EXPECT_NEAR(xyz.z, want.xyz.z, 1e-9);
}

TEST(ColourCatalogue, ShopListWithoutHeaderIsRecognisedByItsHexCodes) {
  const PaintFile file =
      parse_paint_file("list.txt", "Sand;S-101; #d8c9a7\nSand;S-102;#D0C0A0\nClay;S-103;#B08968\n");
  ASSERT_EQ(file.paints.size(), 3U);
  EXPECT_EQ(file.paints[0].name, "S-101");  // names repeat, codes do not
  EXPECT_THAT(file.paints[0].label, HasSubstr("Sand"));
  EXPECT_TRUE(file.paints[0].reconstructed);
  expect_colour(file.paints[0], spectra::from_srgb(*spectra::parse_hex("#D8C9A7")));
  EXPECT_THAT(file.notes, Contains(HasSubstr("reconstructed")));
}

TEST(ColourCatalogue, LabHasTheStatedWhiteAndElseD65Noted) {
  const std::string rows = "\nS-101,81.2,1.9,19.8\n";
  const PaintFile stated =
      parse_paint_file("a.csv", "code,L* (D50/2),a* (D50/2),b* (D50/2)" + rows);
  expect_colour(stated.paints[0], spectra::from_lab({81.2, 1.9, 19.8}, {.illuminant = "D50"}));
  const PaintFile silent = parse_paint_file("a.csv", "code,L*,a*,b*" + rows);
  expect_colour(silent.paints[0], spectra::from_lab({81.2, 1.9, 19.8}, {}));
  EXPECT_THAT(silent.notes, Contains(HasSubstr("D65/2")));
  ReadChoices choices;
  set_choice(choices, "white", "D65/10");
  const PaintFile chosen = parse_paint_file("a.csv", "code,L*,a*,b*" + rows, choices);
  expect_colour(chosen.paints[0], spectra::from_lab({81.2, 1.9, 19.8}, {.observer_deg = 10}));
}

TEST(ColourCatalogue, XyzChromaticityRgbAndLrvAreRead) {
  expect_colour(parse_paint_file("a.csv", "name,X,Y,Z\na,40,42,30\n").paints[0],
                spectra::from_xyz({40, 42, 30}, {}));
  expect_colour(parse_paint_file("a.csv", "name,x,y,Y\na,0.35,0.36,42\n").paints[0],
                spectra::from_xy_y(0.35, 0.36, 42, {}));
  expect_colour(parse_paint_file("a.csv", "name,R,G,B\na,216,201,167\n").paints[0],
                spectra::from_srgb(*spectra::parse_hex("#D8C9A7")));
  expect_colour(parse_paint_file("a.csv", "name,LRV\na,42\n").paints[0], spectra::from_lrv(42));
}

TEST(ColourCatalogue, FurtherColumnsAreKeptInTheLabel) {
  const PaintFile file =
      parse_paint_file("a.csv", "Collection,Name,Code,Hex,Gloss\nCoast,Sand,S-101,#D8C9A7,matt\n");
  EXPECT_EQ(file.paints[0].name, "S-101");
  EXPECT_EQ(file.paints[0].label, "Sand, Coast, matt");
  EXPECT_EQ(file.kept_columns, (std::vector<std::string>{"Collection", "Gloss"}));
}

TEST(ColourCatalogue, ContradictingLrvIsToldAndTrustedOnRequest) {
  const std::string text = "code,hex,LRV\na,#D8C9A7,66\nb,#808080,21.6\n";
  const PaintFile kept = parse_paint_file("a.csv", text);
  EXPECT_THAT(kept.notes, Contains(HasSubstr("1 in 1 of 2 paints")));
  ReadChoices choices;
  set_choice(choices, "lrv", "trust");
  EXPECT_NEAR(xyz_of(parse_paint_file("a.csv", text, choices).paints[0]).y, 66, 1e-9);
}

TEST(ColourCatalogue, WhatNoPaintCanBeIsSkippedOnRequest) {
  ReadChoices choices;
  set_choice(choices, "impossible", "skip");
  const PaintFile file =
      parse_paint_file("a.csv", "name,hex\nwhite,#FFFFFF\nsand,#D8C9A7\n", choices);
  ASSERT_EQ(file.paints.size(), 1U);
  EXPECT_THAT(file.notes, Contains(HasSubstr("left out")));
}

TEST(PaintFile, Latin1IsReadAndNoted) {
  const PaintFile file = parse_paint_file("a.csv", "name,hex\ncaf\xE9,#D8C9A7\n");
  EXPECT_EQ(file.paints[0].name, "caf\xC3\xA9");
  EXPECT_THAT(file.notes, Contains(HasSubstr("Latin-1")));
}

TEST(PaintFile, FluorescenceIsCutOnRequestAndMarked) {
  ReadChoices choices;
  set_choice(choices, "fluorescence", "clip");
  const PaintFile file = parse_paint_file(
      "a.csv", "name,400,450,500,550,600,650,700,710\na,.1,.1,1.1,.1,.1,.1,.1,.1\n", choices);
  EXPECT_TRUE(file.paints[0].fluorescent);
  EXPECT_LT(file.paints[0].reflectance.values[2], 1);
  EXPECT_THAT(file.notes, Contains(HasSubstr("fluorescent")));
}

// A cubic through samples of a cubic is exact, inside; the ends are parabolas.
TEST(PaintFile, TwentyNanometresAreInterpolatedByACubic) {
  const auto curve = [](double nm) {
    const double t = (nm - 550) / 150;
    return 0.6 + 0.1 * t - 0.2 * t * t + 0.15 * t * t * t;
  };
  std::string header = "name", row = "a";
  for (int nm = 400; nm <= 700; nm += 20) {
    header += "," + std::to_string(nm);
    row += "," + std::to_string(curve(nm));
  }
  const PaintFile file = parse_paint_file("a.csv", header + "\n" + row + "\n");
  const spectra::Samples& s = file.paints[0].reflectance;
  ASSERT_EQ(s.nm.size(), 31U);
  for (std::size_t k = 2; k + 2 < 31; ++k) EXPECT_NEAR(s.values[k], curve(s.nm[k]), 2e-6);
}

TEST(PaintFile, EndsAreHeldOnRequest) {
  ReadChoices choices;
  set_choice(choices, "ends", "hold");
  const PaintFile file = parse_paint_file(
      "a.csv", "name,410,450,500,550,600,650,690,695\na,.1,.2,.2,.2,.2,.2,.3,.3\n", choices);
  EXPECT_EQ(file.paints[0].reflectance.nm.front(), 400);
  EXPECT_EQ(file.paints[0].reflectance.nm.back(), 700);
}

TEST(ReadChoices, UnknownOnesAreAnsweredWithThoseThereAre) {
  ReadChoices choices;
  for (const auto& [key, value] : {std::pair{"scale", "promille"}, std::pair{"white", "F11/2"},
                                   std::pair{"wavelengths", "400:700:7"}, std::pair{"x", "y"}}) {
    EXPECT_THROW(set_choice(choices, key, value), std::invalid_argument) << key;
  }
}

}  // namespace
}  // namespace paints
