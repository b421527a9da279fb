// Every file of tests/data/bad with its place and a word of its problem, as index.csv lists them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "appearance/spectra/spectrum_file.h"
#include "appearance/spectra/text/csv_reader.h"
#include "paints/files/paint_reader.h"
#include "scenes/files/closed_form_json.h"
#include "scenes/files/room_json.h"
#include "tests/scenes/room_files.h"

namespace scenes {
namespace {

using testing::HasSubstr;

const std::string kFolder = std::string(TEST_DATA) + "/bad/";

struct BadFile {
  std::string name, kind;
  int line = 0, column = 0;
  std::string pointer, word;
};

std::vector<BadFile> bad_files() {
  std::vector<BadFile> files;
  for (const spectra::CsvRow& row : spectra::read_csv(kFolder + "index.csv").rows) {
    files.push_back({.name = row.cells[0],
                     .kind = row.cells[1],
                     .line = std::stoi(row.cells[2]),
                     .column = std::stoi(row.cells[3]),
                     .pointer = row.cells[4],
                     .word = row.cells[5]});
  }
  return files;
}

void read(const BadFile& file) {
  const std::string path = kFolder + file.name;
  if (file.kind == "room") (void)read_room(path);
  if (file.kind == "cube") (void)read_cube(path);
  if (file.kind == "brick") (void)read_brick(path);
  if (file.kind == "atlas") (void)paints::read_paint_file(path);
  if (file.kind == "light") (void)read_spectrum_file(path, spectra::CurveKind::light);
}

TEST(BadFiles, EachIsRefusedAtItsPlaceWithProblemAndRemedy) {
  const std::vector<BadFile> files = bad_files();
  EXPECT_GE(files.size(), 60);
  for (const BadFile& file : files) {
    SCOPED_TRACE(file.name);
    const std::vector<spectra::Fault> faults = faults_of([&] { read(file); });
    if (faults.empty()) {
      ADD_FAILURE() << "no fault was found";
      continue;
    }
    const spectra::Fault& first = faults.front();
    EXPECT_EQ(first.file, kFolder + file.name);
    EXPECT_EQ(first.line, file.line) << first.problem;
    EXPECT_EQ(first.column, file.column) << first.problem;
    EXPECT_EQ(first.pointer, file.pointer) << first.problem;
    EXPECT_THAT(first.problem, HasSubstr(file.word));
    for (const spectra::Fault& fault : faults) {
      EXPECT_FALSE(fault.problem.empty());
      EXPECT_FALSE(fault.remedy.empty()) << fault.problem;
    }
  }
}

// A slip must not drag others behind it: NaN passes every check.
TEST(BadFiles, OneSlipGivesOneFault) {
  for (const BadFile& file : bad_files()) {
    if (file.name == "room_light_bad_file.json") continue;  // and the fault of the file it names
    if (file.name == "light_semicolons.csv") continue;      // no name, and no wavelengths
    SCOPED_TRACE(file.name);
    const std::vector<spectra::Fault> faults = faults_of([&] { read(file); });
    for (std::size_t i = 1; i < faults.size(); ++i) ADD_FAILURE() << to_string(faults[i]);
  }
}

TEST(BadFiles, FaultsOfAReferredFileAreReportedWithIt) {
  const auto faults = faults_of([] { (void)read_room(kFolder + "room_light_bad_file.json"); });
  ASSERT_EQ(faults.size(), 2);
  EXPECT_EQ(faults[0].pointer, "/lights/0/spectrum");
  EXPECT_EQ(faults[1].file, kFolder + "light_not_a_number.csv");
  EXPECT_EQ(faults[1].line, 2);
}

TEST(BadFiles, IndexListsEveryFile) {
  std::set<std::string> listed{"index.csv", "five_faults.json"};
  for (const BadFile& file : bad_files()) listed.insert(file.name);
  std::set<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
    found.insert(entry.path().filename());
  }
  EXPECT_EQ(found, listed);
}

// Every beginning of a good file ends in a fault, never in a crash or a room.
TEST(BadFiles, TruncationAnywhereIsAFault) {
  const std::string text = sample_room().dump(1);
  for (std::size_t length = 0; length < text.size(); length += 3) {
    const std::string path = write_file("truncated.json", text.substr(0, length));
    EXPECT_FALSE(faults_of([&] { (void)read_room(path); }).empty()) << length;
  }
}

/// Replaces one value after another, at any depth, by `other`, and reads the room.
void replace_each(json& room, json& place, const json& other) {
  for (json& item : place) {
    if (item.is_structured()) replace_each(room, item, other);
    const json kept = std::exchange(item, other);
    (void)faults_of([&] { (void)read_room(write_file("replaced.json", room.dump())); });
    item = kept;
  }
}

// Anything may stand anywhere: a fault or a room, but no other exception and no crash.
TEST(BadFiles, AnyValueAnywhereIsRoomOrFault) {
  for (const json& other :
       {json(), json(-1), json(1e300), json("walls"), json::array(), json::array({0, 0}),
        json::object(), json{{"nm", {1, 2}}}, json(true)}) {
    json room = sample_room();
    EXPECT_NO_THROW(replace_each(room, room, other)) << other;
  }
}

}  // namespace
}  // namespace scenes
