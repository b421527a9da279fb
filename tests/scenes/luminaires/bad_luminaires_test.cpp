// Photometric files that are refused: where, and in which words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenes/luminaires/luminaire_files.h"

namespace scenes {
namespace {

using testing::HasSubstr;

struct BadFile {
  std::string name, file, text, fault;  ///< the fault's beginning: line:column: problem
};

void PrintTo(const BadFile& bad, std::ostream* out) { *out << bad.fault; }

/// `from` is replaced once.
std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

/// A good IES file with another line; lines from 1: 1 version, 3 TILT, 4 lamps to sizes, 5 factors,
/// 6 vertical, 7 horizontal, 8 candela.
std::string ies_line(int number, const std::string& line) {
  std::string text = IesText{.horizontal = {0, 90}, .candela = {3, 2, 0, 3, 1, 0}}.text();
  std::size_t at = 0;
  for (int k = 1; k < number; ++k) at = text.find('\n', at) + 1;
  return text.replace(at, text.find('\n', at) - at, line);
}

/// A good EULUMDAT file with another line; 1 maker, 3 symmetry, 4 planes, 6 gammas, 24 conversion,
/// 26 sets, 27 lamps, 29 flux, 33..42 ratios, 43..46 C, 47..49 gamma, from 50 intensities.
std::string ldt_line(int number, const std::string& line, int symmetry = 2) {
  LdtText file{.symmetry = symmetry, .planes = 4, .c = {0, 90, 180, 270}};
  file.per_klm = {3, 2, 0, 3, 1, 0, 3, 1, 0};
  std::string text = file.text();
  std::size_t at = 0;
  for (int k = 1; k < number; ++k) at = text.find('\n', at) + 1;
  return text.replace(at, text.find('\n', at) - at, line);
}

std::string without_last_line(const std::string& text) {
  return text.substr(0, text.rfind('\n', text.size() - 2) + 1);
}

std::vector<BadFile> bad_files() {
  const std::string good = ies_line(2, "[TEST] x"), counts = "1 1000 1 3 2 1 2 0 0 0";
  const auto header = [&](const std::string& numbers) { return ies_line(4, numbers); };
  return {
      {"no_tilt", "a.ies", with(good, "TILT=NONE", "[TILT] none"), "no line TILT="},
      {"nothing", "a.ies", " \r\n ", ": the file is empty"},
      {"tilt_of_nothing", "a.ies", ies_line(3, "TILT="), "3:6: nothing stands behind TILT="},
      {"tilt_file_missing", "a.ies", ies_line(3, "TILT=MH400.TLT"),
       "3:6: cannot read MH400.TLT beside it; write TILT=NONE if light does not change with tilt"},
      {"tilt_file_elsewhere", "a.ies", ies_line(3, "TILT=../MH400.TLT"),
       "3:6: cannot read ../MH400"},
      {"tilt_position", "a.ies", ies_line(3, "TILT=INCLUDE\n4 2 0 90 1 1"), "4:1: lamp position 4"},
      {"tilt_count", "a.ies", ies_line(3, "TILT=INCLUDE\n1 1.5 0 90 1 1"),
       "4:3: number of tilt angles 1.5"},
      {"tilt_falls", "a.ies", ies_line(3, "TILT=INCLUDE\n1 2 90 0 1 1"),
       "4:8: tilt angle 0 after 90"},
      {"tilt_beyond", "a.ies", ies_line(3, "TILT=INCLUDE\n1 2 0 190 1 1"), "4:7: tilt angle 190"},
      {"tilt_negative", "a.ies", ies_line(3, "TILT=INCLUDE\n1 2 0 90 1 -1"),
       "4:12: negative tilt factor -1"},
      {"tilt_ends", "a.ies", "IESNA91\nTILT=INCLUDE\n1 5 0 90",
       "3:7: ends after 2 of 5 tilt angles"},
      {"no_numbers", "a.ies", "IESNA91\nTILT=NONE\n", "1:1: ends after 0 of 13 numbers"},
      {"header_ends", "a.ies", "IESNA91\nTILT=NONE\n1 1000 1 3\n",
       "3:10: ends after 4 of 13 numbers that follow TILT="},
      {"word", "a.ies", ies_line(6, "0 12a 90"), "6:3: \"12a\" is no number"},
      {"nan", "a.ies", ies_line(8, "3 nan 0 3 1 0"), "8:3: \"nan\" is no number"},
      {"inf", "a.ies", ies_line(8, "3 inf 0 3 1 0"), "8:3: \"inf\" is no number"},
      {"too_large", "a.ies", ies_line(8, "3 1e999 0 3 1 0"), "8:3: \"1e999\" is no number"},
      {"hexadecimal", "a.ies", ies_line(8, "3 0x10 0 3 1 0"), "8:3: \"0x10\" is no number"},
      {"two_commas", "a.ies", ies_line(8, "3, , 0 3 1 0"), "8:4: nothing between two commas"},
      {"binary", "a.ies", ies_line(8, std::string("3 \0\1 0 3 1 0", 12)),
       "8:3: \"  \" is no number"},
      {"candela_fewer", "a.ies", ies_line(8, "3 2 0 3 1"), "8:9: ends after 5 of 6 candela values"},
      {"candela_more", "a.ies", ies_line(8, "3 2 0 3 1 0 7 7"),
       "8:13: 2 more numbers than announced"},
      {"candela_one_more", "a.ies", ies_line(8, "3 2 0 3 1 0 7"),
       "8:13: 1 more number than announced"},
      {"decimal_comma", "a.ies", ies_line(8, "3,5 2 0 3 1 0"),
       "8:13: 1 more number than announced; a comma separates here, decimals take a point"},
      {"text_behind", "a.ies", ies_line(8, "3 2 0 3 1 0 END"),
       "8:13: \"END\" after the last number"},
      {"negative", "a.ies", ies_line(8, "3 2 0 3 -200 0"),
       "8:9: negative intensity -200 at vertical 45, horizontal 90"},
      {"dark", "a.ies", ies_line(8, "0 0 0 0 0 0"), "8:11: no light at all"},
      {"too_bright", "a.ies", ies_line(8, "3 1e13 0 3 1 0"), "8:3: intensity 10000000000000 cd"},
      {"multiplier_0", "a.ies", header("1 1000 0 3 2 1 2 0 0 0"), "4:8: candela multiplier 0"},
      {"multiplier_negative", "a.ies", header("1 1000 -1 3 2 1 2 0 0 0"),
       "4:8: candela multiplier -1"},
      {"ballast", "a.ies", ies_line(5, "0 1 20"), "5:1: ballast factor 0"},
      {"ballast_lamp", "a.ies", with(ies_line(5, "1 0 20"), "IESNA:LM-63-2002", "IESNA91"),
       "5:3: ballast-lamp factor 0"},
      {"verticals_1", "a.ies", header("1 1000 1 1 2 1 2 0 0 0"),
       "4:10: number of vertical angles 1"},
      {"verticals_half", "a.ies", header("1 1000 1 2.5 2 1 2 0 0 0"),
       "4:10: number of vertical angles 2.5"},
      {"horizontals_0", "a.ies", header("1 1000 1 3 0 1 2 0 0 0"),
       "4:12: number of horizontal angles 0"},
      {"horizontals_negative", "a.ies", header("1 1000 1 3 -1 1 2 0 0 0"),
       "4:12: number of horizontal angles -1"},
      {"too_many", "a.ies", header("1 1000 1 10000 10000 1 2 0 0 0"),
       "4:16: 10000 x 10000 intensities"},
      {"far_too_many", "a.ies", header("1 1000 1 1e300 2 1 2 0 0 0"),
       "4:10: number of vertical angles 1e+300"},
      {"type_4", "a.ies", header("1 1000 1 3 2 4 2 0 0 0"),
       "4:14: photometric type 4; 1 is C, 2 is B, 3 is A"},
      {"units_3", "a.ies", header("1 1000 1 3 2 1 3 0 0 0"),
       "4:16: units 3; 1 is feet, 2 is metres"},
      {"millimetres", "a.ies", header("1 1000 1 3 2 1 2 1200 0 0"), "4:18: luminous width 1200 m"},
      {"verticals_fall", "a.ies", ies_line(6, "0 90 45"), "6:6: vertical angle 45 after 90"},
      {"verticals_begin", "a.ies", ies_line(6, "5 45 90"), "6:1: vertical angles begin at 5"},
      {"verticals_end", "a.ies", ies_line(6, "0 45 85"), "6:6: vertical angles end at 85"},
      {"horizontals_fall", "a.ies", ies_line(7, "90 0"), "7:4: horizontal angle 0 after 90"},
      {"horizontals_end", "a.ies", ies_line(7, "0 120"),
       "7:3: horizontal angles end at 120; must be 0, 90, 180, 360 or 90..270"},
      {"horizontals_begin", "a.ies", ies_line(7, "10 180"), "7:1: horizontal angles begin at 10"},
      {"type_b_one_angle", "a.ies", IesText{.type = "2 2"}.text(), "7:1: one horizontal angle"},
      {"type_b_beyond", "a.ies",
       with(with(ies_line(7, "0 120"), "3 2 1 2", "3 2 2 2"), "\n0 45 90", "\n-90 0 90"),
       "7:3: horizontal angles end at 120; must be 90"},
      {"type_a_begins", "a.ies", with(ies_line(6, "-45 0 90"), "3 2 1 2", "3 2 3 2"),
       "6:1: vertical angles begin at -45; must be 0 or -90"},
      {"ldt_as_ies", "a.ies", ldt_line(1, "maker"), "no line TILT="},
      {"ies_as_ldt", "a.ldt", good, "1:1: this is an IES file; name it .ies"},
      {"short", "a.ldt", "maker\n1\n0\n", "3:1: ends after 3 of 26 lines before the lamps"},
      {"symmetry", "a.ldt", ldt_line(3, "5"), "3:1: symmetry 5; 0 is none"},
      {"planes_0", "a.ldt", ldt_line(4, "0"), "4:1: number of C-planes 0"},
      {"planes_word", "a.ldt", ldt_line(4, "many"), "4:1: \"many\" is no number"},
      {"planes_missing", "a.ldt", ldt_line(4, " "), "4:2: number of C-planes is missing"},
      {"planes_huge", "a.ldt", ldt_line(4, "1e9"), "4:1: number of C-planes 1000000000"},
      {"planes_odd", "a.ldt", ldt_line(4, "5"),
       "4:1: number of C-planes 5; symmetry 2 needs an even"},
      {"planes_not_4k", "a.ldt", ldt_line(4, "6", 4),
       "4:1: number of C-planes 6; symmetry 4 needs a multiple of 4"},
      {"gammas_1", "a.ldt", ldt_line(6, "1"), "6:1: number of gamma angles 1"},
      {"size_negative", "a.ldt", ldt_line(16, "-5"), "16:1: luminous length -5"},
      {"ratio", "a.ldt", ldt_line(23, "-1"), "23:1: light output ratio in % -1"},
      {"conversion", "a.ldt", ldt_line(24, "0"), "24:1: conversion factor 0"},
      {"sets_0", "a.ldt", ldt_line(26, "0"), "26:1: number of lamp sets 0"},
      {"sets_99", "a.ldt", ldt_line(26, "99"), "26:1: number of lamp sets 99"},
      {"flux_negative", "a.ldt", ldt_line(29, "-100"), "29:1: negative lamp flux -100"},
      {"flux_word", "a.ldt", ldt_line(29, "1000 lm"), "29:1: \"1000 lm\" is no number"},
      {"direct_ratio", "a.ldt", ldt_line(33, "x"), "33:1: \"x\" is no number"},
      {"c_falls", "a.ldt", ldt_line(44, "0"), "44:1: C angle 0 after 0"},
      {"c_360", "a.ldt", ldt_line(46, "360"), "46:1: C angle 360"},
      {"c_misplaced", "a.ldt", ldt_line(45, "170"), "45:1: C angle 170 where symmetry 2 has 180"},
      {"gamma_beyond", "a.ldt", ldt_line(49, "181"), "49:1: gamma angle 181"},
      {"ldt_negative", "a.ldt", ldt_line(54, "-7"),
       "54:1: negative intensity -7 at gamma 45, C 90"},
      {"ldt_nan", "a.ldt", ldt_line(54, "nan"), "54:1: \"nan\" is no number"},
      {"ldt_fewer", "a.ldt", without_last_line(ldt_line(1, "maker")),
       "57:1: ends after 8 of 9 intensities"},
      {"ldt_more", "a.ldt", ldt_line(1, "maker") + "7\n7\n\n",
       "59:1: 2 more values than announced"},
      {"ldt_dark", "a.ldt", LdtText{.per_klm = {0, 0, 0}}.text(), "47:1: no light at all"},
      {"other_name", "a.txt", good, "the name of a luminaire ends in .ies or .ldt"},
  };
}

class BadLuminaire : public testing::TestWithParam<BadFile> {};

TEST_P(BadLuminaire, IsRefusedWithPlaceAndRemedy) {
  const BadFile& bad = GetParam();
  const auto faults = faults_of([&] { (void)read_luminaire(write_file(bad.file, bad.text)); });
  ASSERT_FALSE(faults.empty());
  std::string all;
  for (const spectra::Fault& fault : faults) all += to_string(fault) + "\n";
  EXPECT_THAT(all, HasSubstr(bad.fault)) << bad.text;
  EXPECT_FALSE(faults[0].remedy.empty());
}

INSTANTIATE_TEST_SUITE_P(All, BadLuminaire, testing::ValuesIn(bad_files()),
                         [](const auto& file) { return file.param.name; });

TEST(BadLuminaires, AllFaultsOfAFileAreTold) {
  IesText file;
  file.type = "4 3";
  file.candela = {300, -2, 0};
  file.vertical = {0, 45, 80};
  const auto faults = faults_of([&] { (void)read(file); });
  EXPECT_EQ(faults.size(), 4U);
}

// Every byte of a good file changed, cut or doubled: read or refused, never anything else.
TEST(BadLuminaires, MutatedFilesAreReadOrRefused) {
  const std::vector<std::string> texts{ies_line(2, "[A] b"), ldt_line(1, "maker")};
  int refused = 0, tried = 0;
  for (const std::string& text : texts) {
    const std::string name = &text == &texts[0] ? "mutated.ies" : "mutated.ldt";
    for (std::size_t at = 0; at < text.size(); at += 2) {
      for (const char* piece : {"", ",", "-", "e9", "\n", "\xFF"}) {
        std::string changed = text;
        changed.replace(at, 1, piece);
        ++tried;
        try {
          const Luminaire lamp = read_luminaire(write_file(name, changed));
          EXPECT_TRUE(std::isfinite(lamp.flux_lm) && lamp.flux_lm > 0) << changed;
        } catch (const spectra::InputError& error) {
          refused += error.faults()[0].line > 0 ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(refused, tried / 10);
}

}  // namespace
}  // namespace scenes
