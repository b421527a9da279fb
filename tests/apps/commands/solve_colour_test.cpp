// roomhue solve --colour.
#include <gmock/gmock.h>

#include "tests/apps/program.h"

namespace apps::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// Coarse patches: these tests are about files and exit codes, not about light.
const std::string kBox = "scenes/rooms/box.json --patch-m 1.4 ";
const std::string kCornell = "scenes/rooms/colour/cornell_cyan.json --patch-m 0.2 ";

TEST(SolveColour, ThreeNumbersNameTheirColumns) {
  const TemporaryFolder folder;
  const ProgramRun run =
      roomhue("solve " + kBox + "--colour bilinear --out " + folder.path().string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(names_in(folder.path()), ElementsAre("patches.csv", "receivers.csv", "run.json"));
  EXPECT_THAT(first_line(folder / "receivers.csv"),
              StartsWith("receiver,x_m,y_m,z_m,illuminance_lx,Er,Eg,Eb"));
  EXPECT_THAT(first_line(folder / "patches.csv"),
              StartsWith("patch,surface,x_m,y_m,z_m,area_m2,Hr,Hg,Hb,Br,Bg,Bb"));
}

TEST(SolveColour, RunJsonTellsModelMatricesAndWhatIsNegative) {
  const TemporaryFolder folder;
  const ProgramRun run =
      roomhue("solve " + kCornell + "--colour bilinear:granier-iso:alpha=0.3,0,0 --out " +
              folder.path().string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto record = read_json(folder / "run.json");
  EXPECT_EQ(record["options"]["colour"], "bilinear:granier-iso:alpha=0.3,0,0");
  EXPECT_EQ(record["colour"]["model"], "bilinear:granier-iso:alpha=0.3,0,0");
  EXPECT_EQ(record["colour"]["space"], "iso");
  EXPECT_THAT(record["colour"]["approximation"].get<std::string>(), HasSubstr("three numbers"));
  EXPECT_EQ(record["colour"]["reflections"]["left"].size(), 3U);
  EXPECT_EQ(record["solution"]["method"], "bicgstab");
  EXPECT_EQ(record["solution"]["error_bounds"], "estimated");  // with linear light
  EXPECT_EQ(record["solution"]["bands"][2]["component"], "b");
  EXPECT_LT(record["solution"]["energy_balance"]["relative_defect"].get<double>(), 1e-5);
  // The lamp has no red, and the green wall takes some away.
  EXPECT_GT(record["colour"]["negative"]["patches_of_radiosity"].get<int>(), 0);
  EXPECT_LT(record["colour"]["negative"]["lowest_relative_to_brightest"].get<double>(), 0);
  EXPECT_THAT(run.err, HasSubstr("negative components"));
}

TEST(SolveColour, SpectralIsTheDefault) {
  const TemporaryFolder folder;
  ASSERT_EQ(roomhue("solve " + kBox + "--out " + (folder / "a").string()).exit_code, 0);
  ASSERT_EQ(
      roomhue("solve " + kBox + "--colour spectral --out " + (folder / "b").string()).exit_code, 0);
  EXPECT_EQ(read_text(folder / "a/patches.csv"), read_text(folder / "b/patches.csv"));
}

// r, g, b are photometric: the illuminance is that of the spectra but for what the model changes.
TEST(SolveColour, IlluminanceIsNearThatOfSpectra) {
  const TemporaryFolder folder;
  for (const char* colour : {"spectral", "rgb", "bilinear", "display"}) {
    ASSERT_EQ(
        roomhue("solve " + kBox + "--colour " + colour + " --out " + (folder / colour).string())
            .exit_code,
        0);
  }
  const double spectral = std::stod(read_cells(folder / "spectral/receivers.csv")[1][4]);
  for (const char* colour : {"rgb", "bilinear", "display"}) {
    const double lux = std::stod(read_cells(folder / colour / "receivers.csv")[1][4]);
    EXPECT_NEAR(lux / spectral, 1, 0.05) << colour;
  }
}

// The red of this yellow paper is 1.04 in the iso space.
TEST(SolveColour, LightThatGrowsIsExitCodeFiveWithTheFactor) {
  const TemporaryFolder folder;
  auto room = read_json(fs::path(SOURCE_DIR) / "scenes/rooms/box.json");
  const nlohmann::json yellow{{"paint", "munsell-nickerson:446"}};
  room["surfaces"] = {{"floor", yellow}, {"ceiling", yellow}, {"walls", yellow}};
  write_text(folder / "yellow.json", room.dump());
  const ProgramRun run =
      roomhue("solve " + (folder / "yellow.json").string() +
              " --patch-m 1.4 --colour rgb:iso --out " + (folder / "out").string());
  EXPECT_EQ(run.exit_code, 5);
  EXPECT_THAT(run.err, HasSubstr("light grows by 1.0"));
  const auto record = read_json(folder / "out/run.json");
  EXPECT_EQ(record["status"], "not converged");
  EXPECT_EQ(record["solution"]["error_bounds"], "estimated");
  EXPECT_TRUE(record["solution"]["bands"][0]["max_error_bound"].is_null());
  EXPECT_TRUE(fs::exists(folder / "out/receivers.csv"));
}

TEST(SolveColour, RefusesUnknownModelsAndMethodsThatDoNotSuit) {
  const TemporaryFolder folder;
  const std::string out = " --out " + (folder / "out").string();
  const ProgramRun unknown = roomhue("solve " + kBox + "--colour cmyk" + out);
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("bilinear"));
  const ProgramRun direct_only =
      roomhue("solve " + kBox + "--colour display:reference-light" + out);
  EXPECT_EQ(direct_only.exit_code, 2);
  EXPECT_THAT(direct_only.err, HasSubstr("direct light only"));
  const ProgramRun unsuited = roomhue("solve " + kBox + "--colour bilinear --method cg" + out);
  EXPECT_EQ(unsuited.exit_code, 2);
  EXPECT_THAT(unsuited.err, HasSubstr("bicgstab"));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

}  // namespace
}  // namespace apps::test
