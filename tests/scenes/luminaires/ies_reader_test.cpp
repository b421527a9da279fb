#include "scenes/luminaires/ies_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scenes/luminaires/measures.h"
#include "tests/scenes/luminaires/luminaire_files.h"

namespace scenes {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

// cd = value x multiplier x ballast factor, and x ballast-lamp factor up to 1991.
TEST(IesReader, ThirdFactorCountsUpTo1991Only) {
  IesText file;
  file.lamps = "1 1000 2";
  file.factors = "0.5 1.1 20";
  for (const auto& [version, cd] :
       std::vector<std::pair<std::string, double>>{{"a maker's text", 330},
                                                   {"IESNA91", 330},
                                                   {"IESNA:LM-63-1991", 330},
                                                   {"IESNA:LM-63-1995", 300},
                                                   {"IESNA95", 300},
                                                   {"IESNA:LM-63-2002", 300},
                                                   {"IES:LM-63-2019", 300},
                                                   {"IES:LM-63-2031", 300}}) {
    file.version = version;
    EXPECT_DOUBLE_EQ(read(file).intensity.peak_cd(), cd) << version;
  }
  EXPECT_THAT(joined(read(file).notes), HasSubstr("not known"));
  file.version = "IESNA:LM-63-2002";
  EXPECT_THAT(joined(read(file).notes), HasSubstr("1.1 is not applied"));
}

TEST(IesReader, LumensScaleNothing) {
  IesText file;
  const double flux_lm = read(file).flux_lm;
  file.lamps = "2 5000 1";
  EXPECT_EQ(read(file).flux_lm, flux_lm);
  EXPECT_EQ(read(file).lamps_lm, 10000);
  file.lamps = "1 -1 1";
  EXPECT_EQ(read(file).flux_lm, flux_lm);
  EXPECT_FALSE(read(file).lamps_lm.has_value());
  file.lamps = "1 100 1";
  EXPECT_THAT(joined(read(file).notes), HasSubstr("more than the 100 lm of the lamps"));
}

/// The same light at each of these C, with gamma 45.
std::vector<double> at_planes(const Luminaire& lamp, const std::vector<double>& planes) {
  std::vector<double> cd;
  for (const double c : planes) cd.push_back(std::round(lamp.intensity.at(direction_c(c, 45))));
  return cd;
}

IesText with_planes(const std::vector<double>& horizontal) {
  IesText file;
  file.horizontal = horizontal;
  file.candela.clear();
  for (std::size_t k = 0; k < horizontal.size(); ++k) {
    file.candela.insert(file.candela.end(), {500, 100 * static_cast<double>(k + 1), 0});
  }
  return file;
}

TEST(IesReader, HorizontalRangesAreSymmetries) {
  using V = std::vector<double>;
  const V around{30, 150, 210, 330};
  EXPECT_EQ(at_planes(read(with_planes({0})), around), V({100, 100, 100, 100}));
  EXPECT_EQ(at_planes(read(with_planes({0, 30, 90})), around), V({200, 200, 200, 200}));
  EXPECT_EQ(at_planes(read(with_planes({0, 30, 150, 180})), around), V({200, 300, 300, 200}));
  EXPECT_EQ(at_planes(read(with_planes({90, 150, 210, 270})), around), V({200, 200, 300, 300}));
  EXPECT_EQ(at_planes(read(with_planes({0, 30, 150, 210, 330, 360})), around),
            V({200, 300, 400, 500}));
}

TEST(IesReader, AMissingPlane360IsPlane0) {
  const Luminaire lamp = read(with_planes({0, 90, 180, 270}));
  EXPECT_EQ(at_planes(lamp, {0, 270, 315, 360}), (std::vector<double>{100, 400, 250, 100}));
  EXPECT_THAT(joined(lamp.notes), HasSubstr("plane 360 is left out"));
}

TEST(IesReader, PlanesThatDisagreeAreNoted) {
  IesText file = with_planes({0, 180, 360});
  EXPECT_THAT(joined(read(file).notes), HasSubstr("planes 0 and 360 differ"));
  file.candela[0] = 400;
  EXPECT_THAT(joined(read(file).notes), HasSubstr("disagree at vertical angle 0"));
}

TEST(IesReader, SignsDecideTheShape) {
  for (const auto& [size, shape, along] :
       std::vector<std::tuple<std::string, LuminousShape, Vector3d>>{
           {"0 0 0", LuminousShape::point, {0, 0, 0}},
           {"0.3 1.2 0", LuminousShape::rectangle, {1.2, 0.3, 0}},
           {"0.3 1.2 0.1", LuminousShape::box, {1.2, 0.3, 0.1}},
           {"-0.4 -0.4 0", LuminousShape::ellipse, {0.4, 0.4, 0}},
           {"-0.4 0 0", LuminousShape::ellipse, {0.4, 0.4, 0}},
           {"-0.4 0 0.2", LuminousShape::cylinder, {0.4, 0.4, 0.2}},
           {"-0.4 -0.4 0.2", LuminousShape::cylinder, {0.4, 0.4, 0.2}},
           {"-0.1 1.2 -0.1", LuminousShape::cylinder, {1.2, 0.1, 0.1}},
           {"0.9 -0.1 -0.1", LuminousShape::cylinder, {0.1, 0.9, 0.1}},
           {"-0.4 0 -0.4", LuminousShape::sphere, {0.4, 0.4, 0.4}},
           {"-0.4 -0.4 -0.4", LuminousShape::sphere, {0.4, 0.4, 0.4}}}) {
    IesText file;
    file.size = size;
    const Luminaire lamp = read(file);
    EXPECT_EQ(lamp.shape, shape) << size;
    EXPECT_LT((lamp.size_m - along).norm(), 1e-12) << size << ": " << lamp.size_m.transpose();
    file.type = "1 1";  // feet
    EXPECT_LT((read(file).size_m - 0.3048 * along).norm(), 1e-12);
  }
  IesText odd;
  odd.size = "0.3 1.2 -1";
  EXPECT_THAT(joined(read(odd).notes), HasSubstr("fit no shape"));
}

// Files of every year are broken where their writers liked.
TEST(IesReader, LineEndsCommasAndMarksDoNotMatter) {
  const IesText file;
  const double flux_lm = read(file).flux_lm;
  std::string text = file.text();
  const auto flux_of = [&](const std::string& changed) {
    return read_luminaire(write_file("changed.IES", changed)).flux_lm;
  };
  EXPECT_EQ(flux_of("\xEF\xBB\xBF" + text + "\n\r\n  \n"), flux_lm);
  EXPECT_EQ(flux_of(text + "\x1A rubbish"), flux_lm);
  std::string other = text;
  for (std::size_t at = 0; (at = other.find('\n', at)) != other.npos; at += 2) {
    other.replace(at, 1, "\r\n");
  }
  EXPECT_EQ(flux_of(other), flux_lm);
  std::ranges::replace(text, '\n', '\r');
  EXPECT_EQ(flux_of(text), flux_lm);
  EXPECT_EQ(
      flux_of("IESNA91\r\n[TEST] d\xFCster 1,5\r\nTILT=NONE\r\n1,1000,1.0,3.0\n1, 1 2\t0 0 0\n"
              "1 1 20\n0\n45 90\n0\n3.0e2,\n200 +0"),
      flux_lm);
}

TEST(IesReader, NamesComeFromKeywordsInAnyEncoding) {
  IesText file;
  file.version +=
      "\n[MANUFAC] L\xFC"
      "ster & Co";
  EXPECT_EQ(read(file).name, "L\xC3\xBCster & Co, lamp");
}

TEST(IesReader, TiltIsKeptForWhoeverAimsTheLuminaire) {
  IesText file;
  file.tilt = "TILT=INCLUDE\n1\n3\n0 45 90\n1 0.8 0.9";
  const Luminaire lamp = read(file);
  ASSERT_TRUE(lamp.tilt.has_value());
  EXPECT_DOUBLE_EQ(lamp.tilt->at(0), 1);
  EXPECT_DOUBLE_EQ(lamp.tilt->at(22.5), 0.9);
  EXPECT_DOUBLE_EQ(lamp.tilt->at(90), 0.9);
  EXPECT_DOUBLE_EQ(lamp.tilt->at(135), 0.9);
  write_file("MH.TLT", "1 3 0 45 90 1 0.8 0.9");
  file.tilt = "TILT=MH.TLT";
  EXPECT_EQ(read(file).tilt->factor, lamp.tilt->factor);
}

// Type B: candela come plane by plane of the horizontal angle, which is the polar one; with the
// wrong pole the flux is another.
TEST(IesReader, TypesAAndBKeepTheirAngles) {
  IesText file;
  file.type = "2 2";
  file.vertical = {-90, 0, 90};
  file.horizontal = {0, 45, 90};  // left and right alike
  file.candela = {0, 1000, 0, 0, 600, 0, 0, 0, 0};
  const Luminaire b = read(file);
  EXPECT_NEAR(b.intensity.at({0, 0, -1}), 1000, 1e-9);
  EXPECT_NEAR(b.intensity.at({0, 1, -1}), 600, 1e-9);
  EXPECT_NEAR(b.intensity.at({0, -1, -1}), 600, 1e-9);
  EXPECT_NEAR(b.intensity.at({1, 0, -1}), 500, 1e-9);
  EXPECT_EQ(b.symmetry, "left and right alike");
  file.type = "3 2";
  const Luminaire a = read(file);
  EXPECT_NEAR(a.intensity.at({1, 0, 0}), 1000, 1e-9);
  EXPECT_NEAR(a.intensity.at({1, -1, 0}), 600, 1e-9);
  EXPECT_NEAR(a.intensity.at({1, 0, 1}), 500, 1e-9);
  EXPECT_GT(std::abs(a.flux_lm / b.flux_lm - 1), 0.01);
}

// I = 1000 cos^2 has half its peak at 45 degrees and a tenth at acos(sqrt 0.1).
TEST(Measures, BeamAndFieldOfASquaredCosine) {
  IesText file;
  file.vertical.clear();
  file.candela.clear();
  for (int g = 0; g <= 90; ++g) {
    file.vertical.push_back(g);
    file.candela.push_back(1000 * std::pow(std::cos(g * M_PI / 180), 2) + 1e-9);
  }
  const Luminaire lamp = read(file);
  EXPECT_NEAR(reach_deg(lamp.intensity, {1, 0, 0}, 0.5), 45, 0.01);
  EXPECT_NEAR(reach_deg(lamp.intensity, {0, -1, 0}, 0.1), 71.565, 0.01);
  EXPECT_NEAR(share_behind(lamp.intensity, {0, 0, -1}), 0, 1e-12);
  EXPECT_NEAR(share_behind(lamp.intensity, {0, 0, 1}), 1, 1e-12);
  EXPECT_NEAR(share_behind(lamp.intensity, {0, 1, 0}), 0.5, 1e-3);
}

}  // namespace
}  // namespace scenes
