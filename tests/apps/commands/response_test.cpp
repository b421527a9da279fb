// rank and atlas by the room response: the file between runs, groups, scenarios, and the same order
// as by full solves.
#include <gmock/gmock.h>

#include "paints/ranking.h"
#include "scenes/files/room_json.h"
#include "solver/response/room_response.h"
#include "solver/rooms/room_light.h"
#include "tests/apps/program.h"

namespace apps::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kRank = "rank scenes/rooms/box.json --patch-m 1.4 ";
const std::string kLiving = "scenes/rooms/living_room.json --patch-m 1.4 ";

TEST(Response, OfAnEarlierRunIsReadForAnotherAtlas) {
  const TemporaryFolder folder;
  const std::string out = "--out " + folder.path().string();
  ASSERT_EQ(roomhue(kRank + out).exit_code, 0);
  const auto first = read_json(folder / "run.json");
  EXPECT_FALSE(first["response"]["loaded"].get<bool>());
  EXPECT_LE(first["response"]["largest_relative_error"].get<double>(), 1e-6);
  EXPECT_TRUE(first["ranking"]["resolved"]["same_order"].get<bool>());
  EXPECT_LT(first["ranking"]["resolved"]["largest_difference"].get<double>(), 1e-4);

  ASSERT_EQ(roomhue(kRank + out + " --atlas munsell-renotation --resolve-top 0").exit_code, 0);
  const auto second = read_json(folder / "run.json");
  EXPECT_TRUE(second["response"]["loaded"].get<bool>());
  EXPECT_EQ(second["response"]["full_solves"], 0);
  EXPECT_FALSE(second.contains("transport"));
  EXPECT_GT(read_cells(folder / "ranking.csv").size(), 10U);

  ASSERT_EQ(roomhue("rank scenes/rooms/box.json --patch-m 1.3 " + out).exit_code, 0);
  EXPECT_FALSE(read_json(folder / "run.json")["response"]["loaded"].get<bool>());
}

TEST(Response, DamagedFileIsMadeAnew) {
  const TemporaryFolder folder;
  const std::string out = "--out " + folder.path().string();
  ASSERT_EQ(roomhue(kRank + out).exit_code, 0);
  const std::string ranking = read_text(folder / "ranking.csv");
  std::string response = read_text(folder / "response.json");
  response.replace(response.find("\"rows\":"), 8, "\"rows\":9");
  write_text(folder / "response.json", response);
  ASSERT_EQ(roomhue(kRank + out).exit_code, 0);
  EXPECT_FALSE(read_json(folder / "run.json")["response"]["loaded"].get<bool>());
  EXPECT_EQ(read_text(folder / "ranking.csv"), ranking);
}

TEST(Response, SeveralGroupsGiveSchemes) {
  const TemporaryFolder folder;
  write_text(folder / "paints.csv",
             "name,400,500,600,700\n"
             "white,0.80,0.88,0.90,0.90\ngrey,0.40,0.40,0.40,0.40\nred,0.06,0.05,0.50,0.70\n"
             "pink,0.50,0.45,0.70,0.80\nyellow,0.06,0.30,0.75,0.80\nblue,0.40,0.20,0.06,0.08\n");
  const ProgramRun run =
      roomhue("rank " + kLiving + "--resolve-top 2 --atlas " + (folder / "paints.csv").string() +
              " --out " + (folder / "out").string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(names_in(folder / "out"),
              ElementsAre("model_spread.csv", "model_spread.svg", "response.json", "run.json",
                          "schemes.csv", "shift.csv"));
  EXPECT_THAT(first_line(folder / "out/schemes.csv"),
              StartsWith("rank,distance,walls paint,walls distance,walls J"));
  EXPECT_THAT(run.out, HasSubstr("all 36 schemes were compared"));
  const auto resolved = read_json(folder / "out/run.json")["schemes"]["resolved"];
  EXPECT_LT(resolved["largest_difference"].get<double>(), 1e-4);
}

TEST(Response, ScenariosAreJudgedTogether) {
  const TemporaryFolder folder;
  auto room =
      nlohmann::json::parse(read_text(std::string(SOURCE_DIR) + "/scenes/rooms/living_room.json"));
  room["paint"].erase(1);
  write_text(folder / "room.json", room.dump());
  const ProgramRun run = roomhue("rank " + (folder / "room.json").string() +
                                 " --patch-m 1.4 --out " + (folder / "out").string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("change least from lighting to lighting"));
  const auto ranking = read_cells(folder / "out/ranking.csv");
  const auto scenarios = read_cells(folder / "out/scenarios.csv");
  ASSERT_EQ(scenarios.size(), 1 + 2 * (ranking.size() - 1));
  for (std::size_t i = 1; i < ranking.size(); ++i) {
    const double day = std::stod(scenarios[2 * i - 1][4]), evening = std::stod(scenarios[2 * i][4]);
    EXPECT_NEAR(std::stod(ranking[i][2]), (2 * day + evening) / 3, 1e-9);
  }
}

TEST(Atlas, MapsEveryChipAndDrawsIt) {
  const TemporaryFolder folder;
  const ProgramRun run =
      roomhue("atlas scenes/rooms/box.json --patch-m 1.4 --out " + folder.path().string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(names_in(folder.path()),
              ElementsAre("atlas.csv", "atlas.svg", "orders.csv", "response.json", "run.json"));
  EXPECT_EQ(read_cells(folder / "atlas.csv").size(), 463U);
  EXPECT_THAT(read_text(folder / "atlas.svg"), StartsWith("<svg"));
  for (const auto& row : read_cells(folder / "orders.csv")) {
    if (row[0] != "wished") {
      EXPECT_LE(std::stod(row[2]), std::stod(row[3]) + 1e-12);
    }
  }
  EXPECT_EQ(roomhue("atlas " + kLiving + "--out " + folder.path().string()).exit_code, 3);
}

// The order by the response is the order by solving the room with each paint.
TEST(Response, RanksAsFullSolvesDo) {
  scenes::Room room = scenes::read_room(std::string(SOURCE_DIR) + "/scenes/rooms/office.json");
  room.patch_m = 1;
  const solver::RoomTransport transport = solver::prepare_transport(room);
  const solver::ReducedViews views = solver::reduce_views(room, transport);
  const solver::RoomResponse response(views, 0, 0, {});
  paints::Atlas atlas = paints::load_atlas("munsell-nickerson");
  std::vector<paints::Paint> some;
  for (std::size_t i = 0; i < atlas.paints.size(); i += 11) some.push_back(atlas.paints[i]);
  atlas.paints = some;
  const paints::Target target{.lightness = 65, .a_c = 20, .b_c = 20};
  const auto by_response = paints::rank(
      atlas, target,
      {{.view = [&](const spectra::Spectrum& paint) { return response.light(paint); }}});
  const auto by_solves = paints::rank(
      atlas, target, {{.view = [&](const spectra::Spectrum& paint) {
        return solver::viewed_light(room, transport,
                                    solver::solve_room(room, transport, {}, {.paints = {paint}}));
      }}});
  ASSERT_EQ(by_response.paints.size(), by_solves.paints.size());
  for (std::size_t i = 0; i < some.size(); ++i) {
    EXPECT_EQ(by_response.paints[i].paint, by_solves.paints[i].paint);
    EXPECT_NEAR(by_response.paints[i].distance, by_solves.paints[i].distance, 1e-4);
  }
}

}  // namespace
}  // namespace apps::test
