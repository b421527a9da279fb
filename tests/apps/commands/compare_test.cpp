#include <gmock/gmock.h>

#include <map>
#include <set>
#include <sstream>

#include "apps/reports/compare_report.h"
#include "tests/apps/program.h"

namespace apps::test {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::StartsWith;

/// A closed room of two kinds of surface under a panel.
json room(const json& walls, const json& rest, const json& light) {
  json file = json::parse(R"({
    "roomhue": 1, "name": "test room", "height_m": 2.5, "patch_m": 1.5,
    "plan_m": [[0, 0], [4, 0], [4, 3], [0, 3]],
    "lights": [{ "name": "panel", "flux_lm": 3000,
                 "panel": { "on": "ceiling", "center_m": [2, 1.5], "size_m": [1, 1] } }]
  })");
  file["surfaces"] = {{"floor", rest}, {"ceiling", rest}, {"walls", walls}};
  file["lights"][0]["spectrum"] = light;
  return file;
}

/// Worst Delta E_00 by method.
std::map<std::string, double> compare(const json& room_file) {
  const TemporaryFolder folder;
  write_text(folder / "room.json", room_file.dump());
  const ProgramRun run =
      roomhue("compare --json --relative-error 1e-9 " + (folder / "room.json").string() +
              " --out " + (folder / "out").string());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  std::map<std::string, double> worst;
  const json printed = json::parse(run.out);
  for (const json& method : printed.at("methods")) {
    worst[method.at("method")] = method.at("worst_dE00");
  }
  return worst;
}

/// A curve that has one value below 495 nm, one up to 605 nm, and one above.
json three_steps(double blue, double green, double red) {
  json nm = json::array(), values = json::array();
  for (int w = 400; w <= 700; w += 10) {
    nm.push_back(w);
    values.push_back(w < 495 ? blue : w < 605 ? green : red);
  }
  return {{"nm", nm}, {"values", values}};
}

// Grey surfaces only dim light, whatever stands for a spectrum; but few bands tell lamps apart
// badly.
TEST(Compare, MethodsAgreeInAGreyRoom) {
  const auto of_lamp = compare(room(0.7, 0.4, json{{"illuminant", "A"}}));
  EXPECT_EQ(of_lamp.size(), 17U);
  for (const auto& [method, de00] : of_lamp) {
    if (method != "spectral:9" && method != "spectral:3") {
      EXPECT_LT(de00, 1e-4) << method;
    }
  }
  const auto of_equal_energy = compare(room(0.7, 0.4, json{{"illuminant", "E"}}));
  for (const auto& [method, de00] : of_equal_energy) EXPECT_LT(de00, 1e-4) << method;
}

// The groups of 10, 11 and 10 bands: what is constant over them loses nothing.
TEST(Compare, ThreeBandsAreEnoughForSpectraOfThreeSteps) {
  const auto worst =
      compare(room(three_steps(0.2, 0.4, 0.8), three_steps(0.7, 0.6, 0.7), three_steps(1, 2, 4)));
  EXPECT_LT(worst.at("spectral:3"), 1e-4);
  EXPECT_GT(worst.at("rgb:srgb"), 0.1);
}

TEST(Compare, WritesItsFilesWithARowPerMethodAndSurface) {
  const TemporaryFolder folder;
  const ProgramRun run =
      roomhue("compare scenes/rooms/box.json --patch-m 1.4 --out " + (folder / "out").string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("bilinear:granier-iso"));
  EXPECT_THAT(names_in(folder / "out"),
              ElementsAre("compare.csv", "methods.csv", "run.json", "summary.md"));
  EXPECT_THAT(first_line(folder / "out" / "compare.csv"),
              StartsWith("method,surface,X,Y,Z,J,a_C,b_C,distance,dE00,seconds"));

  const auto rows = read_cells(folder / "out" / "compare.csv");
  const std::size_t surfaces = 6, methods = 17;
  ASSERT_EQ(rows.size(), 1 + surfaces * methods);
  std::set<std::string> names;
  for (std::size_t i = 1; i < rows.size(); ++i) names.insert(rows[i][0]);
  EXPECT_EQ(names.size(), methods);
  EXPECT_THAT(names, IsSupersetOf({"spectral:31", "spectral:3", "rgb:srgb", "bilinear:iso",
                                   "display:spectral", "display:lamps", "reconstructed:smits"}));
  for (std::size_t i = 1; i <= surfaces; ++i) {  // the judge comes first
    EXPECT_EQ(rows[i][0], "spectral:31");
    EXPECT_EQ(rows[i][8], "0");
    EXPECT_EQ(rows[i][9], "0");
  }
  EXPECT_EQ(read_json(folder / "out" / "run.json").at("methods").size(), methods);
}

// The judge is the very solve that `shift` looks at.
TEST(Compare, JudgeSeesWhatShiftSees) {
  const TemporaryFolder folder;
  const std::string room = "scenes/rooms/box.json --patch-m 1.4 --out ";
  ASSERT_EQ(roomhue("compare " + room + (folder / "compare").string()).exit_code, 0);
  ASSERT_EQ(roomhue("shift " + room + (folder / "shift").string()).exit_code, 0);
  std::string compared, shifted;
  for (const auto& row : read_cells(folder / "compare" / "compare.csv")) {
    if (row[0] == "spectral:31" && row[1] == "north") compared = row[2] + " " + row[5];
  }
  for (const auto& row : read_cells(folder / "shift" / "shift.csv")) {
    if (row[1] == "north" && row[2] == "room") shifted = row[3] + " " + row[8];
  }
  ASSERT_FALSE(compared.empty() || shifted.empty());
  std::istringstream a(compared), b(shifted);
  for (int i = 0; i < 2; ++i) {
    double x = 0, y = 0;
    a >> x;
    b >> y;
    EXPECT_NEAR(x, y, 1e-9 * y);
  }
}

TEST(Compare, NeedsASurfaceThatReflects) {
  const TemporaryFolder folder;
  write_text(folder / "black.json", room(0, 0, json{{"illuminant", "A"}}).dump());
  const ProgramRun run = roomhue("compare " + (folder / "black.json").string() + " --out " +
                                 (folder / "out").string());
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.err, HasSubstr("/surfaces"));
  EXPECT_THAT(names_in(folder.path()), ElementsAre("black.json"));
}

/// A judge and one method of each kind that misses by `de00`.
Comparison comparison_with(double de00) {
  Comparison comparison{.room = "a room", .patches = 7, .surfaces = {"floor", "north"}};
  for (const char* name : {"spectral:31", "spectral:9", "rgb:srgb", "bilinear:iso",
                           "display:spectral", "reconstructed:smits"}) {
    MethodVerdict method{.name = name, .what = "", .seconds = 0.001, .colours = {}, .surfaces = {}};
    method.surfaces.resize(2);
    if (!comparison.methods.empty()) method.surfaces[1].de00 = de00;
    comparison.methods.push_back(method);
  }
  return comparison;
}

TEST(CompareSummary, SaysWhetherThreeNumbersAreEnough) {
  EXPECT_THAT(summary(comparison_with(0.4)),
              HasSubstr("**Yes, with the right method.** The best of the methods with three "
                        "numbers is rgb:srgb: it misses by a Delta E00 of at most 0.40 on north"));
  EXPECT_THAT(summary(comparison_with(1.5)), HasSubstr("**Nearly.**"));
  EXPECT_THAT(summary(comparison_with(7)), HasSubstr("**No.**"));
}

TEST(CompareSummary, PassesOverMethodsWithoutAnAnswer) {
  Comparison comparison = comparison_with(0.4);
  comparison.methods[2].surfaces[1].de00 = 0;
  comparison.methods[2].colours.converged = false;
  comparison.methods[3].colours.negative_patches = 5;
  const std::string text = summary(comparison);
  EXPECT_THAT(text, HasSubstr("three numbers is bilinear:iso"));
  EXPECT_THAT(text, HasSubstr("srgb found no answer."));
  EXPECT_THAT(text, HasSubstr("iso has less than no light on 5 patches."));
}

TEST(ColourVerdict, MeanAndWorstPassOverUndefinedDistances) {
  MethodVerdict method;
  method.surfaces.resize(3);
  method.surfaces[0].distance = 1;
  method.surfaces[2].distance = 4;
  EXPECT_EQ(distance_of(method).mean, 2.5);
  EXPECT_EQ(distance_of(method).worst, 4);
  EXPECT_EQ(distance_of(method).worst_surface, 2U);
}

}  // namespace
}  // namespace apps::test
