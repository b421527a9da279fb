#include <gmock/gmock.h>

#include "tests/apps/program.h"

namespace apps::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kHeader = "id,X,Y,Z,Xw,Yw,Zw,L_A,Y_b,F,c,N_c\n";

struct AppearanceTable : ::testing::Test {
  /// Runs the command on `in` and returns what it said; the result is in out.csv.
  [[nodiscard]] ProgramRun convert(const std::string& table,
                                   const std::string& options = "") const {
    write_text(folder / "in.csv", table);
    return roomhue("appearance " + (folder / "in.csv").string() + " --out " + out.string() + " " +
                   options);
  }

  TemporaryFolder folder;
  fs::path out = folder / "out.csv";
};

// The worked example of [CIE159]: 19.01, 20, 21.78 under D65 at 318.31 cd/m^2.
TEST_F(AppearanceTable, PublishedExampleAndOtherColumnsKept) {
  ASSERT_EQ(
      convert(kHeader + "grey,19.01,20,21.78,95.05,100,108.88,318.31,20,1,0.69,1\n").exit_code, 0);
  EXPECT_THAT(first_line(out), StartsWith("id,X,Y,Z,Xw,Yw,Zw,L_A,Y_b,F,c,N_c,"
                                          "J,C,h_deg,H,Q,M,s,a_C,b_C,status"));
  const auto row = read_cells(out)[1];
  EXPECT_EQ(row[0], "grey");
  EXPECT_NEAR(std::stod(row[12]), 41.73, 0.005);  // printed to two decimals
  EXPECT_NEAR(std::stod(row[13]), 0.1, 0.05);     // printed to one
  EXPECT_NEAR(std::stod(row[14]), 219.0, 0.05);
  EXPECT_EQ(row[21], "OK");
}

TEST_F(AppearanceTable, InverseOfItsOwnOutputReturnsTheStimulus) {
  ASSERT_EQ(convert(kHeader + "a,57.06,43.06,31.96,95.05,100,108.88,31.83,20,1,0.69,1\n").exit_code,
            0);
  ASSERT_EQ(convert(read_text(out), "--inverse").exit_code, 0);
  const auto rows = read_cells(out);
  const auto column = [&](const std::string& name) {
    const auto at = std::find(rows[0].begin(), rows[0].end(), name);
    return std::stod(rows[1][static_cast<std::size_t>(at - rows[0].begin())]);
  };
  EXPECT_EQ(std::count(rows[0].begin(), rows[0].end(), "X"), 1);
  EXPECT_NEAR(column("X"), 57.06, 1e-9 * 57);  // 1e-9: what the inverse promises
  EXPECT_NEAR(column("Y"), 43.06, 1e-9 * 43);
  EXPECT_NEAR(column("Z"), 31.96, 1e-9 * 32);
}

TEST_F(AppearanceTable, RowsOutsideTheModelAreMarkedAndLeftEmpty) {
  ASSERT_EQ(convert(kHeader + "no_white,19,20,21,95,0,108,318,20,1,0.69,1\n"
                              "nan,nan,20,21,95,100,108,318,20,1,0.69,1\n")
                .exit_code,
            0);
  const auto rows = read_cells(out);
  for (std::size_t i : {1U, 2U}) {
    EXPECT_EQ(rows[i][21], "DOMAIN");
    EXPECT_EQ(rows[i][12], "");
    EXPECT_EQ(rows[i][20], "");
  }
}

TEST_F(AppearanceTable, EveryBadNumberIsNamedAndNothingWritten) {
  const ProgramRun run =
      convert(kHeader + "a,19.01,twenty,21.78,95.05,100,108.88,318,20,1,0.69,1\n" +
              "b,19.01,20,21.78,95.05,100,108.88,,20,1,0.69,1\n");
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.err, HasSubstr("in.csv:2:"));
  EXPECT_THAT(run.err, HasSubstr("twenty"));
  EXPECT_THAT(run.err, HasSubstr("in.csv:3:"));
  EXPECT_THAT(run.err, HasSubstr("L_A"));
  EXPECT_THAT(names_in(folder.path()), ElementsAre("in.csv"));
}

TEST_F(AppearanceTable, EveryMissingColumnIsNamed) {
  const ProgramRun run = convert("X,Y,Z,Xw,Yw,Zw,L_A,F,c\n1,1,1,1,1,1,1,1,1\n");
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.err, HasSubstr("Y_b"));
  EXPECT_THAT(run.err, HasSubstr("N_c"));
}

}  // namespace
}  // namespace apps::test
