#pragma once
#include <string>
#include <vector>

namespace apps {

struct ChartPoint {
  double x = 0, y = 0;  ///< drawn only if both are positive
  std::string label;    ///< beside the point, may be empty
  bool hollow = false;  ///< an empty marker
};

struct ChartLine {
  std::string name;  ///< for the legend; lines of one name look alike in all charts of a page
  std::vector<ChartPoint> points;
  bool labels_below = false;  ///< to the lower left of points, not to the upper right
};

/// Lines on two logarithmic axes.
struct Chart {
  std::string title, x_label, y_label;  ///< labels with units
  std::vector<ChartLine> lines;
};

/// An SVG page with the charts side by side, each with its legend, and notes below. Lines differ in
/// colour [Wong2011], marker and dashes, so that they stay apart in grey and for every eye.
[[nodiscard]] std::string chart_page(const std::string& title, const std::vector<Chart>& charts,
                                     const std::vector<std::string>& notes);

}  // namespace apps
