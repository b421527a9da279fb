#include "apps/pictures/model_spread_picture.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "appearance/size_effect.h"
#include "apps/pictures/svg.h"
#include "apps/reports/model_spread_report.h"

namespace apps {
namespace {

constexpr double kWidth = 900, kHeight = 700, kMargin = 70;
constexpr double kKey = 260;  ///< width of the key on the right

/// What stands at a choice: the paint that is best by it, or the first row.
struct Point {
  std::string choice, name;
  double a_c = 0, b_c = 0;
};

std::vector<Point> points_of(const ModelSpread& spread) {
  std::vector<Point> points;
  for (std::size_t c = 0; c < spread.choices.all.size(); ++c) {
    const SpreadRow* row = &spread.rows.front();
    for (const SpreadRow& r : spread.rows) {
      if (!r.ranks.empty() && r.ranks[c] == 1) row = &r;
    }
    const appearance::Correlates& k = row->looks[c].correlates;
    points.push_back(
        {.choice = spread.choices.all[c].name, .name = row->name, .a_c = k.a_c, .b_c = k.b_c});
  }
  return points;
}

/// The smallest square that holds all points, with some air.
struct Window {
  double a = 0, b = 0, reach = 1;  ///< centre and half side

  explicit Window(const std::vector<Point>& points) {
    double least_a = points[0].a_c, most_a = least_a, least_b = points[0].b_c, most_b = least_b;
    for (const Point& p : points) {
      least_a = std::min(least_a, p.a_c), most_a = std::max(most_a, p.a_c);
      least_b = std::min(least_b, p.b_c), most_b = std::max(most_b, p.b_c);
    }
    a = (least_a + most_a) / 2, b = (least_b + most_b) / 2;
    reach = std::max({2.0, (most_a - least_a) / 2, (most_b - least_b) / 2}) * 1.15;
  }

  [[nodiscard]] Eigen::Vector2d at(double a_c, double b_c) const {
    const double side = kHeight - 2 * kMargin;
    return {kMargin + side * (0.5 + (a_c - a) / (2 * reach)),
            kHeight - kMargin - side * (0.5 + (b_c - b) / (2 * reach))};
  }
};

std::string axes(const Window& window) {
  const double edge = kHeight - kMargin, step = window.reach > 10 ? 5 : 1;
  std::string svg = fmt::format(
      "<rect x='{0:g}' y='{0:g}' width='{1:g}' height='{1:g}' fill='none' "
      "stroke='#888'/>\n",
      kMargin, edge - kMargin);
  const auto each = [&](double centre, const auto& draw) {
    for (double v = std::ceil((centre - window.reach) / step) * step; v <= centre + window.reach;
         v += step) {
      draw(v);
    }
  };
  each(window.a, [&](double v) {
    svg += fmt::format("<text x='{:.1f}' y='{:g}' class='tick' text-anchor='middle'>{:g}</text>\n",
                       window.at(v, window.b).x(), edge + 16, v);
  });
  each(window.b, [&](double v) {
    svg += fmt::format("<text x='{:g}' y='{:.1f}' class='tick' text-anchor='end'>{:g}</text>\n",
                       kMargin - 6, window.at(window.a, v).y() + 4, v);
  });
  return svg + fmt::format(
                   "<text x='{:g}' y='{:g}' text-anchor='middle'>right: a_C, redness; up: b_C, "
                   "yellowness</text>\n",
                   kHeight / 2, kHeight - 20);
}

}  // namespace

std::string model_spread_picture(const std::string& title, const ModelSpread& spread) {
  const std::vector<Point> points = points_of(spread);
  const Window window(points);
  std::string svg = svg_head(kWidth, kHeight);
  svg += fmt::format("<text x='{:g}' y='30' text-anchor='middle' font-size='18'>{}</text>\n",
                     kWidth / 2, svg_escaped(title));
  svg += axes(window);
  for (std::size_t c = 0; c < points.size(); ++c) {
    const Eigen::Vector2d at = window.at(points[c].a_c, points[c].b_c);
    const bool asked = c == spread.choices.asked;
    svg += fmt::format(
        "<circle cx='{0:.1f}' cy='{1:.1f}' r='4' fill='{2}' stroke='#333'/>"
        "<text x='{3:.1f}' y='{4:.1f}'>{5}</text>\n"
        "<text x='{6:g}' y='{7:g}' class='tick'{8}>{5}: {9}</text>\n"
        "<text x='{6:g}' y='{10:g}' class='tick'>{11}</text>\n",
        at.x(), at.y(), asked ? "#333" : "#fff", at.x() + 6, at.y() - 4, c + 1, kWidth - kKey,
        kMargin + 40.0 * static_cast<double>(c) + 10, asked ? " font-weight='bold'" : "",
        svg_escaped(points[c].choice), kMargin + 40.0 * static_cast<double>(c) + 25,
        svg_escaped(points[c].name));
  }
  svg += fmt::format("<text x='{:g}' y='{:g}' class='tick'>size: {}; bold: as asked</text>\n",
                     kWidth - kKey, kHeight - kMargin, appearance::kSizeEffectCaution);
  return svg + "</svg>\n";
}

std::vector<OutputFile> model_spread_files(const std::filesystem::path& out,
                                           const std::string& title, const ModelSpread& spread) {
  if (spread.rows.empty()) return {};
  return {{.path = out / "model_spread.csv", .text = model_spread_csv(spread)},
          {.path = out / "model_spread.svg", .text = model_spread_picture(title, spread)}};
}

}  // namespace apps
