#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "tests/apps/program.h"

namespace apps::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// Coarse patches: these tests are about recipes and files, not about light.
const std::string kMix = "mix scenes/rooms/box.json --patch-m 1.4 ";

constexpr const char* kPaints =
    "name,400,500,600,700\n"
    "white,0.80,0.88,0.90,0.90\nblack,0.03,0.03,0.03,0.03\nred,0.06,0.05,0.50,0.70\n"
    "yellow,0.06,0.30,0.75,0.80\nblue,0.40,0.20,0.06,0.08\n";

class Mix : public ::testing::Test {
 protected:
  Mix() { write_text(folder_ / "paints.csv", kPaints); }

  ProgramRun mix(const std::string& options, const std::string& out = "out") {
    return roomhue(kMix + "--atlas " + (folder_ / "paints.csv").string() + " --out " +
                   (folder_ / out).string() + " " + options);
  }

  TemporaryFolder folder_;
};

TEST_F(Mix, MorePairsThanAnyoneWaitsForAreRefusedWithTheirNumber) {
  std::string many = "name,400,500,600,700\n";
  for (int k = 0; k < 5001; ++k) many += fmt::format("p{},0.3,0.4,0.5,{}\n", k, 0.1 + k * 1e-4);
  write_text(folder_ / "paints.csv", many);
  const ProgramRun run = mix("--bases 2");
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.err, HasSubstr("5001 paints make 12502500 pairs"));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(Mix, WritesRecipesThatAddUpAndComeNearerThanTheBestPaint) {
  const ProgramRun run = mix("--bases 3 --top 5");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(names_in(folder_ / "out"),
              ElementsAre("mixtures.csv", "recipes.csv", "response.json", "run.json"));
  EXPECT_THAT(first_line(folder_ / "out/recipes.csv"),
              StartsWith("rank,recipe,bases,distance,gain,J,a_C,b_C"));
  const auto rows = read_cells(folder_ / "out/recipes.csv");
  ASSERT_EQ(rows.size(), 6U);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    double parts = 0;
    for (const std::size_t column : {17U, 19U, 21U, 23U}) {
      if (!rows[i][column].empty()) parts += std::stod(rows[i][column]);
    }
    EXPECT_NEAR(parts, 100, 1e-9);
  }
  EXPECT_GT(std::stod(rows[1][4]), 0.33);  // gain over the best paint; 0.34 on short patches
  const auto record = read_json(folder_ / "out/run.json");
  EXPECT_EQ(record["subcommand"], "mix");
  EXPECT_TRUE(record["mixing"]["search"]["global_triples"].get<bool>());
  EXPECT_LT(record["mixing"]["best"]["differs_from_full_solve"].get<double>(), 0.01);
}

// The room sees the mixture as an atlas paint just as it did as a recipe.
TEST_F(Mix, MixturesAreAnAtlasThatRankAgreesWith) {
  ASSERT_EQ(mix("--bases 2 --top 4").exit_code, 0);
  const ProgramRun ranked =
      roomhue("rank scenes/rooms/box.json --patch-m 1.4 --resolve-top 0 --atlas " +
              (folder_ / "out/mixtures.csv").string() + " --out " + (folder_ / "ranked").string());
  ASSERT_EQ(ranked.exit_code, 0) << ranked.err;
  const auto recipes = read_cells(folder_ / "out/recipes.csv");
  const auto ranking = read_cells(folder_ / "ranked/ranking.csv");
  ASSERT_EQ(recipes.size(), ranking.size());
  for (std::size_t i = 1; i < recipes.size(); ++i) {
    EXPECT_EQ(recipes[i][1], ranking[i][1]);
    EXPECT_NEAR(std::stod(recipes[i][3]), std::stod(ranking[i][2]), 1e-4);  // two responses
  }
}

TEST_F(Mix, StepsAreKept) {
  ASSERT_EQ(mix("--bases 3 --step 5 --top 3 --saunderson 0.01,0.5").exit_code, 0);
  const auto rows = read_cells(folder_ / "out/recipes.csv");
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double parts = std::stod(rows[i][17]) / 5;
    EXPECT_NEAR(parts, std::round(parts), 1e-9);
  }
}

TEST_F(Mix, PaintsTooDarkForTheSurfaceAreNamed) {
  const ProgramRun run = mix("--bases 1 --saunderson 0.04,0.6 --json");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("black"));
  EXPECT_EQ(nlohmann::json::parse(run.out)["recipes"][0]["parts"][0]["parts"], 100);
}

TEST_F(Mix, OptionsWithoutMeaningAreUsageErrors) {
  for (const char* options : {"--bases 5", "--bases 0", "--step 3", "--step 0", "--step 200",
                              "--saunderson 0.04", "--saunderson 0.04,1", "--saunderson -1,0"}) {
    EXPECT_EQ(mix(options).exit_code, 2) << options;
  }
}

}  // namespace
}  // namespace apps::test
