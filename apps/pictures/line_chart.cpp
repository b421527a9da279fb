#include "apps/pictures/line_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/pictures/svg.h"

namespace apps {
namespace {

// Of the page, in its own units.
constexpr double kPanel = 600, kLeft = 85, kRight = 30, kTop = 90, kPlotHeight = 400;
constexpr double kLegendTop = 70, kLegendRow = 22, kNoteRow = 20, kMarker = 5;
constexpr int kLegendColumns = 2;

struct LineStyle {
  const char *colour, *dashes;
  const char* marker;  ///< a path in units of kMarker about the point
};

/// The colours of [Wong2011] without yellow, which paper swallows, and a grey.
constexpr std::array<LineStyle, 8> kStyles{{
    {"#0072B2", "none", "M -1 0 A 1 1 0 1 1 1 0 A 1 1 0 1 1 -1 0 Z"},
    {"#D55E00", "9 4", "M -0.9 -0.9 H 0.9 V 0.9 H -0.9 Z"},
    {"#009E73", "3 3", "M 0 -1.2 L 1.1 0.8 H -1.1 Z"},
    {"#000000", "12 3 3 3", "M 0 -1.3 L 1.3 0 L 0 1.3 L -1.3 0 Z"},
    {"#CC79A7", "6 3", "M 0 1.2 L 1.1 -0.8 H -1.1 Z"},
    {"#E69F00", "2 5", "M -1.3 -0.4 H 1.3 V 0.4 H -1.3 Z"},
    {"#56B4E9", "12 5", "M -0.4 -1.3 H 0.4 V 1.3 H -0.4 Z"},
    {"#777777", "1 3",
     "M -1.3 0 L -0.4 -0.4 L 0 -1.3 L 0.4 -0.4 L 1.3 0 L 0.4 0.4 L 0 1.3 "
     "L -0.4 0.4 Z"},
}};

bool drawn(const ChartPoint& p) {
  return p.x > 0 && p.y > 0 && std::isfinite(p.x) && std::isfinite(p.y);
}

/// 10^-3 with a raised exponent, plain where that is as short.
std::string power_of_ten(int exponent) {
  if (exponent >= -2 && exponent <= 3) return fmt::format("{:g}", std::pow(10, exponent));
  return fmt::format("10<tspan dy='-5' font-size='9'>{}{}</tspan>", exponent < 0 ? "−" : "",
                     std::abs(exponent));
}

/// From values to the page, logarithmically.
class LogAxis {
 public:
  LogAxis(double least, double most, double from, double to) : from_(from), to_(to) {
    low_ = snapped(least, -1);
    high_ = snapped(most, 1);
    if (high_ - low_ < 0.1) high_ = low_ + 0.31;
  }

  [[nodiscard]] double at(double value) const {
    return from_ + (std::log10(value) - low_) / (high_ - low_) * (to_ - from_);
  }

  struct Tick {
    double at;
    std::string label;  ///< empty: a small tick
  };

  [[nodiscard]] std::vector<Tick> ticks() const {
    const bool few = high_ - low_ < 2.5;
    std::vector<Tick> ticks;
    for (int e = static_cast<int>(std::floor(low_)); e <= high_ + 1e-9; ++e) {
      for (int m = 1; m < 10; ++m) {
        const double value = m * std::pow(10.0, e);
        const double log = std::log10(value);
        if (log < low_ - 1e-9 || log > high_ + 1e-9) continue;
        const bool labelled = m == 1 || (few && (m == 2 || m == 5));
        if (!labelled && high_ - low_ > 6) continue;
        ticks.push_back({at(value), !labelled          ? ""
                                    : m == 1           ? power_of_ten(e)
                                    : e >= -3 && e < 4 ? fmt::format("{:g}", value)
                                                       : fmt::format("{}×", m) + power_of_ten(e)});
      }
    }
    return ticks;
  }

 private:
  /// The next of 1, 2, 5, 10, ... below (way < 0) or above, as a logarithm, a little apart.
  static double snapped(double value, int way) {
    const double wide = value * std::pow(1.15, way), decade = std::floor(std::log10(wide));
    const double mantissa = wide / std::pow(10, decade);
    if (way < 0) return decade + std::log10(mantissa >= 5 ? 5 : mantissa >= 2 ? 2 : 1);
    return decade + std::log10(mantissa <= 2 ? 2 : mantissa <= 5 ? 5 : 10);
  }

  double from_, to_, low_ = 0, high_ = 0;
};

struct Axes {
  LogAxis x, y;
};

Axes axes_of(const Chart& chart, double left) {
  double x0 = 1e300, x1 = 0, y0 = 1e300, y1 = 0;
  for (const ChartLine& line : chart.lines) {
    for (const ChartPoint& p : line.points) {
      if (!drawn(p)) continue;
      x0 = std::min(x0, p.x), x1 = std::max(x1, p.x);
      y0 = std::min(y0, p.y), y1 = std::max(y1, p.y);
    }
  }
  if (!(x1 > 0)) x0 = y0 = 0.1, x1 = y1 = 1;  // nothing to draw: an empty frame
  return {LogAxis(x0, x1, left + kLeft, left + kPanel - kRight),
          LogAxis(y0, y1, kTop + kPlotHeight, kTop)};
}

std::string frame(const Chart& chart, const Axes& axes, double left) {
  const double x0 = left + kLeft, x1 = left + kPanel - kRight, y1 = kTop, y0 = kTop + kPlotHeight;
  std::string svg = fmt::format("<text x='{}' y='{}' font-size='16'>{}</text>\n", x0, kTop - 14,
                                svg_escaped(chart.title));
  for (const auto& [x, label] : axes.x.ticks()) {
    const bool small = label.empty();
    svg += fmt::format("<path d='M {:.1f} {:.1f} V {:.1f}' stroke='{}'/>\n", x, y0,
                       small ? y0 - 5 : y1, small ? "#888" : "#ddd");
    svg += fmt::format("<text x='{:.1f}' y='{}' text-anchor='middle' class='tick'>{}</text>\n", x,
                       y0 + 18, label);
  }
  for (const auto& [y, label] : axes.y.ticks()) {
    const bool small = label.empty();
    svg += fmt::format("<path d='M {:.1f} {:.1f} H {:.1f}' stroke='{}'/>\n", x0, y,
                       small ? x0 + 5 : x1, small ? "#888" : "#ddd");
    svg += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='end' class='tick'>{}</text>\n",
                       x0 - 6, y + 4, label);
  }
  return svg + fmt::format(
                   "<rect x='{0}' y='{1}' width='{2}' height='{3}' fill='none' stroke='#444'/>\n"
                   "<text x='{4}' y='{5}' text-anchor='middle'>{6}</text>\n"
                   "<text transform='translate({7} {8}) rotate(-90)' text-anchor='middle'>{9}"
                   "</text>\n",
                   x0, y1, x1 - x0, y0 - y1, (x0 + x1) / 2, y0 + 42, svg_escaped(chart.x_label),
                   left + 22, (y0 + y1) / 2, svg_escaped(chart.y_label));
}

std::string marker(const LineStyle& style, double x, double y, bool hollow) {
  return fmt::format(
      "<path transform='translate({:.1f} {:.1f}) scale({})' d='{}' fill='{}' stroke='{}' "
      "stroke-width='0.3'/>\n",
      x, y, kMarker, style.marker, hollow ? "white" : style.colour, style.colour);
}

std::string plotted(const ChartLine& line, const LineStyle& style, const Axes& axes) {
  std::string way, markers;
  for (const ChartPoint& p : line.points) {
    if (!drawn(p)) continue;
    const double x = axes.x.at(p.x), y = axes.y.at(p.y);
    way += fmt::format("{} {:.1f} {:.1f} ", way.empty() ? "M" : "L", x, y);
    markers += marker(style, x, y, p.hollow);
    if (p.label.empty()) continue;
    const bool below = line.labels_below;
    markers += fmt::format(
        "<text x='{:.1f}' y='{:.1f}' text-anchor='{}' font-size='11' paint-order='stroke' "
        "stroke='white' stroke-width='3' fill='{}'>{}</text>\n",
        below ? x - 7 : x + 7, below ? y + 15 : y - 6, below ? "end" : "start", style.colour,
        svg_escaped(p.label));
  }
  if (way.empty()) return {};
  return fmt::format(
             "<path d='{}' fill='none' stroke='{}' stroke-width='1.8' stroke-dasharray='{}'/>\n",
             way, style.colour, style.dashes) +
         markers;
}

std::string legend_entry(const ChartLine& line, const LineStyle& style, double x, double y) {
  return fmt::format(
             "<path d='M {} {} h 40' stroke='{}' stroke-width='1.8' stroke-dasharray='{}'/>\n", x,
             y, style.colour, style.dashes) +
         marker(style, x + 20, y, false) +
         fmt::format("<text x='{}' y='{}' font-size='13'>{}</text>\n", x + 48, y + 4,
                     svg_escaped(line.name));
}

}  // namespace

std::string chart_page(const std::string& title, const std::vector<Chart>& charts,
                       const std::vector<std::string>& notes) {
  std::vector<std::string> names;
  const auto style_of = [&](const std::string& name) -> const LineStyle& {
    const auto known = std::ranges::find(names, name);
    const auto at = static_cast<std::size_t>(known - names.begin());
    if (known == names.end()) names.push_back(name);
    return kStyles[at % kStyles.size()];
  };
  std::size_t legend_rows = 0;
  for (const Chart& chart : charts) {
    legend_rows = std::max(legend_rows, (chart.lines.size() + kLegendColumns - 1) / kLegendColumns);
  }
  const double width = kPanel * static_cast<double>(charts.size());
  const double legend = kTop + kPlotHeight + kLegendTop;
  const double below = legend + kLegendRow * static_cast<double>(legend_rows) + 10;
  std::string svg = svg_head(width, below + kNoteRow * static_cast<double>(notes.size()) + 15);
  svg += fmt::format("<text x='{}' y='36' text-anchor='middle' font-size='20'>{}</text>\n",
                     width / 2, svg_escaped(title));
  for (std::size_t c = 0; c < charts.size(); ++c) {
    const double left = kPanel * static_cast<double>(c);
    const Axes axes = axes_of(charts[c], left);
    svg += frame(charts[c], axes, left);
    for (std::size_t k = 0; k < charts[c].lines.size(); ++k) {
      const ChartLine& line = charts[c].lines[k];
      const auto column = static_cast<double>(k % kLegendColumns);
      const auto row = static_cast<double>(k / kLegendColumns);
      const double step = (kPanel - kLeft - kRight) / kLegendColumns;
      svg += plotted(line, style_of(line.name), axes);
      svg += legend_entry(line, style_of(line.name), left + kLeft + column * step,
                          legend + row * kLegendRow);
    }
  }
  for (std::size_t k = 0; k < notes.size(); ++k) {
    svg += fmt::format("<text x='{}' y='{}' font-size='12'>{}</text>\n", kLeft,
                       below + kNoteRow * static_cast<double>(k), svg_escaped(notes[k]));
  }
  return svg + "</svg>\n";
}

}  // namespace apps
