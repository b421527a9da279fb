#include "appearance/spectra/text/json_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace spectra {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

std::vector<Fault> faults_of(const JsonFile& file) {
  try {
    file.throw_faults();
  } catch (const InputError& error) {
    return error.faults();
  }
  return {};
}

/// The one fault with which parsing ends.
Fault syntax_fault(const std::string& text) {
  try {
    const JsonFile file("x.json", text);
  } catch (const InputError& error) {
    return error.faults().back();
  }
  return {};
}

std::string place(const Fault& fault) {
  return std::to_string(fault.line) + ":" + std::to_string(fault.column);
}

/// Where a fault at the value with this JSON pointer is reported.
std::string place_of(const std::string& text, const std::vector<std::string>& path) {
  JsonFile file("x.json", text);
  JsonNode node = file.root();
  for (const std::string& key : path) {
    const bool in_list = node.is(JsonNode::Kind::list);
    node = in_list ? node.list()[std::stoul(key)] : *node.any_object().find(key);
  }
  node.fault("p", "r");
  return place(faults_of(file).at(0));
}

TEST(JsonReader, EveryKindOfValueKnowsItsFirstByte) {
  const std::string text =
      "{ \"a\" : 12 ,\n"
      "\t\"b\":\"x\\\"]\",\"c\":[ -1.5e3,true,\n"
      "null,{}, [ ] ],\n"
      "\"d\":{\"e\":false}}\n";
  EXPECT_EQ(place_of(text, {}), "1:1");
  EXPECT_EQ(place_of(text, {"a"}), "1:9");
  EXPECT_EQ(place_of(text, {"b"}), "2:6");
  EXPECT_EQ(place_of(text, {"c"}), "2:17");
  EXPECT_EQ(place_of(text, {"c", "0"}), "2:19");
  EXPECT_EQ(place_of(text, {"c", "1"}), "2:26");
  EXPECT_EQ(place_of(text, {"c", "2"}), "3:1");
  EXPECT_EQ(place_of(text, {"c", "3"}), "3:6");
  EXPECT_EQ(place_of(text, {"c", "4"}), "3:10");
  EXPECT_EQ(place_of(text, {"d", "e"}), "4:10");
}

TEST(JsonReader, ColumnsCountBytesAndABomCounts) {
  EXPECT_EQ(place_of("{\"\xC3\xA4\": 1}", {"\xC3\xA4"}), "1:8");
  EXPECT_EQ(place_of("\xEF\xBB\xBF[7]", {"0"}), "1:5");
  EXPECT_EQ(place_of("{\r\n\"a\": 1}", {"a"}), "2:6");
}

TEST(JsonReader, ValuesArriveUnchanged) {
  JsonFile file("x.json", R"({"n": 0.1, "big": 12345678901234567890, "t": "\u00e4\n", "l": [1]})");
  const JsonObject top = file.root().object({"n", "big", "t", "l"});
  EXPECT_EQ(top.number("n"), 0.1);
  EXPECT_EQ(top.number("big"), 12345678901234567890.0);
  EXPECT_EQ(top.find("t")->text(), "\xC3\xA4\n");
  EXPECT_EQ(top.list_or_empty("l").at(0).number(), 1);
  EXPECT_THAT(faults_of(file), IsEmpty());
}

TEST(JsonReader, PointersEscapeSlashAndTilde) {
  JsonFile file("x.json", R"({"a/b~c": [0, "x"]})");
  (void)file.root().any_object().find("a/b~c")->list()[1].number();
  EXPECT_EQ(faults_of(file).at(0).pointer, "/a~1b~0c/1");
}

TEST(JsonReader, UnknownKeyNamesTheNearestOne) {
  JsonFile file("x.json", R"({"hieght_m": 1, "zzz": 2})");
  (void)file.root().object({"height_m", "width_m"});
  const std::vector<Fault> faults = faults_of(file);
  ASSERT_EQ(faults.size(), 2);
  EXPECT_EQ(place(faults[0]), "1:2");
  EXPECT_EQ(faults[0].pointer, "/hieght_m");
  EXPECT_THAT(faults[0].remedy, HasSubstr("height_m"));
  EXPECT_THAT(faults[1].remedy, HasSubstr("\"height_m\" or \"width_m\""));
}

TEST(JsonReader, FaultsAreReportedInTheOrderOfTheFile) {
  JsonFile file("x.json", "{\"a\": \"x\",\n \"b\": 7}");
  const JsonObject top = file.root().object({"a", "b"});
  EXPECT_TRUE(std::isnan(top.number("b", {.least = 0, .most = 1})));
  EXPECT_TRUE(std::isnan(top.number("a")));
  EXPECT_TRUE(std::isnan(top.number("c")));
  const std::vector<Fault> faults = faults_of(file);
  ASSERT_EQ(faults.size(), 3);
  EXPECT_THAT(faults[0].problem, HasSubstr("\"c\" is missing"));
  EXPECT_EQ(to_string(faults[2]), "x.json:2:7: /b: 7 is out of range; give a number from 0 to 1");
}

TEST(JsonReader, DuplicateKeysAreFaultsAndTheFirstIsRead) {
  JsonFile file("x.json", R"({"a": 1, "b": {"c": 2, "c": 3}})");
  EXPECT_EQ(file.root().any_object().find("b")->any_object().number("c"), 2);
  ASSERT_EQ(faults_of(file).size(), 1);
  EXPECT_EQ(faults_of(file)[0].pointer, "/b/c");
  EXPECT_EQ(place(faults_of(file)[0]), "1:24");
}

TEST(JsonReader, LimitsSayTheirWords) {
  EXPECT_EQ((Limits{.least = 0, .most = 1, .below_most = true}.words()),
            "a number from 0 to below 1");
  EXPECT_EQ((Limits{.least = 0, .most = 90, .above_least = true}.words()),
            "a number above 0 and up to 90");
  EXPECT_EQ(Limits{}.words(), "a number");
  EXPECT_FALSE((Limits{.least = 0, .most = 1, .below_most = true}.allow(1)));
  EXPECT_FALSE((Limits{.least = 0, .above_least = true}.allow(0)));
  EXPECT_FALSE((Limits{.least = 0, .most = 1}.allow(NAN)));
}

TEST(JsonReader, NumbersBeyondDoubleAreFaults) {
  EXPECT_THAT(syntax_fault("[1,\n -1e999]").problem, HasSubstr("too large"));
  EXPECT_EQ(place(syntax_fault("[1,\n -1e999]")), "2:2");
}

TEST(JsonReader, DepthIsLimitedWithoutRecursion) {
  EXPECT_NO_THROW(JsonFile("x.json", std::string(32, '[') + std::string(32, ']')));
  EXPECT_THAT(syntax_fault(std::string(1'000'000, '[')).problem, HasSubstr("deeper"));
}

TEST(JsonReader, NumberOfValuesIsLimited) {
  std::string text = "[0";
  for (int i = 0; i < 1'000'000; ++i) text += ",0";
  EXPECT_THAT(syntax_fault(text + "]").problem, HasSubstr("more than 1000000 values"));
}

TEST(JsonReader, ManyFaultsAreCutOffWithTheirNumber) {
  std::string text = "[0";
  for (int i = 0; i < 4999; ++i) text += ",0";
  JsonFile file("x.json", text + "]");
  for (const JsonNode& node : file.root().list(0, 5000)) (void)node.text();
  const std::vector<Fault> faults = faults_of(file);
  EXPECT_EQ(faults.size(), 1001);
  EXPECT_THAT(faults.back().problem, HasSubstr("4000 more"));
}

TEST(JsonReader, HugeFileIsRefusedAfterItsFirstMebibytes) {
  const std::string path = testing::TempDir() + "huge.json";
  std::ofstream(path) << "[";
  std::filesystem::resize_file(path, std::uintmax_t{10} << 30);  // sparse
  try {
    (void)read_json_file(path);
    ADD_FAILURE() << "10 GiB were read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("larger than 16 MiB"));
  }
  std::filesystem::remove(path);
}

TEST(JsonReader, MissingFileAndFolderAreFileErrors) {
  EXPECT_THROW((void)read_json_file(testing::TempDir() + "none.json"), FileError);
  EXPECT_THROW((void)read_json_file(testing::TempDir()), FileError);
}

TEST(NearestName, FindsASlipOfTheFingersOnly) {
  const std::vector<std::string> names{"window", "width_m", "wall"};
  EXPECT_EQ(nearest_name("windwo", names), "window");
  EXPECT_EQ(nearest_name("widht_m", names), "width_m");
  EXPECT_EQ(nearest_name("ceiling", names), "");
}

}  // namespace
}  // namespace spectra
