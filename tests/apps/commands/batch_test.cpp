#include <gmock/gmock.h>

#include "tests/apps/program.h"

namespace apps::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// An empty room with one lamp: solved in no time.
std::string tiny_room(double reflectance) {
  return R"({ "roomhue": 1, "name": "tiny", "plan_m": [[0, 0], [2, 0], [2, 2], [0, 2]],
    "height_m": 2, "patch_m": 1, "surfaces": { "floor": )" +
         std::to_string(reflectance) + R"(, "ceiling": 0.8, "walls": 0.5 },
    "lights": [ { "name": "lamp", "panel": { "on": "ceiling", "center_m": [1, 1],
      "size_m": [0.5, 0.5] }, "spectrum": { "illuminant": "A" }, "flux_lm": 1000 } ] })";
}

struct Batch : ::testing::Test {
  Batch() {
    fs::create_directory(folder / "rooms");
    write_text(folder / "rooms/a.json", tiny_room(0.2));
    write_text(folder / "rooms/b.json", tiny_room(0.4));
  }

  [[nodiscard]] ProgramRun run(const std::string& options = "") const {
    return roomhue("batch " + (folder / "rooms").string() + " --out " + out.string() + " " +
                   options);
  }

  /// The cells of one column of summary.csv, in the order of the rooms.
  [[nodiscard]] std::vector<std::string> column(std::size_t index) const {
    std::vector<std::string> cells;
    const auto rows = read_cells(out / "summary.csv");
    for (std::size_t i = 1; i < rows.size(); ++i) cells.push_back(rows[i][index]);
    return cells;
  }

  [[nodiscard]] std::vector<std::string> statuses() const { return column(1); }

  TemporaryFolder folder;
  fs::path out = folder / "out";
};

TEST_F(Batch, GivesEachRoomAFolder) {
  EXPECT_EQ(run().exit_code, 0);
  EXPECT_THAT(names_in(out), ElementsAre("a", "b", "summary.csv"));
  EXPECT_THAT(names_in(out / "a"), ElementsAre("patches.csv", "receivers.csv", "run.json"));
  EXPECT_THAT(first_line(out / "summary.csv"), StartsWith("room,status,exit_code,message"));
  EXPECT_THAT(statuses(), ElementsAre("done", "done"));
}

TEST_F(Batch, GoesOnPastABadRoomAndSaysSo) {
  write_text(folder / "rooms/a.json", "{}");
  EXPECT_EQ(run().exit_code, 6);
  EXPECT_THAT(statuses(), ElementsAre("failed", "done"));
  EXPECT_THAT(column(2), ElementsAre("3", "0"));
  EXPECT_THAT(column(3)[0], HasSubstr("a.json:1:"));
  EXPECT_FALSE(fs::exists(out / "a"));
}

TEST_F(Batch, SkipsWhatIsDoneAndRedoesWhatChanged) {
  ASSERT_EQ(run().exit_code, 0);
  const auto written = fs::last_write_time(out / "a/run.json");
  write_text(folder / "rooms/b.json", tiny_room(0.6));
  EXPECT_EQ(run().exit_code, 0);
  EXPECT_THAT(statuses(), ElementsAre("unchanged", "done"));
  EXPECT_EQ(fs::last_write_time(out / "a/run.json"), written);
}

TEST_F(Batch, RedoesARoomWithOtherOptions) {
  ASSERT_EQ(run().exit_code, 0);
  EXPECT_EQ(run("--patch-m 0.7").exit_code, 0);
  EXPECT_THAT(statuses(), ElementsAre("done", "done"));
}

TEST_F(Batch, RedoesARoomThatLostAnOutput) {
  ASSERT_EQ(run().exit_code, 0);
  fs::remove(out / "a/patches.csv");
  EXPECT_EQ(run().exit_code, 0);
  EXPECT_THAT(statuses(), ElementsAre("done", "unchanged"));
  EXPECT_TRUE(fs::exists(out / "a/patches.csv"));
}

TEST_F(Batch, RedoesARoomWhoseRecordIsDamaged) {
  ASSERT_EQ(run().exit_code, 0);
  write_text(out / "a/run.json", R"({ "status": 7, "outputs": [3] )");
  EXPECT_EQ(run().exit_code, 0);
  EXPECT_THAT(statuses(), ElementsAre("done", "unchanged"));
}

TEST_F(Batch, RetriesWhatFailed) {
  write_text(folder / "rooms/a.json", "{}");
  ASSERT_EQ(run().exit_code, 6);
  write_text(folder / "rooms/a.json", tiny_room(0.2));
  EXPECT_EQ(run().exit_code, 0);
  EXPECT_THAT(statuses(), ElementsAre("done", "unchanged"));
}

TEST_F(Batch, ReadsAListAndKeepsEqualStemsApart) {
  fs::create_directory(folder / "more");
  write_text(folder / "more/a.json", tiny_room(0.1));
  write_text(folder / "list.txt", "# two rooms of one name\nrooms/a.json\n\nmore/a.json\n");
  const ProgramRun list =
      roomhue("batch " + (folder / "list.txt").string() + " --out " + out.string());
  EXPECT_EQ(list.exit_code, 0) << list.err;
  EXPECT_THAT(names_in(out), ElementsAre("a", "a-2", "summary.csv"));
}

TEST_F(Batch, MissingListIsExitCodeFour) {
  EXPECT_EQ(roomhue("batch no/such/list --out " + out.string()).exit_code, 4);
  EXPECT_FALSE(fs::exists(out));
}

}  // namespace
}  // namespace apps::test
