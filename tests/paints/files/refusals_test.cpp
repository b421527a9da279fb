// What is refused, with its place, a word of the problem and a remedy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "appearance/spectra/text/input_error.h"
#include "paints/files/paint_reader.h"

namespace paints {
namespace {

struct Bad {
  std::string name, text;
  int line = 0, column = 0;
  std::string word, remedy;
};

const std::string kBands = ",400,450,500,550,600,650,700,710\n";
const std::string kGood = ",0.1,0.1,0.1,0.1,0.1,0.1,0.1,0.1\n";

std::string cxf(const std::string& objects, const std::string& specification = "") {
  return "<CxF xmlns=\"http://colorexchangeformat.com/CxF3-core\"><Resources>\n<ObjectCollection>" +
         objects + "</ObjectCollection>\n" + specification + "</Resources></CxF>";
}

std::string object(const std::string& values) {
  return "<Object Name=\"a\"><ColorValues>" + values + "</ColorValues></Object>";
}

std::string cgats(const std::string& fields, const std::string& data,
                  const std::string& head = "CGATS.17\n") {
  return head + "BEGIN_DATA_FORMAT\n" + fields + "\nEND_DATA_FORMAT\nBEGIN_DATA\n" + data +
         "\nEND_DATA\n";
}

std::vector<Bad> tables() {
  return {
      {"Empty", "", 0, 0, "empty", "header"},
      {"Blank", " \r\n\t\n", 0, 0, "empty", "header"},
      {"Nul", std::string("name,hex\na\0,#FFEE00\n", 19), 2, 2, "NUL", "UTF-8"},
      {"HalfUtf16",
       "\xFF\xFE"
       "a",
       0, 0, "inside a character", "UTF-8"},
      {"LoneSurrogate", std::string("\xFF\xFE\x00\xDC", 4), 0, 0, "half a character", "UTF-8"},
      {"Prose", "Dear customer\nour paints are\n", 1, 1, "no wavelengths and no colours", "hex"},
      {"OneColumn", "1,234\n1,235\n", 1, 1, "no wavelengths and no colours", "hex"},
      {"OpenQuote", "name,hex\n\"a,#FFEE00\n", 2, 1, "never closed", "close"},
      {"QuoteInside", "name,hex\na\"b,#FFEE00\n", 2, 1, "quote inside", "quote the whole"},
      {"AfterQuote", "name,hex\n\"a\"b,#FFEE00\n", 2, 4, "after the closing", "quote the whole"},
      {"Ragged", "name" + kBands + "a,0.1,0.1\n", 2, 1, "3 cells", "one cell"},
      {"NoRows", "name" + kBands, 0, 0, "no curves", "one per row"},
      {"NoNameColumn", "400,450,500,550,600,650,700,710\n.1,.1,.1,.1,.1,.1,.1,.1\n", 1, 1, "names",
       "column"},
      {"NoName", "name" + kBands + kGood, 2, 1, "no name", "name every"},
      {"NameTwice", "name" + kBands + "a" + kGood + "a" + kGood, 3, 1, "again, first in line 2",
       "code"},
      {"CodeTwice", "code,name" + kBands + "1,a" + kGood + "1,b" + kGood, 3, 3, "again",
       "code of its own"},
      {"WavelengthTwice", "name,400,450,500,550,600,650,650,700\na" + kGood, 1, 30, "650", "once"},
      {"NotRising", "name,400,450,500,600,550,650,700,710\na" + kGood, 1, 22, "550 nm after 600",
       "order"},
      {"NoWavelengthInside", "name,400,450,500,x,550,600,650,700,710\na,0.1" + kGood, 1, 18,
       "not a wavelength", "side by side"},
      {"NotANumber", "name" + kBands + "a,0.1,high,0.1,0.1,0.1,0.1,0.1,0.1\n", 2, 7, "high",
       "finite"},
      {"EmptyCell", "name" + kBands + "a,0.1,,0.1,0.1,0.1,0.1,0.1,0.1\n", 2, 7, "not a number",
       "finite"},
      {"NaN", "name" + kBands + "a,0.1,NaN,0.1,0.1,0.1,0.1,0.1,0.1\n", 2, 7, "NaN", "finite"},
      {"Deleted", "name" + kBands + "a,0.1,-9999,0.1,0.1,0.1,0.1,0.1,0.1\n", 2, 7, "-9999",
       "from 0"},
      {"Negative", "name" + kBands + "a,0.1,-0.3,0.1,0.1,0.1,0.1,0.1,0.1\n", 2, 7, "-0.3",
       "from 0"},
      {"Fluorescent", "name" + kBands + "a,0.1,1.1,0.1,0.1,0.1,0.1,0.1,0.1\n", 2, 7,
       "1.1 is out of range", "fluorescence=clip"},
      {"ScaleUnclear", "name" + kBands + "a,0.1,1.4,0.1,0.1,0.1,0.1,0.1,0.1\n", 0, 0,
       "fraction or percent", "scale=percent"},
      {"OneGlowsInAFractionFile",
       "name" + kBands + "a" + kGood + "b" + kGood + "c,0.1,1.6,0.1,0.1,0.1,0.1,0.1,0.1\n", 0, 0,
       "fraction or percent", "scale=fraction"},
      {"PointInDecimalComma", "name;400;450;500;550;600;650;700;710\na;0,1;1.000,1;1;1;1;1;1;1\n",
       2, 7, "1.000,1", "finite"},
      {"DownNotANumber",
       "nm\ta\n400\t.1\n410\tx\n420\t.1\n430\t.1\n440\t.1\n450\t.1\n460\t.1\n470\t.1\n", 3, 5,
       "\"x\"", "finite"},
      {"BadHex", "name,hex\na,#GG0000\n", 2, 3, "no hex colour", "#D8C9A7"},
      {"NoColour", "name,hex\na,\n", 2, 1, "no colour", "leave the row out"},
      {"LabOutOfRange", "name,L*,a*,b*\na,180,0,0\n", 2, 3, "180", "0 to 100"},
      {"LabNotANumber", "name,L*,a*,b*\na,80,x,0\n", 2, 6, "not a number", "finite"},
      {"ImpossibleLab", "name,L*,a*,b*\na,50,120,-120\n", 2, 1, "no reflectance",
       "impossible=skip"},
      {"White", "name,hex\na,#FFFFFF\n", 2, 1, "no reflectance", "impossible=skip"},
      {"RgbOutOfRange", "name,R,G,B\na,300,0,0\n", 2, 3, "300", "0..255"},
      {"XyzScaleUnclear", "name,X,Y,Z\na,0.2,0.3,0.4\n", 0, 0, "0 to 1, or 0 to 100",
       "scale=percent"},
      {"XyzNegative", "name,X,Y,Z\na,20,30,-4\n", 2, 3, "-4", "Y = 100"},
      {"ChromaticityOfNothing", "name,x,y,Y\na,0.3,0,40\n", 2, 3, "0 is out of range", "above 0"},
      {"LrvOutOfRange", "name,LRV\na,140\n", 2, 3, "no LRV", "0 to 100"},
  };
}

std::vector<Bad> formats() {
  const std::string spectrum =
      "<ReflectanceSpectrum ColorSpecification=\"s\">0.1 0.2 0.3</ReflectanceSpectrum>";
  const std::string qtx = "[STANDARD_DATA 1]\nSTD_NAME=a\n";
  std::string deep;
  for (int i = 0; i < 100; ++i) deep += "<x>";
  std::string shallow;
  for (int i = 0; i < 100; ++i) shallow += "</x>";
  return {
      {"Ase", "ASEF\x01", 0, 0, "ASE palette", "CSV"},
      {"Acb", "8BCB.....", 0, 0, "ACB", "CSV"},
      {"Excel", "PK\x03\x04.....", 0, 0, "Excel", "CSV UTF-8"},
      {"OldExcel", "\xD0\xCF\x11\xE0....", 0, 0, "Excel", "CSV UTF-8"},
      {"Matlab", "MATLAB 5.0 MAT-file, made", 0, 0, "MATLAB", "CSV"},
      {"Pdf", "%PDF-1.7", 0, 0, "PDF", "table"},
      {"Mif", "NAME=a\nANGL=In\n1 2 3\n", 1, 1, "MIF", "CxF3"},
      {"Xtf", "`1`a`31`2.0`\n", 1, 1, "XTF", "CxF3"},
      {"OtherXml", "<svg></svg>", 1, 2, "<svg>", "CxF3"},
      {"Cxf2", "<CXF></CXF>", 1, 2, "version 2", "CxF3"},
      {"CutXml", "<CxF><Resources>", 1, 16, "no sound XML", "anew"},
      {"Entities", "<!DOCTYPE a [<!ENTITY b \"c\">]><CxF/>", 1, 1, "entities", "take them out"},
      {"DeepXml", cxf(deep + shallow), 2, 206, "deeper than 64", "anew"},
      {"NoObject", cxf(""), 0, 0, "no object", "ReflectanceSpectrum"},
      {"NoWavelengths", cxf(object(spectrum)), 2, 50, "3 values without wavelengths",
       "wavelengths=FIRST"},
      {"TwoSpectra", cxf(object(spectrum + spectrum)), 2, 20, "2 spectra", "pick=s"},
      {"NoNumberInSpectrum", cxf(object("<ReflectanceSpectrum>0.1 x</ReflectanceSpectrum>")), 2, 50,
       "\"x\"", "finite"},
      {"PointWithoutWavelength",
       cxf(object("<CustomSpectrum><SpectralPoint>0.1</SpectralPoint></CustomSpectrum>")), 2, 66,
       "no wavelength", "WL="},
      {"LabWithoutB", cxf(object("<ColorCIELab><L>50</L><A>1</A></ColorCIELab>")), 2, 50,
       "B is missing", "finite"},
      {"SrgbOutOfRange", cxf(object("<ColorSRGB><R>300</R><G>1</G><B>1</B></ColorSRGB>")), 2, 50,
       "out of range", "0..255"},
      {"DataWithoutFormat", "CGATS.17\nBEGIN_DATA\n1 2\nEND_DATA\n", 2, 1, "without a format",
       "BEGIN_DATA_FORMAT"},
      {"DataWithoutEnd",
       "CGATS.17\nBEGIN_DATA_FORMAT\nSAMPLE_ID LAB_L LAB_A LAB_B\n"
       "END_DATA_FORMAT\nBEGIN_DATA\n1 50 0 0\n",
       5, 1, "without END_DATA", "anew"},
      {"UnfilledRow", cgats("SAMPLE_ID LAB_L LAB_A LAB_B", "1 50 0"), 5, 1, "do not fill",
       "value per field"},
      {"LabOfUnknownWhite", cgats("SAMPLE_ID LAB_L LAB_A LAB_B", "1 50 0 0"), 5, 1, "no white",
       "white=D50/2"},
      {"NoUsableField", cgats("SAMPLE_ID CMYK_C", "1 50"), 0, 0, "no table", "SPECTRAL_NM_400"},
      {"BandsMisstated",
       cgats("SAMPLE_ID R400 R500 R600", "1 1 1 1", "CGATS.17\nSPECTRAL_BANDS 80\n"), 6, 1,
       "80 bands", "mend"},
      {"CgatsNumber", cgats("SAMPLE_ID R400 R500", "1 10 x", "CTI3\n"), 6, 6, "\"x\"", "finite"},
      {"LampFile", cgats("SAMPLE_ID SPEC_400 SPEC_500", "1 10 20", "SPECT\n"), 1, 1, "lamps",
       "scale="},
      {"TwoTables", cgats("SAMPLE_ID R400 R500", "1 10 20") + "BEGIN_DATA\n2 10 20\nEND_DATA\n", 8,
       1, "2 tables", "pick=1"},
      {"QtxWithoutRange", qtx + "STD_R=1,2,3,\n", 1, 1, "no wavelengths", "REFLLOW"},
      {"QtxCount",
       qtx + "STD_REFLPOINTS=4,\nSTD_REFLINTERVAL=10,\nSTD_REFLLOW=400,\nSTD_R=1,2,3,\n", 6, 1,
       "4 are announced", "REFLPOINTS"},
      {"QtxNumber",
       qtx + "STD_REFLPOINTS=3,\nSTD_REFLINTERVAL=10,\nSTD_REFLLOW=400,\nSTD_R=1,x,3,\n", 6, 1,
       "\"x\"", "percent"},
  };
}

class Refusals : public testing::TestWithParam<Bad> {};

TEST_P(Refusals, SayWhereWhatAndHowToMendIt) {
  const Bad& bad = GetParam();
  try {
    (void)parse_paint_file("bad.txt", bad.text);
    FAIL() << "accepted";
  } catch (const spectra::InputError& error) {
    const spectra::Fault& first = error.faults().front();
    EXPECT_EQ(first.file, "bad.txt");
    EXPECT_EQ(first.line, bad.line) << error.what();
    EXPECT_EQ(first.column, bad.column) << error.what();
    EXPECT_THAT(first.problem, testing::HasSubstr(bad.word));
    EXPECT_THAT(first.remedy, testing::HasSubstr(bad.remedy));
  }
}

const auto kNamed = [](const auto& info) { return info.param.name; };
INSTANTIATE_TEST_SUITE_P(Tables, Refusals, testing::ValuesIn(tables()), kNamed);
INSTANTIATE_TEST_SUITE_P(Formats, Refusals, testing::ValuesIn(formats()), kNamed);

TEST(Refusals, AllFaultsOfAFileAtOnceInItsOrder) {
  try {
    (void)parse_paint_file("bad.csv", "name" + kBands + "a,0.1,x,0.1,0.1,0.1,0.1,0.1,0.1\n" +
                                          "a,0.1,-2,0.1,0.1,0.1,0.1,0.1,y\n");
    FAIL() << "accepted";
  } catch (const spectra::InputError& error) {
    ASSERT_EQ(error.faults().size(), 4U) << error.what();
    EXPECT_EQ(error.faults()[0].line, 2);
    EXPECT_EQ(error.faults()[1].column, 1);
    EXPECT_EQ(error.faults()[3].column, 30);
  }
}

}  // namespace
}  // namespace paints
