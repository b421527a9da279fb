#include <gmock/gmock.h>

#include "apps/reports/colour_reports.h"
#include "apps/reports/room_reports.h"
#include "scenes/files/room_json.h"
#include "tests/apps/program.h"

namespace apps {
namespace {

Seen seen(double hue_deg, double hue_quadrature) {
  Seen colour{.xyz = {.x = 20, .y = 25, .z = 30}};
  colour.correlates.lightness = 50;
  colour.correlates.chroma = 10;
  colour.correlates.hue_deg = hue_deg;
  colour.correlates.hue_quadrature = hue_quadrature;
  return colour;
}

std::vector<std::vector<std::string>> cells_of(const Shift& shift) {
  const test::TemporaryFolder folder;
  test::write_text(folder / "shift.csv", shift_csv({shift}));
  return test::read_cells(folder / "shift.csv");
}

constexpr std::size_t kJ = 8, kHue = 10, kHueQuadrature = 11;

// Swatch hue 350 deg, room 10 deg: the short way is +20, not -340.
TEST(ShiftCsv, HueChangesGoTheShortWayRound) {
  const auto rows = cells_of({.paint = "p",
                              .surface = "north",
                              .swatch = seen(350, 390),
                              .room = seen(10, 390 - 400 + 30)});
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[3][2], "change");
  EXPECT_EQ(std::stod(rows[3][kHue]), 20);
  EXPECT_EQ(std::stod(rows[3][kHueQuadrature]), 30);
}

TEST(ShiftCsv, ChangeIsRoomMinusSwatch) {
  Shift shift{.paint = "p", .surface = "north", .swatch = seen(90, 100), .room = seen(80, 90)};
  shift.room.correlates.lightness = 47.5;
  const auto rows = cells_of(shift);
  EXPECT_EQ(std::stod(rows[1][kJ]), 50);
  EXPECT_EQ(std::stod(rows[2][kJ]), 47.5);
  EXPECT_EQ(std::stod(rows[3][kJ]), -2.5);
}

TEST(ShiftCsv, UndefinedCorrelatesAreEmptyAndSoIsTheirChange) {
  Shift shift{.paint = "p", .surface = "north", .swatch = seen(90, 100), .room = seen(80, 90)};
  shift.room.correlates.status.negative_achromatic = true;
  const auto rows = cells_of(shift);
  EXPECT_EQ(rows[2][kJ], "");
  EXPECT_EQ(rows[3][kJ], "");
  EXPECT_EQ(std::stod(rows[3][kHue]), -10);  // the hue stays defined
}

TEST(ShiftCsv, MarksReconstructedSpectra) {
  const auto rows = cells_of({.paint = "p",
                              .surface = "north",
                              .reconstructed = true,
                              .swatch = seen(90, 100),
                              .room = seen(80, 90)});
  EXPECT_EQ(rows[1].back(), "reconstructed");
}

// Rows are handed on a thousand at a time; none may be lost or doubled where one lot ends.
TEST(PatchesCsv, HasARowForEveryPatchAndTheErrorWhereThereIsOne) {
  const scenes::Room room = scenes::read_room(SOURCE_DIR "/scenes/rooms/box.json");
  const scenes::PatchMesh mesh = scenes::mesh_room(room, 0.2);
  ASSERT_GT(mesh.size(), 2048);
  const solver::Bands h = solver::Bands::Constant(mesh.size(), 31, 2), b = h / 2;
  const Eigen::ArrayXd error = Eigen::ArrayXd::Constant(mesh.size(), 0.25);
  std::string text;
  write_patches_csv(room, columns_of(room.grid), {mesh, h, b, &error},
                    [&](std::string_view piece) { text += piece; });
  const test::TemporaryFolder folder;
  test::write_text(folder / "patches.csv", text);
  const auto rows = test::read_cells(folder / "patches.csv");
  ASSERT_EQ(rows.size(), static_cast<std::size_t>(mesh.size()) + 1);
  EXPECT_EQ(rows[0].size(), 6U + 31 + 31 + 1);
  EXPECT_EQ(rows[0].back(), "standard_error");
  for (std::size_t k = 1; k < rows.size(); ++k) EXPECT_EQ(rows[k][0], std::to_string(k - 1));
  EXPECT_EQ(rows[1025][6], "2");
  EXPECT_EQ(rows[1025][6 + 31], "1");
  EXPECT_EQ(rows[1025].back(), "0.25");
}

TEST(PaintName, OfACompiledInAtlasFitsIntoARoomFile) {
  const paints::Paint paint{.name = "117", .reflectance = {}, .label = ""};
  EXPECT_EQ(paint_name({.name = "munsell-nickerson", .source = "", .paints = {}}, paint),
            "munsell-nickerson:117");
  EXPECT_EQ(paint_name({.name = "mine.csv", .source = "", .paints = {}}, paint), "117");
}

}  // namespace
}  // namespace apps
