#include "appearance/spectra/light_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "appearance/spectra/text/input_error.h"

namespace spectra {
namespace {

using testing::HasSubstr;

std::string write(const std::string& name, const std::string& text) {
  const std::string path = testing::TempDir() + "roomhue-light-" + name;
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

/// Sixteen lines of 400, 420, ... 700 nm: what each of them is.
std::string lines(const std::function<std::string(int nm, int k)>& line) {
  std::string text;
  for (int k = 0; k < 16; ++k) text += line(400 + 20 * k, k) + "\n";
  return text;
}

std::string two(const std::string& separator, bool comma = false) {
  return lines([&](int nm, int k) {
    return std::to_string(nm) + separator + std::to_string(k) + (comma ? ",5" : ".5");
  });
}

const std::vector<std::pair<std::string, std::string>> kDialects{
    {"comma", "wavelength,power\n" + two(",")},
    {"blanks", "# made up\n! a lamp\n" + two("   ")},
    {"tab", "nm\tW\r\n" + two("\t")},
    {"tab, decimal comma", two("\t", true)},
    {"semicolon, decimal comma", "nm;Wert\n" + two(";", true)},
    {"byte order mark", "\xEF\xBB\xBFnm,v\n" + two(",")},
    {"CGATS",
     "CGATS.17\nNUMBER_OF_SETS 16\nBEGIN_DATA_FORMAT\nNM V\nEND_DATA_FORMAT\nBEGIN_DATA\n" +
         two(" ") + "END_DATA\n"},
    {"TM-27",
     "<?xml version=\"1.0\"?>\n<IESTM2714 xmlns=\"iestm2714\" version=\"1.0\">"
     "<Header><Manufacturer>none</Manufacturer></Header><SpectralDistribution>"
     "<SpectralQuantity>relative</SpectralQuantity>" +
         lines([](int nm, int k) {
           return "<SpectralData wavelength=\"" + std::to_string(nm) + "\">" + std::to_string(k) +
                  ".5</SpectralData>";
         }) +
         "</SpectralDistribution></IESTM2714>"}};

TEST(LightFile, OneLampInManyDialects) {
  for (const auto& [name, text] : kDialects) {
    const SpectrumFile file = read_light_file(write("dialect", text));
    ASSERT_EQ(file.set.entries.size(), 1) << name;
    const Samples& samples = file.set.entries[0].samples;
    ASSERT_EQ(samples.nm.size(), 16) << name;
    EXPECT_EQ(samples.nm.back(), 700) << name;
    EXPECT_EQ(samples.values[7], 7.5) << name;
  }
}

TEST(LightFile, SeveralColumnsHaveTheNamesOfTheHeading) {
  const std::string text = "nm;warm;cool\n" + lines([](int nm, int k) {
                             return std::to_string(nm) + ";" + std::to_string(k) + ";1,25";
                           });
  const SpectrumFile file = read_light_file(write("two", text));
  ASSERT_EQ(file.set.entries.size(), 2);
  EXPECT_EQ(file.set.entries[0].name, "warm");
  EXPECT_EQ(file.set.entries[1].name, "cool");
  EXPECT_EQ(file.set.entries[1].samples.values[3], 1.25);
}

TEST(LightFile, TheOldTableOfRows) {
  const SpectrumFile file =
      read_light_file(write("rows", "name,400,550,700\nlamp a,1,2,3\nlamp b,3,2,1\n"));
  EXPECT_EQ(file.set.entries.at(1).name, "lamp b");
}

TEST(LightFile, SmallNegativeNoiseIsNothing) {
  const std::string text =
      lines([](int nm, int k) { return std::to_string(nm) + " " + (k == 3 ? "-0.1" : "100"); });
  EXPECT_EQ(read_light_file(write("noise", text)).set.entries[0].samples.values[3], 0);
}

TEST(LightFile, FaultsStandAtTheirPlaces) {
  const auto changed = [](int at, const std::string& line) {
    return lines([&](int nm, int k) { return k == at ? line : std::to_string(nm) + " 1"; });
  };
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "no spectrum"},
      {"# nothing\n", "no spectrum"},
      {changed(4, "480 x"), ":5:5: \"x\" is no number"},
      {changed(4, "480 nan"), "\"nan\" is no number"},
      {changed(4, "480"), ":5:1: 1 numbers"},
      {changed(4, "480 1 2"), ":5:1: 3 numbers"},
      {changed(4, "460 1"), ":5:5: 460 nm after 460 nm"},
      {changed(4, "440 1"), "440 nm after 460 nm"},
      {changed(4, "480 -0.5"), "below -1 %"},
      {changed(15, "7000 1"), "7000 nm is out of range"},
      {lines([](int nm, int) { return "0." + std::to_string(nm) + " 1"; }), "not micrometres"},
      {lines([](int nm, int) { return std::to_string(nm + 20) + " 1"; }), "do not cover"},
      {"400 1\n500 1\n700 2\n", "3 samples"},
      {lines([](int nm, int) { return std::to_string(nm) + " 0"; }), "no light"},
      {"400,5;1\n", "1 samples"},
      {"<IESTM2714><SpectralDistribution>", "no XML"},
      {"<a/>", "no spectrum"},
      {"<a><SpectralDistribution><SpectralQuantity>reflectance</SpectralQuantity>"
       "</SpectralDistribution></a>",
       "a reflectance is no lamp"},
      {"<a><SpectralDistribution><SpectralData wavelength=\"x\">1</SpectralData>"
       "</SpectralDistribution></a>",
       "a sample without two numbers"}};
  for (const auto& [text, words] : cases) {
    try {
      (void)read_light_file(write("bad", text));
      ADD_FAILURE() << "read: " << words;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(words));
      EXPECT_FALSE(error.faults()[0].remedy.empty());
    }
  }
  EXPECT_THROW((void)read_light_file("/nowhere/x.txt"), FileError);
}

}  // namespace
}  // namespace spectra
