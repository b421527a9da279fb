#include "appearance/spectra/text/csv_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "appearance/spectra/text/utf8.h"

namespace spectra {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<Fault> faults_of(std::string_view text) {
  try {
    (void)parse_csv("t.csv", text);
  } catch (const InputError& error) {
    return error.faults();
  }
  return {};
}

std::string first_fault(std::string_view text) {
  const std::vector<Fault> faults = faults_of(text);
  return faults.empty() ? "" : to_string(faults.front());
}

TEST(ParseCsv, ReadsQuotesCrlfAndAByteOrderMark) {
  const CsvTable t = parse_csv("t.csv",
                               "\xEF\xBB\xBFname,note\r\n"
                               "a,\"one, \"\"two\"\"\"\r\n"
                               "\r\n"
                               "\"b\",\"three\nfour\"\n"
                               "c,");
  EXPECT_THAT(t.header, ElementsAre("name", "note"));
  ASSERT_EQ(t.rows.size(), 3U);
  EXPECT_THAT(t.rows[0].cells, ElementsAre("a", "one, \"two\""));
  EXPECT_THAT(t.rows[1].cells, ElementsAre("b", "three\nfour"));
  EXPECT_THAT(t.rows[2].cells, ElementsAre("c", ""));
  EXPECT_EQ(t.rows[1].line, 4);
  EXPECT_EQ(t.rows[2].line, 6);
}

TEST(ParseCsv, PlacesCountBytesFromOne) {
  const CsvTable t = parse_csv("t.csv", "\xEF\xBB\xBFname,note\n\"ab\",c\n");
  EXPECT_EQ(t.header_places[1].column, 6);
  EXPECT_EQ(t.rows[0].places[0].column, 1);
  EXPECT_EQ(t.rows[0].places[1].line, 2);
  EXPECT_EQ(t.rows[0].places[1].column, 6);
}

struct Broken {
  const char* name;
  std::string_view text;
  const char* message;
};

class BrokenCsv : public testing::TestWithParam<Broken> {};

TEST_P(BrokenCsv, IsRefusedWithItsPlace) {
  EXPECT_THAT(first_fault(GetParam().text), HasSubstr(GetParam().message));
}

using namespace std::string_view_literals;
INSTANTIATE_TEST_SUITE_P(
    Kinds, BrokenCsv,
    testing::Values(Broken{"empty", "", "t.csv: the file is empty"},
                    Broken{"only_a_mark", "\xEF\xBB\xBF", "t.csv: the file is empty"},
                    Broken{"blank_lines", "\n\r\n\n", "t.csv: the file is empty"},
                    Broken{"short_row", "a,b\n1\n", "t.csv:2:1: 1 cells, but the header has 2"},
                    Broken{"long_row", "a,b\n\n1,2,3\n", "t.csv:3:1: 3 cells"},
                    Broken{"open_quote", "a,b\n1,\"2\n", "t.csv:2:3: quote that is never closed"},
                    Broken{"stray_quote", "a,b\n1,2\"\n", "t.csv:2:3: quote inside"},
                    Broken{"text_after_quote", "a,b\n1,\"2\"3\n", "t.csv:2:6: text after"},
                    Broken{"same_name", "a,b,a\n1,2,3\n", "t.csv:1:5: second column named \"a\""},
                    Broken{"no_name", "a,\n1,2\n", "t.csv:1:3: column without a name"},
                    Broken{"nul", "a,b\n1,\0\n"sv, "t.csv:2:3: NUL byte"},
                    Broken{"latin_1", "a,b\nGr\xFCn,1\n", "t.csv:2:3: byte that is no UTF-8"}),
    [](const auto& kind) { return kind.param.name; });

TEST(ParseCsv, ReportsAllFaultsUpToAHundred) {
  EXPECT_EQ(faults_of("a,b\n1\n1,2\n1,2,3\n1,\"2\"3\n").size(), 3U);
  std::string many = "a,b\n";
  for (int i = 0; i < 1000; ++i) many += "1\n";
  EXPECT_EQ(faults_of(many).size(), 100U);
}

// Whatever is cut off or garbled, the answer is a table or an InputError.
TEST(ParseCsv, SurvivesTruncationAndGarbageAnywhere) {
  const std::string good = "\xEF\xBB\xBFname,x\r\n\"a\"\"b\",1.5\r\nc,\"2\"\r\n";
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (const char garbage : {'"', ',', '\r', '\n', '\0', '\xC3', '\xFF'}) {
      std::string garbled = good;
      garbled[i] = garbage;
      for (const std::string& text : {garbled, good.substr(0, i)}) {
        try {
          for (const CsvRow& row : parse_csv("t.csv", text).rows) EXPECT_FALSE(row.cells.empty());
        } catch (const InputError& error) {
          EXPECT_FALSE(error.faults().empty());
        }
      }
    }
  }
}

TEST(ReadCsv, MissingFilesAndFoldersCannotBeRead) {
  EXPECT_THROW((void)read_csv(SOURCE_DIR "/no/such.csv"), FileError);
  EXPECT_THROW((void)read_csv(SOURCE_DIR), FileError);
}

TEST(ReadCsv, EndlessInputIsRefused) { EXPECT_THROW((void)read_csv("/dev/zero"), FileError); }

TEST(ParseNumber, TakesAWholeFiniteNumber) {
  EXPECT_EQ(parse_number("0.25"), 0.25);
  EXPECT_EQ(parse_number(" +1e-3\t"), 1e-3);
  EXPECT_EQ(parse_number("-7"), -7);
  for (const char* text :
       {"", " ", "x", "1x", "1 2", "0,5", "nan", "inf", "1e999", "0x10", "+-1"}) {
    EXPECT_FALSE(parse_number(text)) << text;
  }
}

TEST(Utf8, OverlongSurrogateAndTooLargeFormsAreRefused) {  // RFC 3629, section 10 and 3
  EXPECT_EQ(first_invalid_utf8("a\xC3\xBC\xE2\x82\xAC\xF0\x9F\x8E\xA8"), std::string_view::npos);
  for (const char* bad :
       {"a\x80", "a\xC0\x80", "a\xE0\x80\x80", "a\xED\xA0\x80", "a\xF4\x90\x80\x80",
        "a\xF5\x80\x80\x80", "a\xC3", "a\xE2\x82", "a\xE2\x82z"}) {
    EXPECT_EQ(first_invalid_utf8(bad), 1U) << bad;
  }
}

}  // namespace
}  // namespace spectra
