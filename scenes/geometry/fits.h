#pragma once
#include <optional>

#include "scenes/geometry/plane_polygon.h"

namespace scenes {

/// What touches within this distance does not overlap.
inline constexpr double kTouch_m = 1e-9;

/// The first edge (by its first corner) that meets an edge it is no neighbour of, or that folds
/// back on its neighbour.
[[nodiscard]] std::optional<std::size_t> first_crossing_edge(const Polygon& plan);

/// Distance to the nearest edge.
[[nodiscard]] double distance_to_boundary_m(const Polygon& plan, const Eigen::Vector2d& point);

/// Inside a simple polygon; of points on its boundary some are.
[[nodiscard]] bool is_inside(const Polygon& plan, const Eigen::Vector2d& point);

/// Inside or on the boundary.
[[nodiscard]] bool is_inside_or_on(const Polygon& plan, const Eigen::Vector2d& point);

/// A convex polygon lies wholly within a simple one; it may touch it.
[[nodiscard]] bool fits_into(const Polygon& plan, const Polygon& convex);

/// Two convex polygons share more than a boundary.
[[nodiscard]] bool overlap(const Polygon& convex, const Polygon& other_convex);

/// Rectangle along the axes.
[[nodiscard]] Polygon rectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& high);

}  // namespace scenes
