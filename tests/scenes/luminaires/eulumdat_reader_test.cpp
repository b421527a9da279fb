#include "scenes/luminaires/eulumdat_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenes/luminaires/luminaire_files.h"

namespace scenes {
namespace {

using testing::HasSubstr;
using V = std::vector<double>;

V at_planes(const Luminaire& lamp, const V& planes) {
  V cd;
  for (const double c : planes) cd.push_back(std::round(lamp.intensity.at(direction_c(c, 45))));
  return cd;
}

/// Planes every 90 degrees, of which `stored` have 500, 100 k, 0 cd per klm from k = 1 on.
LdtText with_planes(int symmetry, int stored) {
  LdtText file{.symmetry = symmetry, .planes = 4, .c = {0, 90, 180, 270}};
  file.lamps = "1\n2\nT16\n1000\n840\n80\n29";
  file.per_klm.clear();
  for (int k = 1; k <= stored; ++k) file.per_klm.insert(file.per_klm.end(), {500, 100. * k, 0});
  return file;
}

TEST(EulumdatReader, IntensitiesGoWithTheFluxOfTheSetAndNotWithTheNumberOfLamps) {
  LdtText file;
  EXPECT_DOUBLE_EQ(read(file).intensity.peak_cd(), 600);
  file.output = "100\n50\n1,5\n0";
  EXPECT_DOUBLE_EQ(read(file).intensity.peak_cd(), 900);
  file.lamps = "1\n-1\nLED\n4000\n840\n80\n29";
  EXPECT_DOUBLE_EQ(read(file).intensity.peak_cd(), 1800);
  EXPECT_FALSE(read(file).lamps_lm.has_value());
  EXPECT_EQ(read(file).printed_lm, 2000);
  EXPECT_EQ(read(file).input_W, 29);
}

TEST(EulumdatReader, OfSeveralSetsTheFirstIsTaken) {
  LdtText file;
  file.lamps = "2\n2\nT16\n2000\n840\n80\n29\n1\nT5\n9000\n840\n80\n49";
  const Luminaire lamp = read(file);
  EXPECT_DOUBLE_EQ(lamp.intensity.peak_cd(), 600);
  EXPECT_THAT(joined(lamp.notes), HasSubstr("alternatives"));
}

TEST(EulumdatReader, SymmetriesAreWrittenOut) {
  const V around{0, 90, 180, 270};
  EXPECT_EQ(at_planes(read(with_planes(0, 4)), around), V({100, 200, 300, 400}));
  EXPECT_EQ(at_planes(read(with_planes(1, 1)), around), V({100, 100, 100, 100}));
  EXPECT_EQ(at_planes(read(with_planes(2, 3)), around), V({100, 200, 300, 200}));
  // Symmetry 3 begins with C270: C90 first would mirror the lamp.
  EXPECT_EQ(at_planes(read(with_planes(3, 3)), around), V({200, 300, 200, 100}));
  EXPECT_EQ(at_planes(read(with_planes(4, 2)), around), V({100, 200, 100, 200}));
}

// Length lies along C90-C270, which is y.
TEST(EulumdatReader, SizesAreOfTheLuminousArea) {
  LdtText file;
  EXPECT_EQ(read(file).size_m, Eigen::Vector3d(0.3, 1.2, 0));
  EXPECT_EQ(read(file).shape, LuminousShape::rectangle);
  file.luminous = "400\n0\n0\n0\n0\n0";
  EXPECT_EQ(read(file).shape, LuminousShape::ellipse);
  EXPECT_EQ(read(file).size_m, Eigen::Vector3d(0.4, 0.4, 0));
  file.luminous = "1200\n300\n40\n50\n40\n50";
  EXPECT_EQ(read(file).shape, LuminousShape::box);
  EXPECT_EQ(read(file).size_m.z(), 0.05);
  file.luminous = "0\n0\n0\n0\n0\n0";
  EXPECT_EQ(read(file).shape, LuminousShape::point);
}

TEST(EulumdatReader, AnglesWinOverSteps) {
  LdtText file = with_planes(0, 4);
  std::string text = file.text();
  text.replace(text.find("\n4\n0\n"), 5, "\n4\n45\n");
  const Luminaire lamp = read_luminaire(write_file("steps.ldt", text));
  EXPECT_EQ(at_planes(lamp, {90}), V({200}));
  EXPECT_THAT(joined(lamp.notes), HasSubstr("angles count"));
}

TEST(EulumdatReader, WhatDoesNotFitIsNoted) {
  LdtText file;
  file.output = "100\n90\n1\n15";
  const std::string notes = joined(read(file).notes);
  EXPECT_THAT(notes, HasSubstr("the file prints 1800 lm"));
  EXPECT_THAT(notes, HasSubstr("tilt of 15 degrees"));
}

TEST(EulumdatReader, WithoutALampFluxTheRoomMustGiveIt) {
  LdtText file;
  file.lamps = "1\n1\nLED\n0\n840\n80\n29";
  const Luminaire lamp = read(file);
  EXPECT_TRUE(lamp.needs_flux);
  EXPECT_THAT(joined(lamp.notes), HasSubstr("lamp flux 0"));
}

}  // namespace
}  // namespace scenes
