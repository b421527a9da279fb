// roomhue inverse: from a wish to a reflectance, and back through a room file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/apps/program.h"

namespace apps::test {
namespace {

using testing::HasSubstr;

class Inverse : public testing::Test {
 protected:
  /// The box, wishing a colour, as a file of its own.
  void write_room(const nlohmann::json& target) {
    room_ = read_json(SOURCE_DIR "/scenes/rooms/box.json");
    room_["patch_m"] = 1;
    room_["paint"]["target"] = target;
    write_text(folder_ / "room.json", room_.dump());
  }

  ProgramRun run(const std::string& command, const std::string& out) {
    return roomhue(command + " " + (folder_ / "room.json").string() + " --out " +
                   (folder_ / out).string());
  }

  TemporaryFolder folder_;
  nlohmann::json room_;
};

// The reflectance goes back into the room file, and the room shows the wish.
TEST_F(Inverse, ReflectanceInARoomFileLooksAsWished) {
  write_room({{"paint", "munsell-nickerson:231"}});
  const ProgramRun inverse = run("inverse", "inverse");
  ASSERT_EQ(inverse.exit_code, 0) << inverse.err;
  EXPECT_THAT(inverse.out, HasSubstr("exact"));
  EXPECT_EQ(first_line(folder_ / "inverse" / "inverse.csv"), "nm,reflectance,bound_multiplier");
  const nlohmann::json told = read_json(folder_ / "inverse" / "run.json")["inverse"];
  EXPECT_TRUE(told["exact"]);
  EXPECT_TRUE(told["limit"].is_null());
  EXPECT_LT(told["largest_distance_by_full_solves"], 1e-6);

  room_["surfaces"]["walls"] = {{"file", "inverse/reflectance.csv"}, {"name", "inverse"}};
  write_text(folder_ / "room.json", room_.dump());
  ASSERT_EQ(run("shift", "shift").exit_code, 0);
  const auto rows = read_cells(folder_ / "shift" / "shift.csv");
  const auto column = [&](const std::string& name) {
    return std::ranges::find(rows[0], name) - rows[0].begin();
  };
  bool compared = false;
  for (const auto& row : rows) {
    if (row[1] != "north" || row[2] != "room") continue;  // the wall that is viewed
    for (const char* name : {"J", "a_C", "b_C"}) {
      EXPECT_NEAR(std::stod(row[static_cast<std::size_t>(column(name))]),
                  told["target"][name].get<double>(), 1e-6);
    }
    compared = true;
  }
  EXPECT_TRUE(compared);
}

TEST_F(Inverse, OutOfReachGivesTheNearestWithItsProof) {
  write_room({{"J", 70}, {"C", 110}, {"h_deg", 250}});
  const ProgramRun inverse = run("inverse", "inverse");
  ASSERT_EQ(inverse.exit_code, 0) << inverse.err;
  EXPECT_THAT(inverse.out, HasSubstr("out of reach"));
  const nlohmann::json told = read_json(folder_ / "inverse" / "run.json")["inverse"];
  EXPECT_FALSE(told["exact"]);
  EXPECT_GT(told["distance"], 10);
  EXPECT_TRUE(told["limit"]["proves"]);
  const auto nearest = read_cells(folder_ / "inverse" / "ranking.csv");
  EXPECT_GE(std::stod(nearest[1][2]), told["distance"].get<double>() - 1e-6);
}

TEST_F(Inverse, WithoutATargetIsAFaultOfTheRoom) {
  write_room({});
  room_["paint"].erase("target");
  write_text(folder_ / "room.json", room_.dump());
  const ProgramRun inverse = run("inverse", "inverse");
  EXPECT_EQ(inverse.exit_code, 3);
  EXPECT_THAT(inverse.err, HasSubstr("/paint/target"));
}

}  // namespace
}  // namespace apps::test
