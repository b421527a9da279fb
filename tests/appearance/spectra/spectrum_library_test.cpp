#include "appearance/spectra/spectrum_library.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "appearance/spectra/compiled_tables.h"
#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/tristimulus.h"

namespace spectra {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const Spectrum& light_c() {
  static const Spectrum light = light_on(kTransportGrid, illuminant("C"));
  return light;
}

/// Colours of the renotation on the scale of a perfect diffuser, by name.
std::map<std::string, RelativeXyz> renotation() {
  std::map<std::string, RelativeXyz> colours;
  for (const CsvRow& row : compiled_table(CompiledTable::munsell_renotation).rows) {
    const double x = compiled_number(row.cells[1]), y = compiled_number(row.cells[2]);
    const double luminance = 0.975 * compiled_number(row.cells[3]);
    colours[row.cells[0]] = {luminance * x / y, luminance, luminance * (1 - x - y) / y};
  }
  return colours;
}

TEST(Atlas, NickersonHasItsMeasuredPapers) {
  const SpectrumSet& papers = atlas("munsell-nickerson");
  ASSERT_EQ(papers.entries.size(), 462U);
  EXPECT_FALSE(papers.reconstructed);
  EXPECT_EQ(papers.entries.front().name, "001");
  EXPECT_EQ(papers.entries.back().name, "462");
  for (const NamedSpectrum& paper : papers.entries) {
    EXPECT_EQ(missing_range(paper.samples, kTransportGrid), "");
    const auto [low, high] =
        std::minmax_element(paper.samples.values.begin(), paper.samples.values.end());
    EXPECT_GT(*low, 0.01) << paper.name;  // the padding of the source would be 0
    EXPECT_LT(*high, 0.95) << paper.name;
  }
}

/// CIELAB of a colour under illuminant C.
Eigen::Vector3d lab(const RelativeXyz& xyz) {
  const RelativeXyz white = relative_xyz(constant(kTransportGrid, 1), light_c());
  const auto f = [](double ratio) {
    return ratio > 216.0 / 24389 ? std::cbrt(ratio) : (24389.0 / 27 * ratio + 16) / 116;
  };
  const double fx = f(xyz.x / white.x), fy = f(xyz.y / white.y), fz = f(xyz.z / white.z);
  return {116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)};
}

// The labels were found with sums at 5 nm; here 31 bands, so a chip may come out nearer by a
// little.
TEST(Atlas, LabelsNameTheNearestChip) {
  std::map<std::string, Eigen::Vector3d> chips;
  for (const auto& [name, xyz] : renotation()) chips[name] = lab(xyz);
  for (const NamedSpectrum& paper : atlas("munsell-nickerson").entries) {
    const Eigen::Vector3d own =
        lab(relative_xyz(reflectance_on(kTransportGrid, paper.samples), light_c()));
    double nearest = 1e9;
    for (const auto& [name, chip] : chips) nearest = std::min(nearest, (chip - own).norm());
    ASSERT_TRUE(paper.label.starts_with("near "));
    EXPECT_LT((chips.at(paper.label.substr(5)) - own).norm(), nearest + 0.5) << paper.name;
  }
}

// The five left out lie outside the object-colour solid of the 31 bands under C (found by linear
// programming: no curve within 0..1 has their colour), so there is nothing to reconstruct.
TEST(Atlas, RenotationHasTheColourOfEveryChipThatAReflectanceCanHave) {
  auto colours = renotation();
  ASSERT_EQ(colours.size(), 2729U);
  const SpectrumSet& chips = atlas("munsell-renotation");
  EXPECT_TRUE(chips.reconstructed);
  EXPECT_THAT(chips.source, HasSubstr("5 chips"));
  for (const NamedSpectrum& chip : chips.entries) {
    const Spectrum rho = reflectance_on(kTransportGrid, chip.samples);
    const RelativeXyz xyz = relative_xyz(rho, light_c()), wanted = colours.at(chip.name);
    EXPECT_NEAR(xyz.x, wanted.x, 1e-9) << chip.name;
    EXPECT_NEAR(xyz.y, wanted.y, 1e-9) << chip.name;
    EXPECT_NEAR(xyz.z, wanted.z, 1e-9) << chip.name;
    EXPECT_GT(rho.values.minCoeff(), 0) << chip.name;
    EXPECT_LT(rho.values.maxCoeff(), 1) << chip.name;
    colours.erase(chip.name);
  }
  std::vector<std::string> left_out;
  for (const auto& [name, xyz] : colours) left_out.push_back(name);
  EXPECT_THAT(left_out, testing::UnorderedElementsAre("2.5B 4/16", "2.5Y 8/20", "5GY 8/20",
                                                      "7.5PB 1/38", "7.5R 2/14"));
}

TEST(Lamps, HouserHasItsLampsWithLabels) {
  const SpectrumSet& set = lamps("houser");
  ASSERT_EQ(set.entries.size(), 401U);
  for (const NamedSpectrum& lamp : set.entries) {
    EXPECT_FALSE(lamp.label.empty()) << lamp.name;
    EXPECT_EQ(lamp.label.find('\n'), std::string::npos) << lamp.name;
    EXPECT_EQ(*std::max_element(lamp.samples.values.begin(), lamp.samples.values.end()), 1);
  }
}

// A lamp with lines whose colour is known: F10 is (0.3458, 0.3588) among the fluorescent
// illuminants of [CIE15].
TEST(Lamps, CieF10HasItsPublishedChromaticity) {
  const auto& entries = lamps("houser").entries;
  const auto f10 = std::find_if(entries.begin(), entries.end(), [](const NamedSpectrum& lamp) {
    return lamp.label.ends_with("CIE F10");
  });
  ASSERT_NE(f10, entries.end());
  const Chromaticity c = chromaticity(absolute_xyz(light_on(kClosedFormGrid, f10->samples)));
  EXPECT_NEAR(c.x, 0.3458, 5e-4);  // 1 nm sums of straight lines instead of 5 nm sums
  EXPECT_NEAR(c.y, 0.3588, 5e-4);
}

TEST(Find, NumbersCountWithOrWithoutLeadingZeros) {
  const NamedSpectrum* paper = find_paint("munsell-nickerson:007").spectrum;
  EXPECT_EQ(paper->name, "007");
  EXPECT_EQ(find_paint("munsell-nickerson:7").spectrum, paper);
  EXPECT_EQ(find_lamp("houser:12").spectrum->name, "12");
  EXPECT_EQ(find_lamp("houser:012").set, &lamps("houser"));
}

TEST(Find, RenotationChipsGoByTheirNames) {
  EXPECT_EQ(find_paint("munsell-renotation:5YR 6/4").spectrum->name, "5YR 6/4");
  EXPECT_THAT([] { (void)find_paint("munsell-renotation:5YR6/4"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("5YR 6/4")));
}

TEST(Find, UnknownNamesAreRefusedWithWhatThereIs) {
  const auto paint_refusal = [](const char* name, const char* words) {
    EXPECT_THAT([=] { (void)find_paint(name); },
                ThrowsMessage<std::invalid_argument>(HasSubstr(words)));
  };
  paint_refusal("munsel:7", "munsell-nickerson, munsell-renotation");
  paint_refusal("munsell-nickerson:463", "462 entries");
  paint_refusal("munsell-nickerson:0", "462 entries");
  paint_refusal("munsell-nickerson:", "462 entries");
  paint_refusal("munsell-nickerson", "ATLAS:NAME");
  paint_refusal("", "ATLAS:NAME");
  EXPECT_THAT([] { (void)find_lamp("houser:402"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("401 entries")));
  EXPECT_THAT([] { (void)find_lamp("house:1"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("houser")));
}

}  // namespace
}  // namespace spectra
