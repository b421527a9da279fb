#pragma once
#include <vector>

#include "scenes/geometry/plane_polygon.h"

namespace scenes {

/// A part of a surface that becomes something else: an opening, a panel, or nothing at all where
/// furniture touches it.
struct Region {
  Polygon outline;  ///< convex
  int label = 0;
};

inline constexpr int kCutAway = -1;  ///< the label of what is removed
inline constexpr int kOwn = 0;  ///< of what stays the surface's own, but is cut along its outline

struct Piece {
  Polygon outline;  ///< convex, no collinear corners
  int label = 0;    ///< of the last region that holds it, 0 outside all of them
};

/// Cuts a simple polygon into convex ones by extending edges at its reflex corners.
[[nodiscard]] std::vector<Polygon> convex_pieces(const Polygon& outline);

struct CellSize {
  double patch_m = 0;  ///< no edge of a piece is longer
  /// Widths of the cells along axis-parallel edges of the outline, from the edge on, relative.
  std::vector<double> at_edges = {};
};

/// Cuts a simple polygon into convex pieces: by lines along the two coordinates, which also follow
/// all axis-parallel edges of the outline and of the regions that become another surface, evenly in
/// between but for the cells along the outline; and then around each region, where only pieces that
/// meet it are cut. What lies in a region `kCutAway` is left out. Row by row, always in the same
/// order.
[[nodiscard]] std::vector<Piece> cut_surface(const Polygon& outline,
                                             const std::vector<Region>& regions,
                                             const CellSize& size);

}  // namespace scenes
