#include "paints/atlas_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "appearance/spectra/spectrum_library.h"
#include "appearance/spectra/text/input_error.h"

namespace paints {
namespace {

using testing::HasSubstr;

/// A CSV file that lives as long as the test.
class AtlasFile : public testing::Test {
 protected:
  std::string write(const std::string& text) {
    path_ = testing::TempDir() + "roomhue_atlas_" +
            testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv";
    std::ofstream(path_) << text;
    return path_;
  }

  void TearDown() override {
    if (!path_.empty()) std::filesystem::remove(path_);
  }

 private:
  std::string path_;
};

TEST_F(AtlasFile, CompiledInAtlasesComeWithEveryPaper) {
  const Atlas atlas = load_atlas("munsell-nickerson");
  EXPECT_EQ(atlas.name, "munsell-nickerson");
  EXPECT_EQ(atlas.paints.size(), 462U);
  EXPECT_EQ(atlas.paints.front().name, "001");
  EXPECT_FALSE(atlas.source.empty());
  EXPECT_FALSE(atlas.reconstructed);
  for (const Paint& paint : atlas.paints) {
    EXPECT_EQ(paint.reflectance.grid, spectra::kTransportGrid);
    EXPECT_EQ(paint.reflectance.values.size(), spectra::kTransportGrid.count);
    EXPECT_GE(paint.reflectance.values.minCoeff(), 0) << paint.name;
    EXPECT_LT(paint.reflectance.values.maxCoeff(), 1) << paint.name;
  }
}

TEST_F(AtlasFile, FileIsInterpolatedToTheGrid) {
  const Atlas atlas = load_atlas(write("name,400,700\nramp,0.1,0.7\n\"a, b\",0.2,0.2\n"));
  ASSERT_EQ(atlas.paints.size(), 2U);
  EXPECT_EQ(atlas.paints[0].name, "ramp");
  EXPECT_EQ(atlas.paints[1].name, "a, b");
  EXPECT_NEAR(atlas.paints[0].reflectance.values[15], 0.4, 1e-15);  // 550 nm, the middle
  EXPECT_FALSE(atlas.percent);
}

TEST_F(AtlasFile, PercentIsDividedAndSaid) {
  const Atlas atlas = load_atlas(write("name,400,700\ngrey,20,20\n"));
  EXPECT_TRUE(atlas.percent);
  EXPECT_NEAR(atlas.paints[0].reflectance.values[3], 0.2, 1e-15);
}

TEST_F(AtlasFile, RangeThatFallsShortIsAFaultThatNamesTheGap) {
  const std::string path = write("name,420,700\ngrey,0.2,0.2\n");
  try {
    (void)load_atlas(path);
    FAIL() << "accepted";
  } catch (const spectra::InputError& error) {
    ASSERT_EQ(error.faults().size(), 1U);
    EXPECT_EQ(error.faults()[0].file, path);
    EXPECT_EQ(error.faults()[0].line, 1);
    EXPECT_THAT(error.faults()[0].problem, HasSubstr("400..420"));
    EXPECT_FALSE(error.faults()[0].remedy.empty());
  }
}

TEST_F(AtlasFile, FaultsOfTheFilePassThrough) {
  EXPECT_THROW((void)load_atlas(write("name,400,700\ngrey,0.2,blue\n")), spectra::InputError);
}

TEST_F(AtlasFile, UnknownNameIsAnsweredWithTheKnownOnes) {
  try {
    (void)load_atlas("munsell-nickersen");
    FAIL() << "accepted";
  } catch (const spectra::FileError& error) {
    EXPECT_THAT(error.what(), HasSubstr("munsell-nickerson"));
    EXPECT_THAT(error.what(), HasSubstr("munsell-renotation"));
  }
}

}  // namespace
}  // namespace paints
