#include <gmock/gmock.h>

#include "apps/reports/verify_report.h"
#include "tests/apps/program.h"

namespace apps::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<solver::Check> kRight{{"cube", "radiosity, W/m2/nm", 2, 2 + 1e-9, 1e-6},
                                        {"sphere", "irradiance, W/m2/nm", 3, 3, 1e-6}};

std::vector<solver::Check> one_wrong() {
  std::vector<solver::Check> checks = kRight;
  checks[1].computed = 3.00001;
  return checks;
}

TEST(Verify, OneFailedCaseIsExitCodeSeven) {
  EXPECT_EQ(static_cast<int>(verdict(kRight)), 0);
  EXPECT_EQ(static_cast<int>(verdict(one_wrong())), 7);
}

TEST(Verify, FailureIsMarkedInTableAndFile) {
  EXPECT_THAT(verify_table(kRight), Not(HasSubstr("FAIL")));
  EXPECT_THAT(verify_table(one_wrong()), HasSubstr("FAIL"));
  EXPECT_EQ(verify_csv(one_wrong()).substr(0, 63),
            "case,quantity,expected,computed,relative_error,tolerance,verdic");
  EXPECT_THAT(verify_csv(one_wrong()), HasSubstr("cube,\"radiosity, W/m2/nm\",2,2.000000001,"));
  EXPECT_THAT(verify_csv(one_wrong()), HasSubstr(",1e-06,fail\r\n"));
}

TEST(Verify, ProgramPassesAndWritesItsFiles) {
  const TemporaryFolder folder;
  const ProgramRun run = roomhue("verify --json --out " + (folder / "out").string());
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  EXPECT_THAT(names_in(folder / "out"), ElementsAre("run.json", "verify.csv"));
  const auto data = nlohmann::json::parse(run.out);
  EXPECT_EQ(data["passed"], data["cases"]);
  EXPECT_EQ(read_cells(folder / "out/verify.csv").size(), data["cases"].get<std::size_t>() + 1);
}

}  // namespace
}  // namespace apps::test
