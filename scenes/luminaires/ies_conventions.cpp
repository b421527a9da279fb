#include "scenes/luminaires/ies_conventions.h"

#include <algorithm>
#include <cctype>
#include <map>

namespace scenes {

std::string upper(std::string_view text) {
  std::string out(text);
  std::ranges::transform(out, out.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return out;
}

int ies_year(std::string_view first_line) {
  static const std::map<std::string, int> kYears{
      {"IESNA86", 1986},          {"IESNA:LM-63-1986", 1986}, {"IESNA91", 1991},
      {"IESNA:LM-63-1991", 1991}, {"IESNA95", 1995},          {"IESNA:LM-63-1995", 1995},
      {"IESNA:LM-63-2002", 2002}, {"IES:LM-63-2019", 2019}};
  const std::string line = upper(first_line);
  if (const auto known = kYears.find(line); known != kYears.end()) return known->second;
  return line.starts_with("IES") ? 0 : 1986;
}

IesShape ies_shape(double width, double length, double height) {
  const auto sign = [](double v) { return v > 0 ? '+' : v < 0 ? '-' : '0'; };
  const std::string signs{sign(width), sign(length), sign(height)};
  if (signs == "000") return {LuminousShape::point};
  if (signs == "--0" || signs == "-00") return {LuminousShape::ellipse};
  if (signs == "--+" || signs == "-0+" || signs == "-+-" || signs == "+--") {
    return {LuminousShape::cylinder};
  }
  if (signs == "---" || signs == "-0-") return {LuminousShape::sphere};
  const bool known = signs.find('-') == signs.npos;
  return {height == 0 ? LuminousShape::rectangle : LuminousShape::box, known};
}

}  // namespace scenes
