// `roomhue lamp` and `roomhue sky`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/program.h"

namespace apps {
namespace {

using test::TemporaryFolder;
namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string kPanel = std::string(SOURCE_DIR) + "/scenes/rooms/lamps/ward_panel.ies";

TEST(Lamp, TellsWhatIsInAFile) {
  const TemporaryFolder folder;
  const fs::path svg = folder / "panel.svg";
  const auto run = test::roomhue("lamp " + kPanel + " --json --out " + svg.string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto lamp = nlohmann::json::parse(run.out);
  double sum = 0;
  for (const auto& zone : lamp["zones"]) sum += zone["flux_lm"].get<double>();
  EXPECT_NEAR(sum / lamp["flux_lm"].get<double>(), 1, 1e-9);
  // Half of the peak is left a little nearer to the axis than for a cosine, 60 degrees.
  EXPECT_NEAR(lamp["beam_angle_deg"]["C0_C180"].get<double>(), 116, 6);
  EXPECT_EQ(lamp["size_m"][0], 0.56);
  EXPECT_THAT(test::read_text(svg), HasSubstr("C0 to the right"));
  EXPECT_THAT(test::roomhue("lamp " + kPanel).out, HasSubstr("60 to 80 degrees"));
}

TEST(Lamp, RefusesWhatIsNoLamp) {
  const TemporaryFolder folder;
  test::write_text(folder / "x.ies", "IESNA91\nTILT=NONE\n1 1\n");
  const auto run = test::roomhue("lamp " + (folder / "x.ies").string());
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.err, HasSubstr("x.ies:"));
  EXPECT_EQ(test::roomhue("lamp " + (folder / "none.ies").string()).exit_code, 4);
}

TEST(Sky, TellsOfAnHour) {
  const TemporaryFolder folder;
  const std::string head =
      "LOCATION,Somewhere,-,DEU,TMY,1,52.47,13.40,1.0,49.0\n1\n2\n3\n4\n5\n6\n7\n";
  const std::string hour = ",0,?,18,9.5,55,101000,900,1300,330,500,512,210,0,0\n";
  test::write_text(folder / "w.epw", head + "2005,6,20,12" + hour + "2005,6,20,24" + hour);
  const std::string path = (folder / "w.epw").string();
  const auto noon = test::roomhue("sky --epw " + path + " --hour 1 --json");
  ASSERT_EQ(noon.exit_code, 0) << noon.err;
  const auto sky = nlohmann::json::parse(noon.out);
  EXPECT_NEAR(sky["altitude_deg"].get<double>(), 60.1, 0.1);
  EXPECT_NEAR(sky["skylight_lx"].get<double>() / 210, 120, 20);
  EXPECT_EQ(sky["light"]["at"]["hour"], 1);
  EXPECT_THAT(test::roomhue("sky --epw " + path + " --hour 2").out, HasSubstr("none"));
  const auto beyond = test::roomhue("sky --epw " + path + " --hour 3");
  EXPECT_EQ(beyond.exit_code, 3);
  EXPECT_THAT(beyond.err, HasSubstr("there are 2 hours"));
}

}  // namespace
}  // namespace apps
