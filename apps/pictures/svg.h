#pragma once
#include <string>

namespace apps {

/// Text as it may stand in an SVG file.
[[nodiscard]] std::string svg_escaped(const std::string& text);

/// The first lines of a picture on white: its size and the style of its ticks. What follows ends
/// with </svg>.
[[nodiscard]] std::string svg_head(double width, double height);

}  // namespace apps
