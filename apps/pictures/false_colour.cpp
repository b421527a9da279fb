#include "apps/pictures/false_colour.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/pictures/pixel_font.h"

namespace apps {
namespace {

using Eigen::Vector3d;

/// Viridis by Nathaniel Smith and Stefan van der Walt (CC0), at every eighth.
const std::array<Vector3d, 9> kViridis{{{68, 1, 84},
                                        {71, 44, 122},
                                        {59, 81, 139},
                                        {44, 113, 142},
                                        {33, 144, 141},
                                        {39, 173, 129},
                                        {92, 200, 99},
                                        {170, 220, 50},
                                        {253, 231, 37}}};
const Vector3d kPaper(1, 1, 1), kInk(0, 0, 0);
constexpr double kDarkest = 0.01;   ///< share of the pixels that may lie below the scale
constexpr int kLegendLetters = 14;  ///< across
constexpr double kEdge = 1.15;      ///< ratio of two pixels that show different things
constexpr double kDecades = 6;      ///< at most

/// The legend's letters grow with the picture.
int dot_of(int height) { return std::max(1, height / 480); }

std::vector<double> ticks_of(const Eigen::ArrayXf& values) {
  std::vector<float> sorted;
  for (const float v : values) {
    if (v > 0) sorted.push_back(v);
  }
  if (sorted.empty()) return {0.5, 1};
  const auto low =
      sorted.begin() + static_cast<std::ptrdiff_t>(kDarkest * static_cast<double>(sorted.size()));
  std::ranges::nth_element(sorted, low);
  const double least = *low, most = *std::ranges::max_element(sorted);
  return decade_ticks(std::max(least, most * std::pow(10, -kDecades)), most);
}

void draw_legend(PngPicture& png, int left, const std::vector<double>& ticks,
                 const Quantity& quantity) {
  const int dot = dot_of(png.height), line = kLetterRows * dot, margin = line / 2;
  draw_text(png, quantity.name, left + margin, margin, dot, kInk);
  draw_text(png, quantity.unit + ", log", left + margin, margin + line, dot, kInk);
  const int top = margin + 3 * line, bottom = png.height - margin - line, bar = 2 * line;
  for (int y = top; y <= bottom; ++y) {
    fill(png, left + margin, y, bar, 1,
         viridis(static_cast<double>(bottom - y) / std::max(1, bottom - top)));
  }
  int free_from = bottom + line;  // labels are left out where they would touch
  for (const double tick : ticks) {
    const double at = std::log(tick / ticks.front()) / std::log(ticks.back() / ticks.front());
    const int y = bottom - static_cast<int>(std::lround(at * (bottom - top)));
    fill(png, left + margin + bar, y, 2 * dot, dot, kInk);
    if (y + line / 2 > free_from) continue;
    draw_text(png, fmt::format("{:g}", tick), left + margin + bar + 4 * dot, y - 4 * dot, dot,
              kInk);
    free_from = y - line / 2;
  }
}

}  // namespace

Vector3d viridis(double at) {
  const double place = std::clamp(at, 0.0, 1.0) * (kViridis.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(place), kViridis.size() - 2);
  const double part = place - static_cast<double>(k);
  return ((1 - part) * kViridis[k] + part * kViridis[k + 1]) / 255;
}

std::vector<double> decade_ticks(double least, double most) {
  std::vector<double> ticks;
  for (int decade = static_cast<int>(std::floor(std::log10(least)));; ++decade) {
    for (const double step : {1.0, 2.0, 5.0}) {
      const double tick = step * std::pow(10, decade);
      if (tick <= least) ticks.clear();
      ticks.push_back(tick);
      if (tick >= most && ticks.size() > 1) return ticks;
    }
  }
}

PngPicture false_colours(int width, int height, const Eigen::ArrayXf& values,
                         const Quantity& quantity) {
  const std::vector<double> ticks = ticks_of(values);
  const double low = std::log(ticks.front()), span = std::log(ticks.back()) - low;
  const int legend = kLegendLetters * kLetterColumns * dot_of(height);
  PngPicture png{.width = width + legend, .height = height};
  png.samples.resize(3 * static_cast<std::size_t>(png.width) * static_cast<std::size_t>(height));
  fill(png, width, 0, legend, height, kPaper);
  const auto value = [&](int x, int y) { return values[Eigen::Index{y} * width + x]; };
  const auto step_of = [&](double v) { return std::ranges::upper_bound(ticks, v) - ticks.begin(); };
  // Whether two pixels show different things; the edge of a thing is no line of its light.
  const auto edge_between = [&](double a, double b) {
    return std::max(a, b) > kEdge * std::min(a, b);
  };
  const auto on_line = [&](int x, int y) {
    const double v = value(x, y);
    bool line = false, edge = false;
    for (const auto& [dx, dy] :
         {std::pair(1, 0), std::pair(0, 1), std::pair(-1, 0), std::pair(0, -1)}) {
      if (x + dx < 0 || x + dx >= width || y + dy < 0 || y + dy >= height) continue;
      const double other = value(x + dx, y + dy);
      edge = edge || edge_between(v, other);
      line = line || (dx + dy > 0 && step_of(v) != step_of(other));
    }
    return line && !edge;
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double v = value(x, y), at = v > 0 ? (std::log(v) - low) / span : 0;
      fill(png, x, y, 1, 1, on_line(x, y) ? (at > 0.6 ? kInk : kPaper) : viridis(at));
    }
  }
  draw_legend(png, width, ticks, quantity);
  return png;
}

}  // namespace apps
