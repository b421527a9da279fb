#include "apps/pictures/atlas_picture.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "appearance/spectra/rgb_space.h"
#include "apps/pictures/svg.h"

namespace apps {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSize = 900, kMargin = 70;  ///< of the picture, in its own units

/// sRGB with its transfer function [IEC61966-2-1], clipped to what a screen shows.
std::string screen_colour(const spectra::RelativeXyz& xyz) {
  const Vector3d linear =
      spectra::rgb_space("srgb").xyz_from_rgb.inverse() * (Vector3d(xyz.x, xyz.y, xyz.z) / 100);
  std::array<int, 3> c{};
  for (int i = 0; i < 3; ++i) {
    const double v = std::clamp(linear[i], 0.0, 1.0);
    const double coded = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
    c[static_cast<std::size_t>(i)] = static_cast<int>(std::lround(255 * coded));
  }
  return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]);
}

/// From chroma units to the picture, the same scale on both axes.
class Plane {
 public:
  explicit Plane(double reach) : reach_(reach) {}

  [[nodiscard]] Vector2d at(const Vector2d& ab) const {
    const double scale = (kSize - 2 * kMargin) / (2 * reach_);
    return {kSize / 2 + scale * ab.x(), kSize / 2 - scale * ab.y()};
  }

  [[nodiscard]] std::string grid() const {
    std::string svg;
    const double step = reach_ > 60 ? 20 : 10;
    for (double c = step; c <= reach_ + 1e-9; c += step) {
      const Vector2d edge = at({c, 0});
      svg += fmt::format(
          "<circle cx='{0:.1f}' cy='{0:.1f}' r='{1:.1f}' fill='none' stroke='#ddd'/>\n"
          "<text x='{2:.1f}' y='{3:.1f}' class='tick'>{4:g}</text>\n",
          kSize / 2, edge.x() - kSize / 2, edge.x() + 2, kSize / 2 + 14, c);
    }
    svg += fmt::format(
        "<path d='M {0:g} {2:g} H {1:g} M {2:g} {0:g} V {1:g}' stroke='#888'/>\n"
        "<text x='{2:g}' y='{3:g}' text-anchor='middle'>right: a_C, redness; up: b_C, yellowness; "
        "circles: chroma C of CIECAM02</text>\n",
        kMargin, kSize - kMargin, kSize / 2, kSize - 25);
    return svg;
  }

 private:
  double reach_;
};

std::string arrow(const Plane& plane, const ChipArrow& chip) {
  const Vector2d from = plane.at(chip.swatch), to = plane.at(chip.room), way = to - from;
  const double length = way.norm(), head = std::min(6.0, length / 2);
  std::string svg = fmt::format(
      "<g stroke='{0}' fill='{0}'><title>{1}</title><circle cx='{2:.1f}' cy='{3:.1f}' r='2.5' "
      "stroke='#444' stroke-width='0.4'/>",
      screen_colour(chip.colour), svg_escaped(chip.name), from.x(), from.y());
  if (length > 0.5) {
    const Vector2d along = way / length, across(-along.y(), along.x()), base = to - head * along;
    const Vector2d left = base + head / 2.5 * across, right = base - head / 2.5 * across;
    svg += fmt::format(
        "<path fill='none' d='M {:.1f} {:.1f} L {:.1f} {:.1f}'/>"
        "<path stroke='#444' stroke-width='0.4' d='M {:.1f} {:.1f} L {:.1f} {:.1f} L {:.1f} {:.1f} "
        "Z'/>",
        from.x(), from.y(), base.x(), base.y(), to.x(), to.y(), left.x(), left.y(), right.x(),
        right.y());
  }
  return svg + "</g>\n";
}

}  // namespace

std::string arrow_picture(const std::string& title, const std::vector<ChipArrow>& chips) {
  double reach = 10;
  for (const ChipArrow& c : chips) {
    reach = std::max({reach, c.swatch.norm(), c.room.norm()});
  }
  const Plane plane(std::ceil(reach / 10) * 10);
  std::string svg = svg_head(kSize, kSize);
  svg += fmt::format(
      "<text x='{0:g}' y='30' text-anchor='middle' font-size='18'>{1}</text>\n"
      "<text x='{0:g}' y='50' text-anchor='middle'>dot: on the swatch; arrow head: in the "
      "room</text>\n",
      kSize / 2, svg_escaped(title));
  svg += plane.grid();
  for (const ChipArrow& c : chips) svg += arrow(plane, c);
  return svg + "</svg>\n";
}

}  // namespace apps
