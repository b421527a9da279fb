// The choices of white, background, size and swatch through the program, from file to table.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tests/apps/program.h"

namespace apps::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

using Table = std::vector<std::map<std::string, std::string>>;

Table read_table(const fs::path& path) {
  const auto cells = read_cells(path);
  Table table;
  for (std::size_t r = 1; r < cells.size(); ++r) {
    auto& row = table.emplace_back();
    for (std::size_t c = 0; c < cells[r].size(); ++c) row[cells[0][c]] = cells[r][c];
  }
  return table;
}

class Choices : public testing::Test {
 protected:
  Choices() : room_(read_json(SOURCE_DIR "/scenes/rooms/box.json")) { room_["patch_m"] = 1; }

  ProgramRun run(const std::string& command, const std::string& out) {
    write_text(folder_ / "room.json", room_.dump());
    return roomhue(command + " " + (folder_ / "room.json").string() + " --out " +
                   (folder_ / out).string());
  }

  Table ranking(const std::string& out, const std::string& options = "") {
    const ProgramRun ran = run("rank" + options, out);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return read_table(folder_ / out / "ranking.csv");
  }

  Table ranking_seen(const json& view, const std::string& out) {
    room_["view"].update(view);
    return ranking(out);
  }

  void expect_same(const Table& p, const Table& q) {
    ASSERT_EQ(p.size(), q.size());
    for (std::size_t i = 0; i < p.size(); ++i) {
      for (const char* name : {"distance", "J", "a_C", "b_C"}) {
        EXPECT_NEAR(std::stod(p[i].at(name)), std::stod(q[i].at(name)), 1e-9) << name;
      }
    }
  }

  TemporaryFolder folder_;
  json room_;
};

TEST_F(Choices, InARoomWithoutBouncesTheWhitesAreOne) {
  for (const char* surface : {"floor", "ceiling", "south", "east", "west"}) {
    room_["surfaces"][surface] = 0;
  }
  room_["paint"]["surfaces"] = {"north"};
  expect_same(ranking_seen({{"white", "lamps"}}, "lamps"),
              ranking_seen({{"white", "ideal"}}, "all"));
}

TEST_F(Choices, InAGreyRoomTheShareDoesNotMatter) {
  std::string header = "name";
  std::map<std::string, std::string> greys;
  for (int nm = 400; nm <= 700; nm += 10) {
    header += "," + std::to_string(nm);
    for (const char* grey : {"0.2", "0.5", "0.8"}) greys[grey] += std::string(",") + grey;
  }
  std::string text = header + "\n";
  for (const auto& [name, values] : greys) text += "grey " + name + values + "\n";
  write_text(folder_ / "greys.csv", text);
  room_["surfaces"]["walls"] = 0.5;
  room_["paint"]["atlas"] = "greys.csv";
  const Table one = ranking_seen({{"white", {{"share", 1}}}}, "one");
  ASSERT_EQ(one.size(), 3U);
  expect_same(one, ranking_seen({{"white", {{"share", 0.4}}}}, "some"));
  expect_same(one, ranking_seen({{"white", {{"share", 0}}}}, "none"));
}

TEST_F(Choices, ShareOneIsTheDefaultBitForBit) {
  EXPECT_EQ(ranking_seen({{"white", {{"share", 1}}}, {"size_effect", false}}, "one"),
            ranking_seen({{"white", "ideal"}}, "default"));
}

TEST_F(Choices, ASwatchHeldInTheStandardLightIsTheStandard) {
  const Table standard = ranking("standard");
  room_["paint"]["target"]["seen"] = {{"spectrum", {{"illuminant", "D65"}}},
                                      {"illuminance_lx", 2000},
                                      {"Y_b", 20},
                                      {"surround", "average"}};
  expect_same(standard, ranking("own"));
}

TEST_F(Choices, ThePresentPaintIsTheOneThatLooksLikeItsSwatchHere) {
  room_["paint"]["target"]["seen"] = "here";
  const Table here = ranking("here");
  EXPECT_EQ(here[0].at("paint"), room_["paint"]["target"]["paint"]);
  EXPECT_LT(std::stod(here[0].at("distance")), 1e-9);
}

TEST_F(Choices, HereIsTheRoomAsItIsEvenIfItsWallsDiffer) {
  room_["paint"]["target"]["seen"] = "here";
  room_["surfaces"]["east"] = 0.3;
  const ProgramRun ran = run("rank", "here");
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_GT(std::stod(read_table(folder_ / "here" / "ranking.csv")[0].at("distance")), 0.1);
}

TEST_F(Choices, TheSizeEffectSaysThatItsConstantsAreUnverified) {
  room_["view"]["size_effect"] = true;
  const ProgramRun ran = run("rank", "size");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("unverified constants"));
  const json view = read_json(folder_ / "size" / "run.json")["viewing"];
  EXPECT_EQ(view["size_effect"]["caution"], "unverified constants");
  EXPECT_GT(view["size_effect"]["angle_deg"], 50);
}

TEST_F(Choices, InverseMeetsTheWishWithAllOfThem) {
  room_["view"].update(
      {{"white", {{"share", 0.5}}}, {"background", 20}, {"size_effect", {{"angle_deg", 30}}}});
  room_["paint"]["target"]["angle_deg"] = 4;
  const ProgramRun ran = run("inverse", "inverse");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const json told = read_json(folder_ / "inverse" / "run.json")["inverse"];
  EXPECT_TRUE(told["exact"]);
  EXPECT_LT(told["largest_distance_by_full_solves"], 1e-6);
}

TEST_F(Choices, TheSpreadHasEveryChoiceAndItsOwnRanks) {
  const Table best = ranking("rank");
  const Table spread = read_table(folder_ / "rank" / "model_spread.csv");
  std::map<std::string, int> first;
  for (const auto& row : spread) {
    if (row.at("rank") == "1") ++first[row.at("choice")];
    if (row.at("asked") == "yes" && row.at("rank") == "1") {
      EXPECT_EQ(row.at("paint"), best[0].at("paint"));
      EXPECT_EQ(row.at("distance"), best[0].at("distance"));
    }
    EXPECT_EQ(row.at("caution") == "unverified constants", row.at("size_effect") == "on");
  }
  EXPECT_EQ(first.size(), 8U);
  for (const auto& [choice, count] : first) EXPECT_EQ(count, 1) << choice;
  EXPECT_THAT(read_text(folder_ / "rank" / "model_spread.svg"), HasSubstr("</svg>"));
}

TEST_F(Choices, RobustRankingIsByTheLargestDistance) {
  const Table plain = ranking("plain"), robust = ranking("robust", " --robust");
  const Table spread = read_table(folder_ / "robust" / "model_spread.csv");
  std::map<std::string, double> largest;
  for (const auto& row : spread) {
    double& worst = largest[row.at("paint")];
    worst = std::max(worst, std::stod(row.at("distance")));
  }
  const auto at = [&](const std::string& paint) { return largest.at(paint); };
  ASSERT_TRUE(largest.contains(plain[0].at("paint")));
  if (largest.contains(robust[0].at("paint"))) {
    for (const auto& [paint, worst] : largest) EXPECT_LE(at(robust[0].at("paint")), worst);
  }
}

TEST_F(Choices, ShiftTellsTheSpreadOfEverySurface) {
  ASSERT_EQ(run("shift", "shift").exit_code, 0);
  const Table shift = read_table(folder_ / "shift" / "shift.csv");
  for (const auto& row : read_table(folder_ / "shift" / "model_spread.csv")) {
    if (row.at("asked") != "yes") continue;
    for (const auto& s : shift) {
      if (s.at("surface") != row.at("paint") || s.at("condition") != "room") continue;
      for (const char* name : {"J", "a_C", "b_C"}) EXPECT_EQ(s.at(name), row.at(name));
    }
  }
}

TEST_F(Choices, TheAtlasIsSeenOnTheSwatchWhereTheTargetIsHeld) {
  room_["paint"]["target"]["seen"] = "here";
  ASSERT_EQ(run("atlas", "atlas").exit_code, 0);
  bool found = false;
  for (const auto& row : read_table(folder_ / "atlas" / "atlas.csv")) {
    if (row.at("paint") != room_["paint"]["target"]["paint"]) continue;
    found = true;  // the walls are painted with it now
    EXPECT_LT(std::stod(row.at("distance")), 1e-9);
  }
  EXPECT_TRUE(found);
}

TEST_F(Choices, HeldBeforeAWallItsSwatchLooksLikeTheWall) {
  room_["paint"]["target"]["seen"] = "here";
  ASSERT_EQ(run("shift", "shift").exit_code, 0);
  for (const auto& row : read_table(folder_ / "shift" / "shift.csv")) {
    if (row.at("condition") != "change") continue;
    for (const char* name : {"J", "C", "a_C", "b_C"}) {
      EXPECT_NEAR(std::stod(row.at(name)), 0, 1e-9) << row.at("surface");
    }
  }
  for (const auto& row : read_table(folder_ / "shift" / "model_spread.csv")) {
    if (row.at("size_effect") == "off") {
      EXPECT_LT(std::stod(row.at("distance")), 1e-9) << row.at("choice");
    }
  }
}

// Both panels have one spectrum, so by their flux or by their light on a wall the white is one.
TEST_F(Choices, ACeilingThatNoLampSeesTakesTheLampsByTheirFluxAndSaysSo) {
  room_["view"]["white"] = "lamps";
  ASSERT_EQ(run("rank", "wall").exit_code, 0);
  room_["view"]["look_at_m"] = {0.6, 0.6, room_["height_m"]};
  room_["paint"]["surfaces"] = {"ceiling"};
  room_["surfaces"]["ceiling"] = room_["paint"]["target"];
  for (const char* command : {"rank", "shift", "atlas", "inverse", "mix --step 50"}) {
    SCOPED_TRACE(command);
    const ProgramRun ran = run(command, "ceiling");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr("no lamp shines on the viewed point"));
    json seen = read_json(folder_ / "ceiling" / "run.json")["viewing"];
    if (seen.is_array()) seen = seen[0];
    EXPECT_EQ(seen["surface"], "ceiling");
    EXPECT_THAT(seen["white_lamps"].get<std::string>(), HasSubstr("no lamp sees"));
    const json white = read_json(folder_ / "wall" / "run.json")["viewing"]["white_XYZ"];
    for (const int i : {0, 1, 2}) {
      EXPECT_NEAR(seen["white_XYZ"][i].get<double>(), white[i].get<double>(), 1e-9);
    }
  }
}

TEST_F(Choices, AFaultThatOnlyTheCommandFindsHasItsLineToo) {
  room_["paint"]["surfaces"] = {"ceiling"};
  room_["paint"]["target"]["seen"] = "here";
  const ProgramRun ran = run("rank", "out");
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_THAT(ran.err, testing::ContainsRegex("room.json:1:[0-9]+: /view: looks at"));
}

TEST_F(Choices, EveryCommandSaysThatTheSizeEffectIsUnverified) {
  room_["view"]["size_effect"] = true;
  for (const char* command :
       {"rank", "shift", "atlas", "inverse", "mix --step 50", "compare", "solve"}) {
    SCOPED_TRACE(command);
    const ProgramRun ran = run(std::string("--json ") + command, "out");
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr("unverified constants"));
    EXPECT_THAT(ran.out, HasSubstr("unverified constants"));
    EXPECT_THAT(read_text(folder_ / "out" / "run.json"), HasSubstr("unverified constants"));
    for (const char* name : {"ranking.csv", "shift.csv", "atlas.csv", "orders.csv", "recipes.csv",
                             "appearance.csv", "compare.csv"}) {
      const fs::path path = folder_ / "out" / name;
      if (!fs::exists(path)) continue;
      for (const auto& row : read_table(path)) {
        EXPECT_EQ(row.at("caution"), "unverified constants") << name;
      }
      fs::remove(path);
    }
  }
}

class ChoicesOfSamples : public testing::TestWithParam<const char*> {};

TEST_P(ChoicesOfSamples, ShareOneIsTheDefaultBitForBit) {
  const TemporaryFolder folder;
  json room = read_json(std::string(SOURCE_DIR "/scenes/rooms/") + GetParam() + ".json");
  room["patch_m"] = 3 * room["patch_m"].get<double>();
  const auto shift = [&](const std::string& name) {
    write_text(folder / (name + ".json"), room.dump());
    const ProgramRun ran = roomhue("shift " + (folder / (name + ".json")).string() + " --out " +
                                   (folder / name).string());
    EXPECT_TRUE(ran.exit_code == 0 || ran.exit_code == 5) << ran.err;
    return read_text(folder / name / "shift.csv") + read_text(folder / name / "model_spread.csv");
  };
  const std::string as_it_is = shift("default");
  room["view"]["white"] = {{"share", 1}};
  EXPECT_EQ(shift("one"), as_it_is);
}

INSTANTIATE_TEST_SUITE_P(Rooms, ChoicesOfSamples,
                         testing::Values("box", "corridor", "daylight", "l_room", "living_room",
                                         "office", "tungsten", "two_rooms"));

}  // namespace
}  // namespace apps::test
