#pragma once
#include "solver/facet.h"

namespace solver {

/// Exchange areas A_i F_ij of planar convex polygons that nothing hides from each other, and form
/// factors of points. All are symmetric in their two polygons up to rounding.

/// Parallel rectangles that face each other across a gap z > 0, edges parallel to x and y: A_1
/// F_12, m^2.
struct Span {
  double from = 0, to = 0;
};

[[nodiscard]] double parallel_rectangles(Span x, Span y, Span xi, Span eta, double gap_m);

/// Perpendicular rectangles: x and xi are the distances from the line in which the planes meet (>=
/// 0), y and eta run along it. Touching edges are allowed.
[[nodiscard]] double perpendicular_rectangles(Span x, Span y, Span xi, Span eta);

/// Form factor from a surface element to a polygon [Lambert1760]: the polygon is clipped to the
/// horizon; positive if it shows its front to the point. Zero where the point lies in the polygon's
/// plane.
[[nodiscard]] double point_to_polygon(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                                      const std::vector<Eigen::Vector3d>& polygon);

/// A_i F_ij of two facets: clipped to each other's front, then by the distance rule: closed form
/// for aligned rectangles that are near, integrals along both contours for other near pairs, also
/// touching ones, Gauss on both areas where they are far. 0 <= A_i F_ij <= min(A_i, A_j).
[[nodiscard]] double exchange_area(const Facet& i, const Facet& j);

/// Points per edge of the product rule for facets this far apart (centre distance / larger size);
/// 0: too near.
[[nodiscard]] int far_field_order(double distance_over_size);

/// Product Gauss on both facets; they must face each other wholly.
[[nodiscard]] double far_exchange(const std::vector<QuadraturePoint>& from,
                                  const Eigen::Vector3d& from_normal,
                                  const std::vector<QuadraturePoint>& to,
                                  const Eigen::Vector3d& to_normal);

}  // namespace solver
