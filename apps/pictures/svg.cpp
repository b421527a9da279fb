#include "apps/pictures/svg.h"

#include <fmt/format.h>

namespace apps {

std::string svg_escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string svg_head(double width, double height) {
  return fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0:g} {1:g}' width='{0:g}' "
      "height='{1:g}' font-family='sans-serif' font-size='14'>\n"
      "<style>.tick {{ font-size: 11px; fill: #777 }}</style>\n"
      "<rect width='100%' height='100%' fill='white'/>\n",
      width, height);
}

}  // namespace apps
