// What is published of the format, scenes/room.schema.json and scenes/README.md, agrees with the
// readers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "appearance/spectra/illuminants.h"
#include "scenes/files/closed_form_json.h"
#include "scenes/files/room_json.h"
#include "tests/scenes/room_files.h"

namespace scenes {
namespace {

json schema() {
  std::ifstream file(std::string(SOURCE_DIR) + "/scenes/room.schema.json");
  return json::parse(file);
}

/// Where a room may hold an object of the schema, and a key that makes it one.
struct SchemaObject {
  std::string definition, place, sample;
};

const std::vector<SchemaObject> kObjects{
    {"opening", "/openings/0", "{}"},
    {"furniture", "/furniture/0", "{}"},
    {"box", "/furniture/0/box_m", "{}"},
    {"prism", "/furniture/0/prism", "{}"},
    {"cylinder", "/furniture/0/cylinder", "{}"},
    {"stairs", "/furniture/0/stairs", "{}"},
    {"sheet", "/furniture/0/sheet", "{}"},
    {"mesh", "/furniture/0/mesh", "{}"},
    {"rotation", "/furniture/0/rotate", "{}"},
    {"ceiling", "/ceiling", "{}"},
    {"roof_plane", "/ceiling/planes/0", "{}"},
    {"face", "/faces/0", "{}"},
    {"reflectance_curve", "/surfaces/floor", R"({"nm": 0})"},
    {"paint_reference", "/surfaces/floor", R"({"paint": 0})"},
    {"file_reference", "/surfaces/floor", R"({"file": 0})"},
    {"srgb", "/surfaces/floor", R"({"reconstruct_srgb": 0})"},
    {"stated_colour", "/surfaces/floor", R"({"hex": 0})"},
    {"stated_colour", "/surfaces/floor", R"({"Lab": 0})"},
    {"stated_colour", "/surfaces/floor", R"({"XYZ": 0})"},
    {"stated_colour", "/surfaces/floor", R"({"xyY": 0})"},
    {"stated_colour", "/surfaces/floor", R"({"LRV": 0})"},
    {"munsell", "/surfaces/floor", R"({"munsell": 0})"},
    {"transmittance_curve", "/openings/0/transmittance", "{}"},
    {"power_curve", "/lights/0/exitance_W_m2_nm", "{}"},
    {"illuminant", "/lights/0/spectrum", R"({"illuminant": 0})"},
    {"planck", "/lights/0/spectrum", R"({"planck_K": 0})"},
    {"daylight", "/lights/0/spectrum", R"({"daylight_K": 0})"},
    {"lamp", "/lights/0/spectrum", R"({"lamp": 0})"},
    {"light_file", "/lights/0/spectrum", R"({"file": 0})"},
    {"lamp_box", "/lights/0/spectrum", R"({"box": 0})"},
    {"box_of_lamp", "/lights/0/spectrum/box", "{}"},
    {"preset", "/lights/0/spectrum", R"({"preset": 0})"},
    {"light", "/lights/0", "{}"},
    {"panel", "/lights/0/panel", "{}"},
    {"glass", "/openings/0/glass", "{}"},
    {"sky", "/lights/0/sky", "{}"},
    {"sky_sun", "/lights/0/sky/sun", "{}"},
    {"obstruction", "/lights/0/sky/obstruction", "{}"},
    {"sun_time", "/lights/0/at", "{}"},
    {"weather_hour", "/lights/0/at", R"({"epw": 0})"},
    {"sun_place", "/lights/0/at", R"({"azimuth_deg": 0})"},
    {"point", "/lights/0/point", "{}"},
    {"sun", "/lights/0/sun", "{}"},
    {"luminaire", "/lights/0/luminaire", "{}"},
    {"receiver", "/receivers/0", "{}"},
    {"view", "/view", "{}"},
    {"paint", "/paint", "{}"},
    {"eye", "/paint/view", "{}"},
    {"named_view", "/views/door", "{}"},
    {"scenario", "/scenarios/0", "{}"},
    {"correlates", "/paint/target", R"({"J": 0})"},
    {"swatch_light", "/paint/target/seen", "{}"},
};

std::set<std::string> keys_of(const json& object_schema) {
  std::set<std::string> keys;
  for (const auto& [key, value] : object_schema["properties"].items()) keys.insert(key);
  return keys;
}

/// A room in which the value at `place` is `sample` with an unknown key.
json room_with_unknown_key(const SchemaObject& object) {
  json room = sample_room();
  const json::json_pointer place(object.place);
  if (object.definition == "power_curve") room["lights"][0].erase("flux_lm");
  for (const char* kind : {"prism", "cylinder", "stairs", "sheet", "mesh"}) {
    if (object.definition == kind) room["furniture"][0].erase("box_m");
  }
  if (object.definition == "box_of_lamp") room["lights"][0]["spectrum"] = json::object();
  if (object.definition == "roof_plane") room["ceiling"] = {{"planes", json::array({0})}};
  if (object.definition == "face") room["faces"] = json::array({0, 0, 0, 0});
  for (const char* kind : {"point", "sun", "luminaire", "sky", "sky_sun", "obstruction"}) {
    if (object.definition == kind) room["lights"][0].erase("panel");
  }
  if (object.place.starts_with("/lights/0/sky/") || object.place == "/lights/0/at") {
    room["lights"][0].erase("panel");
    room["lights"][0]["sky"] = {{"type", "cie:12"}};
    room["lights"][0]["at"] = {{"azimuth_deg", 0}, {"altitude_deg", 30}};
  }
  room[place] = json::parse(object.sample);
  room[place]["qqq"] = 0;
  return room;
}

/// The keys that the reader lists where it refuses the unknown one.
std::set<std::string> keys_that_are_read(const SchemaObject& object) {
  const json room = room_with_unknown_key(object);
  const auto faults = faults_of([&] { (void)read_room(write_file("schema.json", room.dump())); });
  const auto fault = std::ranges::find(faults, object.place + "/qqq", &spectra::Fault::pointer);
  if (fault == faults.end()) return {};
  std::set<std::string> keys;
  std::istringstream words(fault->remedy);
  for (std::string word; std::getline(words, word, '"');) {
    if (std::getline(words, word, '"')) keys.insert(word);
  }
  return keys;
}

TEST(RoomSchema, KnowsTheKeysThatAreRead) {
  const json definitions = schema()["definitions"];
  std::map<std::string, std::set<std::string>> read;  // of an object in all its forms
  for (const SchemaObject& object : kObjects)
    read[object.definition].merge(keys_that_are_read(object));
  for (const auto& [definition, keys] : read) {
    EXPECT_EQ(keys_of(definitions[definition]), keys) << definition;
  }
  EXPECT_EQ(keys_of(schema()), keys_that_are_read({"", "", sample_room().dump()}));
}

TEST(RoomSchema, EveryObjectIsCompared) {
  const json definitions = schema()["definitions"];
  for (const auto& [name, definition] : definitions.items()) {
    if (!definition.contains("additionalProperties")) continue;
    EXPECT_TRUE(std::ranges::count(kObjects, name, &SchemaObject::definition)) << name;
  }
}

TEST(RoomSchema, NamesTheLightsThatThereAre) {
  const json definitions = schema()["definitions"];
  EXPECT_EQ(definitions["illuminant"]["properties"]["illuminant"]["enum"],
            json(spectra::illuminant_names()));
  std::vector<std::string> presets;
  for (const spectra::LampPreset& preset : spectra::lamp_presets()) presets.push_back(preset.name);
  EXPECT_EQ(definitions["preset"]["properties"]["preset"]["enum"], json(presets));
}

TEST(RoomReadme, ExamplesAreRead) {
  std::ifstream file(std::string(SOURCE_DIR) + "/scenes/README.md");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  const std::string open = "```json\n", close = "```";
  int examples = 0;
  for (std::size_t at = text.find(open); at != text.npos; at = text.find(open, at)) {
    at += open.size();
    const std::string path = write_file("readme.json", text.substr(at, text.find(close, at) - at));
    const json example = json::parse(std::ifstream(path));
    if (example.contains("roomhue")) {
      EXPECT_NO_THROW((void)read_room(path));
    }
    if (example.contains("roomhue_cube")) {
      EXPECT_NO_THROW((void)read_cube(path));
    }
    if (example.contains("roomhue_brick")) {
      EXPECT_NO_THROW((void)read_brick(path));
    }
    ++examples;
  }
  EXPECT_EQ(examples, 3);
}

}  // namespace
}  // namespace scenes
