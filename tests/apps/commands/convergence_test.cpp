#include <gmock/gmock.h>

#include <map>
#include <set>

#include "tests/apps/program.h"

namespace apps::test {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::StartsWith;

/// The rows of convergence.csv, by column name.
std::vector<std::map<std::string, std::string>> runs_in(const fs::path& folder) {
  const auto cells = read_cells(folder / "convergence.csv");
  std::vector<std::map<std::string, std::string>> runs;
  for (std::size_t i = 1; i < cells.size(); ++i) {
    EXPECT_EQ(cells[i].size(), cells[0].size());
    runs.emplace_back();
    for (std::size_t k = 0; k < cells[i].size(); ++k) runs.back()[cells[0][k]] = cells[i][k];
  }
  return runs;
}

double number(const std::map<std::string, std::string>& run, const std::string& column) {
  return std::stod(run.at(column));
}

/// A grey room under a panel, with a box in it if wished.
json grey_room(bool furnished) {
  json file = json::parse(R"({
    "roomhue": 1, "name": "grey room", "height_m": 2.5, "patch_m": 1.5,
    "plan_m": [[0, 0], [4, 0], [4, 3], [0, 3]],
    "surfaces": { "floor": 0.3, "ceiling": 0.8, "walls": 0.6 },
    "lights": [{ "name": "panel", "flux_lm": 3000, "spectrum": { "illuminant": "A" },
                 "panel": { "on": "ceiling", "center_m": [2, 1.5], "size_m": [1, 1] } }],
    "receivers": [ { "name": "wall", "at_m": [2, 3, 1.2], "normal": [0, -1, 0] } ]
  })");
  if (furnished) {
    file["furniture"] =
        json::parse(R"([{ "name": "box", "box_m": { "min": [1.5, 1, 0], "max": [2.5, 2, 1] } }])");
    file["surfaces"]["box"] = 0.5;
  }
  return file;
}

TEST(Convergence, WritesARowPerRunAndErrorsThatFallWithPatchSizeAndTolerance) {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  const ProgramRun run =
      roomhue("convergence scenes/rooms/box.json --patch-m 1.4 --out " + out.string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("What to use"));
  EXPECT_THAT(names_in(out), ElementsAre("convergence.csv", "convergence.svg", "iterations.svg",
                                         "run.json", "summary.txt"));
  EXPECT_THAT(first_line(out / "convergence.csv"),
              StartsWith("factor,method,setting,patches,iterations,setup_s,solve_s,"
                         "max_relative_error,rms_relative_error,distance_Jab,kendall_tau,"
                         "top10_overlap,reference"));
  EXPECT_EQ(read_text(out / "summary.txt"), run.out);
  EXPECT_THAT(read_text(out / "summary.txt"), HasSubstr("ray counts: nothing can stand between"));

  std::set<std::string> factors, methods;
  std::map<double, double> error_by_patch_m, error_by_tolerance;
  for (const auto& row : runs_in(out)) {
    factors.insert(row.at("factor"));
    if (row.at("factor") == "method") methods.insert(row.at("method"));
    if (row.at("factor") == "patch_m" || row.at("factor") == "baseline") {
      error_by_patch_m[number(row, "patch_m")] = number(row, "rms_relative_error");
      EXPECT_GT(number(row, "kendall_tau"), 0.5);
    }
    if (row.at("factor") == "method" && row.at("method") == "gauss-seidel") {
      error_by_tolerance[number(row, "relative_error")] = number(row, "own_max_relative_error");
    }
    // What is proven of the mean holds: the closed form is no farther than the solver's bound.
    if (row.at("factor") == "reflectance" && row.at("converged") == "yes") {
      EXPECT_LT(number(row, "max_relative_error"), 1e-6) << row.at("method");
    }
  }
  EXPECT_THAT(factors, IsSupersetOf({"baseline", "method", "patch_m", "bands", "reflectance"}));
  EXPECT_EQ(factors.count("rays"), 0U);
  EXPECT_THAT(methods, IsSupersetOf({"extended ambient term", "cg", "jacobi", "gauss-seidel",
                                     "progressive", "progressive with ambient term",
                                     "progressive with overshoot", "direct"}));
  ASSERT_GE(error_by_patch_m.size(), 4U);
  EXPECT_LT(2 * error_by_patch_m.begin()->second, error_by_patch_m.rbegin()->second);
  ASSERT_GE(error_by_tolerance.size(), 5U);
  for (const auto& [tolerance, error] : error_by_tolerance) EXPECT_LT(error, 10 * tolerance);
}

// A grey room is solved on any bands: 81 of them judge, and furniture needs rays.
TEST(Convergence, CountsRaysBehindFurnitureAnd81BandsWhereTheInputsReach) {
  const TemporaryFolder folder;
  write_text(folder / "room.json", grey_room(true).dump());
  const ProgramRun run = roomhue("convergence --json " + (folder / "room.json").string() +
                                 " --out " + (folder / "out").string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  std::map<std::string, double> error_by_bands;
  std::set<std::string> rays;
  for (const auto& row : runs_in(folder / "out")) {
    if (row.at("factor") == "rays") rays.insert(row.at("setting"));
    if (row.at("factor") == "bands") {
      error_by_bands[row.at("setting")] = number(row, "max_relative_error");
    }
    EXPECT_EQ(row.at("kendall_tau"), "");
  }
  EXPECT_THAT(rays, ElementsAre("128", "16", "256", "32", "64"));
  ASSERT_EQ(error_by_bands.size(), 4U);
  EXPECT_LT(error_by_bands.at("81"), 1e-5);
  EXPECT_LT(error_by_bands.at("31"), 0.02);  // the light beyond 400..700 nm
  EXPECT_GT(error_by_bands.at("3"), 0.02);
  EXPECT_THAT(json::parse(run.out).at("convergence").dump(), HasSubstr("paints no surfaces"));
}

TEST(Convergence, RefusedInputsLeaveNothingBehind) {
  const TemporaryFolder folder;
  json dark = grey_room(false);
  dark["lights"] = json::array();
  write_text(folder / "dark.json", dark.dump());
  write_text(folder / "room.json", grey_room(false).dump());
  const auto exit_code = [&](const std::string& arguments) {
    return roomhue("convergence " + arguments).exit_code;
  };
  const std::string out = " --out " + (folder / "out").string();
  EXPECT_EQ(exit_code((folder / "dark.json").string() + out), 3);
  EXPECT_EQ(exit_code((folder / "none.json").string() + out), 4);
  EXPECT_EQ(exit_code((folder / "room.json").string() + " --seconds 0" + out), 2);
  EXPECT_EQ(exit_code((folder / "room.json").string()), 2);
  EXPECT_EQ(exit_code((folder / "room.json").string() + " --out " +
                      (folder / "room.json" / "below").string()),
            4);
  EXPECT_THAT(names_in(folder.path()), ElementsAre("dark.json", "room.json"));
}

TEST(Convergence, AShortTimeLeavesRunsOutAndSaysSo) {
  const TemporaryFolder folder;
  write_text(folder / "room.json", grey_room(false).dump());
  const ProgramRun run = roomhue("convergence --seconds 1e-9 " + (folder / "room.json").string() +
                                 " --out " + (folder / "out").string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(runs_in(folder / "out").size(), 2U);  // the baseline and the extended ambient term
  EXPECT_THAT(run.out, HasSubstr("jacobi 0.1: the time is over"));
  EXPECT_THAT(run.out, HasSubstr("the error of the mesh is not measured"));
}

}  // namespace
}  // namespace apps::test
