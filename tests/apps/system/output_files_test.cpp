#include "apps/system/output_files.h"

#include <gmock/gmock.h>

#include "appearance/spectra/text/input_error.h"
#include "apps/reports/csv.h"
#include "apps/system/sha256.h"
#include "tests/apps/program.h"

namespace apps {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;
using ::testing::ElementsAre;

TEST(WriteFiles, MakesFoldersAndLeavesOnlyTheFiles) {
  const TemporaryFolder folder;
  write_files({{.path = folder / "a/b/one.csv", .text = "1"},
               {.path = folder / "a/b/two.csv", .text = ""}});
  EXPECT_THAT(test::names_in(folder / "a/b"), ElementsAre("one.csv", "two.csv"));
  EXPECT_EQ(test::read_text(folder / "a/b/one.csv"), "1");
}

TEST(WriteFiles, WritesAFileInPieces) {
  const TemporaryFolder folder;
  write_files({{.path = folder / "large.csv", .text = "", .pieces = [](const TextSink& sink) {
                  for (const char* piece : {"a,", "", "b", "\r\n"}) sink(piece);
                }}});
  EXPECT_EQ(test::read_text(folder / "large.csv"), "a,b\r\n");
}

TEST(WriteFiles, WritesNoneWhenAPieceFails) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_files({{.path = folder / "first.csv", .text = "1"},
                            {.path = folder / "large.csv",
                             .text = "",
                             .pieces =
                                 [](const TextSink& sink) {
                                   sink("begun");
                                   throw std::bad_alloc();
                                 }}}),
               std::bad_alloc);
  EXPECT_THAT(test::names_in(folder.path()), ::testing::IsEmpty());
}

TEST(WriteFiles, WritesNoneWhenOneCannotBeWritten) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "taken.csv");
  EXPECT_THROW(write_files({{.path = folder / "new/first.csv", .text = "1"},
                            {.path = folder / "taken.csv", .text = "2"}}),
               spectra::FileError);
  EXPECT_THAT(test::names_in(folder.path()), ElementsAre("taken.csv"));
}

TEST(WriteFiles, KeepsTheOldFileWhenTheNewOneFails) {
  const TemporaryFolder folder;
  test::write_text(folder / "old.csv", "old");
  fs::create_directory(folder / "taken.csv");
  EXPECT_THROW(write_files({{.path = folder / "old.csv", .text = "new"},
                            {.path = folder / "taken.csv", .text = ""}}),
               spectra::FileError);
  EXPECT_EQ(test::read_text(folder / "old.csv"), "old");
}

TEST(WriteFiles, FollowsALinkInsteadOfReplacingIt) {
  const TemporaryFolder folder;
  test::write_text(folder / "file.csv", "old");
  fs::create_symlink("file.csv", folder / "link.csv");
  write_files({{.path = folder / "link.csv", .text = "new"}});
  EXPECT_TRUE(fs::is_symlink(folder / "link.csv"));
  EXPECT_EQ(test::read_text(folder / "file.csv"), "new");
}

TEST(WriteFiles, RefusesADevice) {
  EXPECT_THROW(write_files({{.path = "/dev/null", .text = ""}}), spectra::FileError);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(WriteFiles, ClearWhatAKilledRunLeft) {
  const TemporaryFolder folder;
  const auto old = fs::file_time_type::clock::now() - std::chrono::hours(1);
  const int gone = 2'000'000'000;  // no process has such a number
  const auto temporary = [&](const std::string& target, int process, bool is_old) {
    const fs::path path = folder / ("." + target + "." + std::to_string(process) + ".tmp");
    test::write_text(path, "half");
    if (is_old) fs::last_write_time(path, old);
    return path;
  };
  const fs::path left = temporary("a.csv", gone, true), young = temporary("a.csv", gone - 1, false),
                 alive = temporary("a.csv", ::getppid(), true),
                 other = temporary("b.csv", gone, true);
  write_files({{.path = folder / "a.csv", .text = "whole"}});
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(young) && fs::exists(alive) && fs::exists(other));
}

TEST(RequireWritable, RefusesAFileInPlaceOfAFolder) {
  const TemporaryFolder folder;
  test::write_text(folder / "file", "");
  EXPECT_THROW(require_writable(folder / "file/below"), spectra::FileError);
  EXPECT_NO_THROW(require_writable(folder / "new/below"));
  EXPECT_THAT(test::names_in(folder.path()), ElementsAre("file"));
}

TEST(CsvText, QuotesWhatRfc4180WantsQuoted) {
  CsvText csv("a,b");
  csv.cell("plain").cell("x,y").end_row();
  csv.cell("say \"so\"").cell("two\nlines").end_row();
  EXPECT_EQ(csv.take(), "a,b\r\nplain,\"x,y\"\r\n\"say \"\"so\"\"\",\"two\nlines\"\r\n");
}

TEST(CsvText, NumbersReadBackAsTheSameDouble) {
  const std::vector<double> numbers{0.1, 1.0 / 3, 1e-300, 6.02214076e23, -0.0, 12345678.9};
  for (const double number : numbers) {
    CsvText csv;
    csv.cell(number).end_row();
    EXPECT_EQ(std::stod(csv.take()), number);
  }
}

TEST(CsvText, WhatHasNoValueIsAnEmptyCell) {
  CsvText csv;
  csv.cell(std::optional<double>()).cell(std::optional(2.5)).end_row();
  EXPECT_EQ(csv.take(), ",2.5\r\n");
}

// Test vectors of NIST for SHA-256: "abc" and the empty message [FIPS180].
TEST(Sha256, AgreesWithPublishedVectors) {
  const TemporaryFolder folder;
  test::write_text(folder / "abc", "abc");
  test::write_text(folder / "empty", "");
  EXPECT_EQ(sha256_of_file(folder / "abc"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_of_file(folder / "empty"),
            "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(Sha256, RefusesWhatCannotBeRead) {
  const TemporaryFolder folder;
  EXPECT_THROW((void)sha256_of_file(folder / "missing"), spectra::FileError);
  EXPECT_THROW((void)sha256_of_file(folder.path()), spectra::FileError);
}

}  // namespace
}  // namespace apps
