// Rooms with faults that nobody thought of: the sample rooms with one to three changes anywhere.
#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <sstream>

#include "scenes/files/room_reader.h"
#include "tests/scenes/room_files.h"

namespace scenes {
namespace {

namespace fs = std::filesystem;

std::vector<json> sample_rooms() {
  std::vector<json> rooms{sample_room()};
  const fs::path folder = fs::path(SOURCE_DIR) / "scenes/rooms";
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  for (const fs::path& file : files) {
    std::ifstream in(file);
    rooms.push_back(json::parse(in));
  }
  return rooms;
}

void collect(json& node, std::vector<json*>& nodes) {
  nodes.push_back(&node);
  if (!node.is_structured()) return;
  for (json& child : node) collect(child, nodes);
}

/// Replaces, removes, repeats, swaps or scales something.
void mutate(json& room, std::mt19937& random) {
  static const std::vector<json> kStrange{nullptr,
                                          true,
                                          -1,
                                          0,
                                          1e-9,
                                          1e308,
                                          0.5,
                                          "",
                                          "south",
                                          "floor",
                                          "panel",
                                          json::array(),
                                          json::object(),
                                          json::array({1, 2, 3}),
                                          json::array({0, 0})};
  const auto pick = [&](std::size_t count) { return static_cast<std::size_t>(random()) % count; };
  std::vector<json*> nodes;
  collect(room, nodes);
  json& node = *nodes[pick(nodes.size())];
  switch (random() % 6) {
    case 0:
      node = kStrange[pick(kStrange.size())];
      break;
    case 1:
      if (node.is_array() && !node.empty())
        node.erase(node.begin() + static_cast<int>(pick(node.size())));
      break;
    case 2:
      if (node.is_array() && !node.empty()) node.push_back(node[pick(node.size())]);
      break;
    case 3:
      if (node.is_object() && !node.empty()) {
        auto at = node.begin();
        std::advance(at, static_cast<int>(pick(node.size())));
        node.erase(at);
      }
      break;
    case 4: {
      const json other = *nodes[pick(nodes.size())];
      node = other;
      break;
    }
    default:
      if (node.is_number()) node = node.get<double>() * (random() % 2 == 0 ? -1 : 1.5);
  }
}

// Reading gives a room or the list of its faults, whatever the file says; a fault has a place.
TEST(MutatedRooms, AreReadOrRefusedWithPlaces) {
  const std::vector<json> rooms = sample_rooms();
  std::mt19937 random(7);
  int refused = 0;
  constexpr int kRooms = 20000;
  for (int k = 0; k < kRooms; ++k) {
    json room = rooms[static_cast<std::size_t>(random()) % rooms.size()];
    for (auto changes = 1 + random() % 3; changes > 0; --changes) mutate(room, random);
    spectra::JsonFile file("room.json", room.dump());
    try {
      (void)RoomReader(file, spectra::kTransportGrid).read();
    } catch (const spectra::InputError& error) {
      ++refused;
      for (const spectra::Fault& fault : error.faults()) {
        ASSERT_GT(fault.line, 0) << fault.problem << "\n" << room.dump(1);
        ASSERT_FALSE(fault.problem.empty() || fault.remedy.empty());
      }
    } catch (const std::exception& error) {
      FAIL() << error.what() << "\n" << room.dump(1);
    }
  }
  EXPECT_GT(refused, kRooms / 4);
  EXPECT_LT(refused, kRooms);
}

}  // namespace
}  // namespace scenes
