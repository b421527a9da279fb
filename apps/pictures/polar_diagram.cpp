#include "apps/pictures/polar_diagram.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "apps/pictures/svg.h"

namespace apps {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kWidth = 640, kHeight = 700, kRadius = 260;
const Vector2d kCentre(kWidth / 2, 360);
constexpr double kDegree = std::numbers::pi / 180;

/// 1, 2, 2.5 or 5 times a power of ten, so that there are four or five rings.
double ring_step(double peak_cd) {
  const double power = std::pow(10, std::floor(std::log10(peak_cd / 4)));
  for (const double step : {1.0, 2.0, 2.5, 5.0, 10.0}) {
    if (step * power >= peak_cd / 5) return step * power;
  }
  return 10 * power;
}

/// Where a direction lies on the page: the angle from straight down, to the right of it.
Vector2d at(double angle_deg, double radius) {
  return kCentre + radius * Vector2d(std::sin(angle_deg * kDegree), std::cos(angle_deg * kDegree));
}

/// Once around in a vertical plane; to the right is `side`.
std::string curve(const scenes::IntensityTable& intensity, const Vector3d& side, double per_cd,
                  const std::string& style) {
  std::string path;
  for (int angle_deg = 0; angle_deg <= 360; ++angle_deg) {
    const double angle = angle_deg * kDegree;
    const Vector3d direction = std::sin(angle) * side - std::cos(angle) * Vector3d::UnitZ();
    const Vector2d point = at(angle_deg, per_cd * intensity.at(direction));
    path += fmt::format("{}{:.2f} {:.2f} ", path.empty() ? "M" : "L", point.x(), point.y());
  }
  return fmt::format("<path d='{}' fill='none' {}/>\n", path, style);
}

std::string net(double step_cd, double per_cd, double most_cd) {
  std::string svg;
  for (double cd = step_cd; cd <= most_cd * (1 + 1e-9); cd += step_cd) {
    svg += fmt::format(
        "<circle cx='{0:g}' cy='{1:g}' r='{2:.2f}' fill='none' stroke='#ccc'/>\n"
        "<text class='tick' x='{3:.1f}' y='{4:.1f}'>{5:g} cd</text>\n",
        kCentre.x(), kCentre.y(), cd * per_cd, kCentre.x() + 3, kCentre.y() + cd * per_cd - 3, cd);
  }
  for (int angle = 0; angle < 360; angle += 30) {
    const Vector2d tip = at(angle, kRadius), label = at(angle, kRadius + 18);
    svg += fmt::format(
        "<line x1='{:g}' y1='{:g}' x2='{:.2f}' y2='{:.2f}' stroke='#ddd'/>\n"
        "<text class='tick' text-anchor='middle' x='{:.1f}' y='{:.1f}'>{}</text>\n",
        kCentre.x(), kCentre.y(), tip.x(), tip.y(), label.x(), label.y() + 4,
        angle <= 180 ? angle : 360 - angle);
  }
  return svg;
}

}  // namespace

std::string polar_diagram(const scenes::Luminaire& luminaire) {
  const double peak_cd = luminaire.intensity.peak_cd();
  const double step_cd = ring_step(peak_cd),
               most_cd = step_cd * std::ceil(peak_cd / step_cd - 1e-9);
  const double per_cd = kRadius / most_cd;
  const char *across = "stroke='#0072b2' stroke-width='2.5'",
             *along = "stroke='#d55e00' stroke-width='2.5' stroke-dasharray='8 4'";
  std::string svg = svg_head(kWidth, kHeight);
  svg += fmt::format("<text x='20' y='28' font-weight='bold'>{}</text>\n",
                     svg_escaped(luminaire.name.empty() ? luminaire.path : luminaire.name));
  svg += fmt::format(
      "<text x='20' y='50'>{:.0f} lm; vertical planes through the luminaire, cd; 0 is "
      "down</text>\n",
      luminaire.flux_lm);
  svg += net(step_cd, per_cd, most_cd);
  svg += curve(luminaire.intensity, Vector3d::UnitX(), per_cd, across);
  svg += curve(luminaire.intensity, Vector3d::UnitY(), per_cd, along);
  const double foot = kHeight - 26;
  svg += fmt::format(
      "<line x1='20' y1='{0:g}' x2='60' y2='{0:g}' {1}/><text x='68' y='{2:g}'>C0 to the right, "
      "C180 to the left</text>\n"
      "<line x1='340' y1='{0:g}' x2='380' y2='{0:g}' {3}/><text x='388' y='{2:g}'>C90 right, C270 "
      "left</text>\n</svg>\n",
      foot, across, foot + 5, along);
  return svg;
}

}  // namespace apps
