// The same ten papers in twelve dialects are the same numbers.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "appearance/spectra/spectrum_library.h"
#include "appearance/spectra/text/input_error.h"
#include "paints/files/paint_reader.h"

namespace paints {
namespace {

using spectra::NamedSpectrum;
using Numbers = std::function<std::string(double)>;

std::vector<NamedSpectrum> every_45th() {
  const auto& all = spectra::atlas("munsell-nickerson").entries;
  std::vector<NamedSpectrum> ten;
  for (std::size_t i = 20; ten.size() < 10; i += 45) {
    NamedSpectrum paper{.name = "P " + all[i].name, .samples = {}, .label = ""};
    for (std::size_t k = 0; k < all[i].samples.nm.size(); k += 2) {
      paper.samples.nm.push_back(all[i].samples.nm[k]);
      paper.samples.values.push_back(std::round(1000 * all[i].samples.values[k]) / 1000);
    }
    ten.push_back(std::move(paper));
  }
  return ten;
}

/// Every 45th paper at 10 nm: three decimals, so that no dialect rounds.
const std::vector<NamedSpectrum>& papers() {
  static const std::vector<NamedSpectrum> ten = every_45th();
  return ten;
}

std::string fraction(double value) { return fmt::format("{:.3f}", value); }

std::string percent(double value) { return fmt::format("{:.1f}", 100 * value); }

std::string comma(std::string number) {
  std::replace(number.begin(), number.end(), '.', ',');
  return number;
}

struct Dialect {
  std::string separator = ",", end = "\n", first = "name";
  std::function<std::string(double)> wavelength = [](double nm) { return fmt::format("{}", nm); };
  Numbers number = fraction;
  bool falling = false;
};

std::string table(const Dialect& d) {
  std::string text = d.first;
  const auto order = [&](std::vector<double> v) {
    if (d.falling) std::reverse(v.begin(), v.end());
    return v;
  };
  for (const double nm : order(papers()[0].samples.nm)) text += d.separator + d.wavelength(nm);
  text += d.end;
  for (const NamedSpectrum& paper : papers()) {
    text += paper.name;
    for (const double v : order(paper.samples.values)) text += d.separator + d.number(v);
    text += d.end;
  }
  return text;
}

std::string down_the_rows() {
  std::string text = "Wavelength (nm)";
  const auto& ten = papers();
  for (const NamedSpectrum& paper : ten) text += "\t" + paper.name;
  for (std::size_t k = 0; k < ten[0].samples.nm.size(); ++k) {
    text += fmt::format("\n{}", ten[0].samples.nm[k]);
    for (const NamedSpectrum& paper : ten) text += "\t" + fraction(paper.samples.values[k]);
  }
  return text + "\n";
}

std::string utf16(const std::string& text) {
  std::string wide = "\xFF\xFE";
  for (const char c : text) (wide += c) += '\0';
  return wide;
}

std::string cxf() {
  std::string text =
      "<?xml version=\"1.0\"?>\n<cc:CxF xmlns:cc=\"http://colorexchangeformat.com/CxF3-core\">"
      "<cc:Resources><cc:ObjectCollection>\n";
  for (const NamedSpectrum& paper : papers()) {
    text += fmt::format(
        "<cc:Object Name=\"{}\" Id=\"c{}\"><cc:ColorValues><cc:ReflectanceSpectrum "
        "ColorSpecification=\"s\" StartWL=\"400\">",
        paper.name, paper.name.substr(2));
    for (const double v : paper.samples.values) text += fraction(v) + " ";
    text += "</cc:ReflectanceSpectrum></cc:ColorValues></cc:Object>\n";
  }
  return text +
         "</cc:ObjectCollection><cc:ColorSpecificationCollection><cc:ColorSpecification Id=\"s\">"
         "<cc:MeasurementSpec><cc:WavelengthRange StartWL=\"400\" Increment=\"10\"/>"
         "</cc:MeasurementSpec></cc:ColorSpecification></cc:ColorSpecificationCollection>"
         "</cc:Resources></cc:CxF>\n";
}

std::string cgats() {
  std::string text = "CGATS.17\r\nSPECTRAL_NORM \"100.0\"\r\nBEGIN_DATA_FORMAT\r\nSAMPLE_ID";
  for (const double nm : papers()[0].samples.nm) text += fmt::format(" SPECTRAL_NM_{}", nm);
  text += "\r\nEND_DATA_FORMAT\r\nBEGIN_DATA\r\n";
  for (const NamedSpectrum& paper : papers()) {
    text += "\"" + paper.name + "\"";
    for (const double v : paper.samples.values) text += "\t" + percent(v);
    text += "\r\n";
  }
  return text + "END_DATA\r\n";
}

std::string qtx() {
  std::string text = "exported by a spectrophotometer\r\n";
  int n = 0;
  for (const NamedSpectrum& paper : papers()) {
    text += fmt::format(
        "[STANDARD_DATA {}]\r\nSTD_NAME={}\r\nSTD_REFLPOINTS=31,\r\nSTD_REFLINTERVAL=10,\r\n"
        "STD_REFLLOW=400,\r\nSTD_VIEWING=SCI\r\nSTD_R=",
        n++, paper.name);
    for (const double v : paper.samples.values) text += percent(v) + ",";
    text += "\r\n";
  }
  return text;
}

struct Case {
  std::string name, text, rule;
};

std::vector<Case> cases() {
  const auto prefixed = [](const char* prefix, const char* suffix) {
    return [=](double nm) { return fmt::format("{}{}{}", prefix, nm, suffix); };
  };
  const auto comma_percent = [](double v) { return comma(percent(v)); };
  return {
      {"Own", table({}), "','"},
      {"SemicolonDecimalComma", table({.separator = ";", .number = comma_percent}), "';'"},
      {"TabWithBom", "\xEF\xBB\xBF" + table({.separator = "\t", .wavelength = prefixed("", "nm")}),
       "tab"},
      {"Utf16Tab", utf16(table({.separator = "\t", .wavelength = prefixed("R", "")})), "tab"},
      {"CrLf", table({.end = "\r\n", .wavelength = prefixed("R_", "")}), "','"},
      {"BareCr", table({.end = "\r", .wavelength = prefixed("nm", "")}), "','"},
      {"FallingPercent",
       table({.wavelength = prefixed("R", " nm"), .number = percent, .falling = true}), "','"},
      {"SpectralNames",
       table({.separator = ";", .first = "Sample ID", .wavelength = prefixed("SPECTRAL_NM_", "")}),
       "';'"},
      {"DownTheRows", down_the_rows(), "down the first column"},
      {"Cxf3", cxf(), "root CxF"},
      {"Cgats", cgats(), "CGATS.17"},
      {"Qtx", qtx(), "STANDARD_DATA"},
  };
}

class Dialects : public testing::TestWithParam<Case> {};

TEST_P(Dialects, GivesTheSameNumbers) {
  const PaintFile file = parse_paint_file("ten.txt", GetParam().text);
  EXPECT_THAT(file.rule, testing::HasSubstr(GetParam().rule));
  const auto& want = papers();
  ASSERT_EQ(file.paints.size(), want.size());
  for (std::size_t i = 0; i < want.size(); ++i) {
    EXPECT_EQ(file.paints[i].name, want[i].name);
    EXPECT_EQ(file.paints[i].reflectance.nm, want[i].samples.nm);
    EXPECT_FALSE(file.paints[i].reconstructed);
    ASSERT_EQ(file.paints[i].reflectance.values.size(), want[i].samples.values.size());
    for (std::size_t k = 0; k < want[i].samples.values.size(); ++k) {
      EXPECT_NEAR(file.paints[i].reflectance.values[k], want[i].samples.values[k], 1e-9);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Twelve, Dialects, testing::ValuesIn(cases()),
                         [](const auto& c) { return c.param.name; });

// Every beginning of each is a file or a fault.
TEST_P(Dialects, TruncationAnywhereIsAFileOrAFault) {
  const std::string& text = GetParam().text;
  for (std::size_t length = 0; length < text.size(); length += 37) {
    try {
      (void)parse_paint_file("cut.txt", text.substr(0, length));
    } catch (const spectra::InputError& error) {
      EXPECT_FALSE(error.faults().empty());
    }
  }
}

}  // namespace
}  // namespace paints
