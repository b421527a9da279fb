#include "scenes/shapes/plates.h"

#include <algorithm>
#include <limits>

#include "scenes/mesh/surface_cutter.h"

namespace scenes {
namespace {

using Eigen::Vector2d;

constexpr double kStraight_m = 1e-12;

}  // namespace

std::vector<Outline> convex_parts(const Outline& outline, const std::vector<Outline>& holes) {
  const PlaneCoordinates plane(outline);
  std::vector<Region> cut;
  for (const Outline& hole : holes) {
    for (Polygon& piece : convex_pieces(plane.flatten(hole))) {
      cut.push_back({std::move(piece), kCutAway});
    }
  }
  std::vector<Outline> parts;
  const auto lift = [&](const Polygon& polygon) {
    Outline& part = parts.emplace_back();
    for (const Vector2d& p : without_collinear_corners(polygon, kStraight_m)) {
      part.push_back(plane.lift(p));
    }
  };
  if (holes.empty()) {
    const std::vector<Polygon> pieces = convex_pieces(plane.flatten(outline));
    std::ranges::for_each(pieces, lift);
    if (parts.size() == 1 && parts[0].size() == outline.size()) return {outline};  // to the bit
  } else {
    constexpr double kNoCut_m = std::numeric_limits<double>::infinity();
    for (const Piece& piece : cut_surface(plane.flatten(outline), cut, {.patch_m = kNoCut_m})) {
      lift(piece.outline);
    }
  }
  return parts;
}

ConvexPart plate(const Outline& convex) {
  ConvexPart part{.corners = convex, .faces = std::vector<std::vector<int>>(2)};
  for (int i = 0, n = static_cast<int>(convex.size()); i < n; ++i) {
    part.faces[0].push_back(i);
    part.faces[1].push_back(n - 1 - i);
  }
  return part;
}

}  // namespace scenes
