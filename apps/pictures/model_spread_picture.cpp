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
  bool defined = true;  ///< else CIECAM02 says nothing of it, and it has no place
};

std::vector<Point> points_of(const ModelSpread& spread) {
  std::vector<Point> points;
  for (std::size_t c = 0; c < spread.choices.all.size(); ++c) {
    const SpreadRow* row = &spread.rows.front();
    for (const SpreadRow& r : spread.rows) {
      if (!r.ranks.empty() && r.ranks[c] == 1) row = &r;
    }
    const appearance::Correlates& k = row->looks[c].correlates;
    points.push_back({.choice = spread.choices.all[c].name,
                      .name = row->name,
                      .a_c = k.a_c,
                      .b_c = k.b_c,
                      .defined = k.status.all_defined()});
  }
  return points;
}

/// The smallest square that holds all points, with some air.
struct Window {
  double a = 0, b = 0, reach = 1;  ///< centre and half side

  explicit Window(const std::vector<Point>& points) {
    const auto first = std::ranges::find_if(points, &Point::defined);
    if (first == points.end()) return;
    double least_a = first->a_c, most_a = least_a, least_b = first->b_c, most_b = least_b;
    for (const Point& p : points) {
      if (!p.defined) continue;
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

/// Looks that differ in the background alone nearly coincide, mostly with the larger chroma for
/// Y_b 20: its number stands outwards.
std::string mark(const Window& window, const Point& point, std::size_t number, bool asked,
                 bool outwards) {
  const Eigen::Vector2d at = window.at(point.a_c, point.b_c);
  const Eigen::Vector2d radial = Eigen::Vector2d(point.a_c, -point.b_c).normalized();
  const Eigen::Vector2d label = at + (outwards ? 14 : -14) * radial;
  return fmt::format(
      "<circle cx='{:.1f}' cy='{:.1f}' r='4' fill='{}' stroke='#333'/>"
      "<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>{}</text>\n",
      at.x(), at.y(), asked ? "#333" : "#fff", label.x(), label.y() + 5, number);
}

std::string key(const Point& point, std::size_t number, bool asked) {
  const double top = kMargin + 40.0 * static_cast<double>(number - 1);
  return fmt::format(
      "<text x='{0:g}' y='{1:g}' class='tick'{2}>{3}: {4}</text>\n"
      "<text x='{0:g}' y='{5:g}' class='tick'>{6}{7}</text>\n",
      kWidth - kKey, top + 10, asked ? " font-weight='bold'" : "", number,
      svg_escaped(point.choice), top + 25, svg_escaped(point.name),
      point.defined ? "" : ", not defined by CIECAM02");
}

}  // namespace

std::string model_spread_picture(const std::string& title, const ModelSpread& spread) {
  const std::vector<Point> points = points_of(spread);
  const Window window(points);
  std::string svg = svg_head(kWidth, kHeight);
  svg += fmt::format("<text x='{:g}' y='30' text-anchor='middle' font-size='18'>{}</text>\n",
                     kWidth / 2, svg_escaped(title));
  svg += fmt::format(
      "<text x='{:g}' y='52' text-anchor='middle' class='tick'>{} under each choice of how the eye "
      "is modelled</text>\n",
      kWidth / 2,
      spread.winners.empty() ? svg_escaped(spread.rows.front().name) : "the best paint");
  svg += axes(window);
  for (std::size_t c = 0; c < points.size(); ++c) {
    const bool asked = c == spread.choices.asked;
    if (points[c].defined) {
      const auto background = spread.choices.all[c].viewing.background;
      svg += mark(window, points[c], c + 1, asked, background == spectra::Background::fixed);
    }
    svg += key(points[c], c + 1, asked);
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
