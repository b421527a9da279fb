#include "paints/base_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "appearance/spectra/text/input_error.h"

namespace paints {
namespace {

/// A CSV file that lives as long as the test.
class BaseFile : public testing::Test {
 protected:
  std::string write(const std::string& text) {
    path_ = testing::TempDir() + "roomhue_bases_" +
            testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv";
    std::ofstream(path_) << text;
    return path_;
  }

  void TearDown() override {
    if (!path_.empty()) std::filesystem::remove(path_);
  }

  std::vector<spectra::Fault> faults_of(const std::string& text) {
    try {
      (void)load_ingredients(write(text));
    } catch (const spectra::InputError& error) {
      return error.faults();
    }
    ADD_FAILURE() << "accepted";
    return {};
  }

 private:
  std::string path_;
};

// K/S 0.25 at 400 nm and 1.6 at 700 nm: reflectances 0.5 and 0.2.
TEST_F(BaseFile, RowsOfKAndSMakeABase) {
  const Ingredients all = load_ingredients(
      write("name,400,700\nochre K,0.5,3.2\nwhite S,4,4\nochre S,2,2\nwhite K,0.1,0.1\n"));
  EXPECT_TRUE(all.two_constant);
  ASSERT_EQ(all.set.bases.size(), 2U);
  EXPECT_EQ(all.set.bases[0].name, "ochre");
  EXPECT_EQ(all.set.bases[1].name, "white");
  EXPECT_EQ(all.set.bases[1].scattering[12], 4);
  EXPECT_NEAR(all.atlas.paints[0].reflectance.values[0], 0.5, 1e-15);
  EXPECT_NEAR(all.atlas.paints[0].reflectance.values[30], 0.2, 1e-15);
}

TEST_F(BaseFile, RowsOfReflectancesAreSingleConstantBases) {
  const Ingredients all = load_ingredients(write("name,400,700\nvitamin K,0.5,0.5\n"));
  EXPECT_FALSE(all.two_constant);
  EXPECT_EQ(all.set.bases[0].name, "vitamin K");
  EXPECT_NEAR(all.set.bases[0].absorption[3], 0.25, 1e-15);
}

TEST_F(BaseFile, CompiledInAtlasIsAllBases) {
  const Ingredients all = load_ingredients("munsell-nickerson");
  EXPECT_EQ(all.set.bases.size(), 462U);
  EXPECT_TRUE(all.set.left_out.empty());
}

TEST_F(BaseFile, RowWithoutPartnerAndZeroAreNamedWithTheirPlace) {
  const auto faults =
      faults_of("name,400,700\nochre K,0.5,3.2\nochre S,2,0\nwhite K,0.1,0.1\nplain,1,1\n");
  ASSERT_EQ(faults.size(), 3U);
  EXPECT_EQ(faults[0].line, 3);
  EXPECT_EQ(faults[0].pointer, "700");
  EXPECT_EQ(faults[1].line, 4);
  EXPECT_EQ(faults[2].line, 5);
  EXPECT_FALSE(faults[1].remedy.empty());
}

TEST_F(BaseFile, RangeThatFallsShortIsAFault) {
  const auto faults = faults_of("name,420,700\nochre K,0.5,3.2\nochre S,2,2\n");
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_THAT(faults[0].problem, testing::HasSubstr("400..420"));
}

TEST_F(BaseFile, MissingFileIsAFileError) {
  EXPECT_THROW((void)load_ingredients("no/such/atlas.csv"), spectra::FileError);
}

}  // namespace
}  // namespace paints
