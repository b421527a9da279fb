#include "appearance/spectra/spectrum_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "appearance/spectra/text/input_error.h"

namespace spectra {
namespace {

using testing::HasSubstr;

/// A file of this test's own that is gone afterwards.
class SpectrumFileTest : public testing::Test {
 protected:
  SpectrumFile read(const std::string& text, CurveKind kind = CurveKind::reflectance) {
    std::ofstream(path_, std::ios::binary) << text;
    return read_spectrum_file(path_, kind);
  }

  std::vector<std::string> faults(const std::string& text,
                                  CurveKind kind = CurveKind::reflectance) {
    std::vector<std::string> messages;
    try {
      (void)read(text, kind);
    } catch (const InputError& error) {
      for (const Fault& fault : error.faults()) messages.push_back(to_string(fault));
    }
    return messages;
  }

  void TearDown() override { std::filesystem::remove(path_); }

  static std::string path_of_this_test() {
    std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
    std::replace(name.begin(), name.end(), '/', '_');
    return testing::TempDir() + "/spectrum_file_" + name + ".csv";
  }

  std::string path_ = path_of_this_test();
};

TEST_F(SpectrumFileTest, FractionsStayAsTheyAre) {
  const SpectrumFile file = read("name,400,550,700\nsalmon,0.3,0.5,0.85\n\"a, b\",0,0.1,0.999\n");
  EXPECT_FALSE(file.percent);
  EXPECT_EQ(file.set.name, path_);
  ASSERT_EQ(file.set.entries.size(), 2U);
  EXPECT_EQ(file.set.entries[1].name, "a, b");
  EXPECT_THAT(file.set.entries[0].samples.nm, testing::ElementsAre(400, 550, 700));
  EXPECT_THAT(file.set.entries[0].samples.values, testing::ElementsAre(0.3, 0.5, 0.85));
}

TEST_F(SpectrumFileTest, ValuesAboveOneAndAHalfMeanPercent) {
  const SpectrumFile file = read("name,400,700\ndark,0.8,1.2\nlight,40,99.9\n");
  EXPECT_TRUE(file.percent);
  EXPECT_THAT(file.set.entries[0].samples.values, testing::ElementsAre(0.008, 0.012));
}

TEST_F(SpectrumFileTest, LightsMayHaveAnyPower) {
  const SpectrumFile file = read("name,380,780\nlamp,0,1234.5\n", CurveKind::light);
  EXPECT_FALSE(file.percent);
  EXPECT_THAT(file.set.entries[0].samples.values, testing::ElementsAre(0, 1234.5));
}

TEST_F(SpectrumFileTest, EveryFaultOfAFileIsReportedWithItsPlace) {
  const auto messages = faults(
      "name,400,500,450\n"
      "a,0.1,x,0.2\n"
      "a,0.1,0.2,1.2\n"
      ",-0.1,0.2,nan\n");
  ASSERT_EQ(messages.size(), 7U);
  EXPECT_THAT(messages[0], HasSubstr(":1:14: 450: 450 nm after 500 nm"));
  EXPECT_THAT(messages[1], HasSubstr(":3:1: name: \"a\" again, first in line 2"));
  EXPECT_THAT(messages[2], HasSubstr(":4:1: name: no name"));
  EXPECT_THAT(messages[3], HasSubstr(":2:7: 500: \"x\" is not a number"));
  EXPECT_THAT(messages[4], HasSubstr(":4:11: 450: \"nan\" is not a number"));
  EXPECT_THAT(messages[5], HasSubstr(":3:11: 450: 1.2 is out of range"));
  EXPECT_THAT(messages[6], HasSubstr(":4:2: 400: -0.1 is out of range"));
}

struct Refused {
  const char* name;
  const char* text;
  CurveKind kind;
  const char* message;
};

class RefusedSpectrumFile : public SpectrumFileTest, public testing::WithParamInterface<Refused> {};

TEST_P(RefusedSpectrumFile, SaysWhy) {
  const auto messages = faults(GetParam().text, GetParam().kind);
  ASSERT_FALSE(messages.empty());
  EXPECT_THAT(messages[0], HasSubstr(GetParam().message));
}

constexpr CurveKind kReflectance = CurveKind::reflectance, kLight = CurveKind::light;
INSTANTIATE_TEST_SUITE_P(
    Kinds, RefusedSpectrumFile,
    testing::Values(
        Refused{"exactly_one", "name,400,700\na,0.5,1\n", kReflectance, "below 1"},
        Refused{"neither_fraction_nor_percent", "name,400,700\na,0.5,1.4\n", kReflectance, "1.4"},
        Refused{"hundred_percent", "name,400,700\na,50,100\n", kReflectance, "below 100"},
        Refused{"over_hundred", "name,400,700\na,50,120\n", kReflectance, "120 is out of range"},
        Refused{"negative_percent", "name,400,700\na,50,-1\n", kReflectance, "-1 is out of range"},
        Refused{"negative_light", "name,400,700\na,50,-1\n", kLight, "give 0 or more"},
        Refused{"infinite_light", "name,400,700\na,50,inf\n", kLight, "not a number"},
        Refused{"no_rows", "name,400,700\n", kReflectance, "no curves"},
        Refused{"no_wavelengths", "name\na\n", kReflectance, "0 wavelengths"},
        Refused{"semicolons", "name;400;700\na;0.1;0.2\n", kReflectance, "first column"},
        Refused{"no_header", "a,0.1,0.2\nb,0.1,0.3\n", kReflectance, "first column"},
        Refused{"words_for_wavelengths", "name,blue,red\na,0.1,0.2\n", kReflectance,
                "not a wavelength"},
        Refused{"same_wavelength", "name,400,400.0\na,0.1,0.2\n", kReflectance, "400 nm after 400"},
        Refused{"ragged", "name,400,700\na,0.1\n", kReflectance, "2 cells"},
        Refused{"cut_off", "name,400,700\na,0.1,0.2\nb,0.", kReflectance, "2 cells"},
        Refused{"decimal_comma", "name,400,700\na,\"0,1\",0.2\n", kReflectance, "not a number"}),
    [](const auto& kind) { return kind.param.name; });

TEST(ReadSpectrumFile, MissingFileCannotBeRead) {
  EXPECT_THROW((void)read_spectrum_file(TEST_DATA "/no_such.csv", CurveKind::light), FileError);
}

}  // namespace
}  // namespace spectra
