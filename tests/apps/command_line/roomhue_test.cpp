#include <gmock/gmock.h>

#include "tests/apps/program.h"

namespace apps::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

// Coarse patches: these tests are about files and exit codes, not about light.
const std::string kBox = "scenes/rooms/box.json --patch-m 1.4 ";

std::string bands(char quantity) {
  std::string names;
  for (int nm = 400; nm <= 700; nm += 10) names += "," + (quantity + std::to_string(nm));
  return names;
}

TEST(Roomhue, HelpAndVersionAreNoErrors) {
  EXPECT_EQ(roomhue("--help").exit_code, 0);
  EXPECT_THAT(roomhue("--version").out, StartsWith("roomhue "));
  for (const char* command :
       {"check", "solve", "shift", "compare", "rank", "atlas", "mix", "inverse", "appearance",
        "cube", "brick", "batch", "relight", "shader", "verify"}) {
    const ProgramRun run = roomhue(std::string(command) + " --help");
    EXPECT_EQ(run.exit_code, 0) << command;
    EXPECT_THAT(run.out, HasSubstr("Example: roomhue " + std::string(command))) << command;
  }
}

struct UsageError {
  const char* name;
  std::string arguments;
};

class Usage : public ::testing::TestWithParam<UsageError> {};

TEST_P(Usage, IsRefusedWithExitCodeTwo) {
  const ProgramRun run = roomhue(GetParam().arguments);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.out, IsEmpty());
  EXPECT_FALSE(run.err.empty());
}

INSTANTIATE_TEST_SUITE_P(
    Roomhue, Usage,
    ::testing::Values(UsageError{"no_subcommand", ""}, UsageError{"unknown_subcommand", "paint"},
                      UsageError{"unknown_option", "check scenes/rooms/box.json --fast"},
                      UsageError{"no_out", "solve scenes/rooms/box.json"},
                      UsageError{"patch_of_zero", "check scenes/rooms/box.json --patch-m 0"},
                      UsageError{"patch_of_nan", "check scenes/rooms/box.json --patch-m nan"},
                      UsageError{"unknown_method", "solve x.json --out x --method magic"},
                      UsageError{"top_of_zero", "rank x.json --out x --top 0"},
                      UsageError{"unknown_set", "shader --set cmyk"},
                      UsageError{"light_of_two", "relight a b --from 1,1 --to 1,1,1"},
                      UsageError{"light_of_nan", "relight a b --from 1,1,nan --to 1,1,1"},
                      UsageError{"light_below_zero", "relight a b --from 1,1,1 --to 1,1,-1"},
                      UsageError{"set_of_classical",
                                 "relight a b --from 1,1,1 --to 1,1,1 --set iso --classical"},
                      UsageError{"threads_of_zero", "check x.json --threads 0"}),
    [](const auto& usage) { return usage.param.name; });

TEST(Roomhue, MissingFileIsExitCodeFour) {
  const ProgramRun run = roomhue("check no/such/room.json");
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_THAT(run.err, HasSubstr("no/such/room.json"));
}

TEST(Roomhue, BadRoomIsExitCodeThreeWithPlaceAndNothingWritten) {
  const TemporaryFolder folder;
  write_text(folder / "bad.json", "{\n  \"roomhue\": 1,\n  \"colour\": 7\n}\n");
  const ProgramRun run =
      roomhue("solve " + (folder / "bad.json").string() + " --out " + (folder / "out").string());
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.err, HasSubstr("bad.json:3:"));
  EXPECT_THAT(run.err, HasSubstr("/colour"));
  EXPECT_THAT(names_in(folder.path()), ElementsAre("bad.json"));
}

TEST(Roomhue, CheckPrintsThePlanAsJson) {
  const ProgramRun run = roomhue("check " + kBox + "--json");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto plan = nlohmann::json::parse(run.out);
  EXPECT_GT(plan["patches"].get<int>(), 0);
  EXPECT_EQ(plan["bands"].get<int>(), 31);
}

TEST(Roomhue, CheckTellsThatManyPatchesAreGatheredFromCoarseOnes) {
  const ProgramRun run = roomhue("check scenes/rooms/box.json --patch-m 0.02 --json");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto plan = nlohmann::json::parse(run.out);
  EXPECT_GT(plan["fine"]["patches"].get<int>(), 100'000);
  EXPECT_EQ(plan["fine"]["patch_m"], 0.02);
  EXPECT_LT(plan["patches"].get<int>(), 10'000);
  EXPECT_GT(plan["patch_m"].get<double>(), 0.1);
}

TEST(Roomhue, SolveWritesItsThreeFiles) {
  const TemporaryFolder folder;
  const ProgramRun run = roomhue("solve " + kBox + "--out " + (folder / "new/box").string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(names_in(folder / "new/box"),
              ElementsAre("patches.csv", "receivers.csv", "run.json"));
  EXPECT_THAT(first_line(folder / "new/box/receivers.csv"),
              StartsWith("receiver,x_m,y_m,z_m,illuminance_lx" + bands('E')));
  EXPECT_THAT(first_line(folder / "new/box/patches.csv"),
              StartsWith("patch,surface,x_m,y_m,z_m,area_m2" + bands('H') + bands('B')));
}

TEST(Roomhue, RunJsonTellsWhereResultsComeFrom) {
  const TemporaryFolder folder;
  ASSERT_EQ(roomhue("solve " + kBox + "--out " + folder.path().string()).exit_code, 0);
  const auto run = read_json(folder / "run.json");
  EXPECT_EQ(run["status"], "done");
  EXPECT_EQ(run["subcommand"], "solve");
  EXPECT_EQ(run["inputs"].size(), 1U);
  EXPECT_EQ(run["inputs"][0]["sha256"].get<std::string>().size(), 64U);
  EXPECT_EQ(run["solution"]["bands"].size(), 31U);
  EXPECT_EQ(run["grid"]["count"], 31);
  EXPECT_GT(run["peak_memory_bytes"].get<std::int64_t>(), 0);
  // Closure is by scaling in double: what is left is rounding.
  EXPECT_LT(run["transport"]["closure_defect"].get<double>(), 1e-12);
  EXPECT_LT(run["transport"]["reciprocity_defect"].get<double>(), 1e-12);
  // Absorbed = emitted in a closed room, to the accuracy of the solve (1e-6 relative).
  EXPECT_LT(run["solution"]["energy_balance"]["relative_defect"].get<double>(), 1e-5);
  EXPECT_LT(run["extended_ambient_term"]["max_relative_error"].get<double>(), 0.2);
  EXPECT_FALSE(run.contains("fine_patches"));  // all patches were solved
}

TEST(Roomhue, ResultsAreTheSameBitsForOneAndTwoThreads) {
  const TemporaryFolder folder;
  for (const char* threads : {"1", "2"}) {
    ASSERT_EQ(
        roomhue("solve " + kBox + "--threads " + threads + " --out " + (folder / threads).string())
            .exit_code,
        0);
  }
  for (const char* name : {"receivers.csv", "patches.csv"}) {
    EXPECT_EQ(read_text(folder / "1" / name), read_text(folder / "2" / name)) << name;
  }
}

TEST(Roomhue, NotConvergedIsExitCodeFiveWithMarkedOutputs) {
  const TemporaryFolder folder;
  const ProgramRun run =
      roomhue("solve " + kBox + "--relative-error 1e-300 --out " + (folder / "out").string());
  EXPECT_EQ(run.exit_code, 5);
  EXPECT_EQ(read_json(folder / "out/run.json")["status"], "not converged");
  EXPECT_TRUE(fs::exists(folder / "out/receivers.csv"));
}

TEST(Roomhue, UnwritableTargetIsExitCodeFourAndLeavesNothing) {
  const TemporaryFolder folder;
  write_text(folder / "file", "");
  const ProgramRun run = roomhue("solve " + kBox + "--out " + (folder / "file/out").string());
  EXPECT_EQ(run.exit_code, 4);
  fs::create_directories(folder / "out/patches.csv");  // in the way of an output
  EXPECT_EQ(roomhue("solve " + kBox + "--out " + (folder / "out").string()).exit_code, 4);
  EXPECT_THAT(names_in(folder / "out"), ElementsAre("patches.csv"));
}

TEST(Roomhue, FullStandardOutputIsExitCodeFour) {
  const std::string command =
      "cd '" SOURCE_DIR "' && '" ROOMHUE "' check " + kBox + " >/dev/full 2>/dev/null";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 4);
}

TEST(Roomhue, RankOrdersTheAtlasByDistance) {
  const TemporaryFolder folder;
  const ProgramRun run = roomhue("rank " + kBox + "--max-dJ 9 --max-dC 9 --top 3 --json --out " +
                                 folder.path().string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(names_in(folder.path()),
              ElementsAre("model_spread.csv", "model_spread.svg", "ranking.csv", "response.json",
                          "run.json", "shift.csv"));
  EXPECT_THAT(first_line(folder / "ranking.csv"),
              StartsWith("rank,paint,distance,J,a_C,b_C,C,h_deg,H,dJ,da_C,db_C,x,y"));
  const auto paints = nlohmann::json::parse(run.out)["paints"];
  ASSERT_EQ(paints.size(), 3U);
  EXPECT_LE(paints[0]["distance"].get<double>(), paints[1]["distance"].get<double>());
  EXPECT_LE(paints[1]["distance"].get<double>(), paints[2]["distance"].get<double>());
  const auto record = read_json(folder / "run.json");
  EXPECT_GT(record["ranking"]["rejected_by_windows"].get<int>(), 0);
  EXPECT_EQ(record["ranking"]["best"]["paint"], paints[0]["paint"]);
}

// d = |(dJ, da_C, db_C)|: the columns of ranking.csv agree with each other.
TEST(Roomhue, RankingDistanceIsThatOfItsColumns) {
  const TemporaryFolder folder;
  ASSERT_EQ(
      roomhue("rank " + kBox + "--max-dJ 5 --max-dC 5 --max-dh 20 --out " + folder.path().string())
          .exit_code,
      0);
  const auto rows = read_cells(folder / "ranking.csv");
  ASSERT_GT(rows.size(), 1U);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double dj = std::stod(rows[i][9]), da = std::stod(rows[i][10]),
                 db = std::stod(rows[i][11]);
    EXPECT_NEAR(std::stod(rows[i][2]), std::hypot(dj, da, db), 1e-12 * 100);  // J is up to 100
  }
}

TEST(Roomhue, ShiftTellsSwatchRoomAndChangeOfEachPaintedSurface) {
  const TemporaryFolder folder;
  ASSERT_EQ(roomhue("shift " + kBox + "--out " + folder.path().string()).exit_code, 0);
  EXPECT_THAT(first_line(folder / "shift.csv"),
              StartsWith("paint,surface,condition,X,Y,Z,x,y,J,C,h_deg,H,a_C,b_C"));
  const auto rows = read_cells(folder / "shift.csv");
  ASSERT_EQ(rows.size(), 1U + 3 * 4);  // four walls
  EXPECT_EQ(rows[1][2], "swatch");
  EXPECT_EQ(rows[2][2], "room");
  EXPECT_EQ(rows[3][2], "change");
}

TEST(Roomhue, CubeWritesOneRowPerNanometre) {
  const TemporaryFolder folder;
  ASSERT_EQ(
      roomhue("cube scenes/rooms/closed_form/cube.json --out " + folder.path().string()).exit_code,
      0);
  EXPECT_THAT(first_line(folder / "radiosity.csv"), StartsWith("nm,B1,B2,B3,B4,B5,B6"));
  const auto rows = read_cells(folder / "radiosity.csv");
  ASSERT_EQ(rows.size(), 1U + 471);
  EXPECT_EQ(rows[1][0], "360");
  EXPECT_EQ(rows.back()[0], "830");
}

TEST(Roomhue, BrickNamesItsParts) {
  const TemporaryFolder folder;
  ASSERT_EQ(roomhue("brick scenes/rooms/closed_form/brick.json --out " + folder.path().string())
                .exit_code,
            0);
  EXPECT_EQ(first_line(folder / "radiosity.csv"),
            "nm,floor,ceiling,window_wall,window,wall_1,wall_2,wall_3,furniture_1,furniture_2,"
            "furniture_3");
}

TEST(Roomhue, CubeAnswersAWishWithAReflectanceThatRoomFilesTake) {
  const TemporaryFolder folder;
  nlohmann::json file = read_json(SOURCE_DIR "/scenes/rooms/closed_form/cube.json");
  file["reflectance"] = {0.8, 0.8, 0.5, 0.5, 0.25, 0.85};
  const auto cube = [&](const std::string& name) {
    write_text(folder / (name + ".json"), file.dump());
    return roomhue("cube " + (folder / (name + ".json")).string() + " --out " +
                   (folder / name).string());
  };
  file["wished"] = {{"of", "y1"}, {"by", "z0"}, {"radiosity_W_m2_nm", 0.005}};
  const ProgramRun run = cube("wish");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(first_line(folder / "wish" / "wished.csv"),
            "nm,wished,least,limit,reflectance,radiosity,reach");
  const nlohmann::json wished = read_json(folder / "wish" / "run.json")["wished"];
  EXPECT_GT(wished["attained"], 0);
  EXPECT_EQ(wished["too_bright_nm"][0][0], 360);  // where the lamp is dim
  EXPECT_EQ(wished["too_dark_nm"][0][1], 830);    // where the walls are light without it
  EXPECT_THAT(run.err, HasSubstr("360.."));

  file.erase("wished");
  file["reflectance"][4] = {{"file", "wish/reflectance.csv"}, {"name", "z0"}};
  ASSERT_EQ(cube("painted").exit_code, 0);
  EXPECT_EQ(read_text(folder / "painted" / "radiosity.csv"),
            read_text(folder / "wish" / "radiosity.csv"));
}

TEST(Roomhue, PipedOutputHasNeitherColourNorProgress) {
  const TemporaryFolder folder;
  const ProgramRun run =
      roomhue("rank " + kBox + "--max-dJ 5 --max-dC 5 --max-dh 20 --out " + folder.path().string());
  EXPECT_THAT(run.out, ::testing::Not(HasSubstr("\x1b")));
  EXPECT_THAT(run.err, ::testing::Not(HasSubstr("\x1b")));
  EXPECT_THAT(run.out, HasSubstr("swatch -> room"));
}

}  // namespace
}  // namespace apps::test
