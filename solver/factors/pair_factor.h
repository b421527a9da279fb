#pragma once
#include <algorithm>

#include "solver/factors/facet.h"
#include "solver/factors/rectangle_pairs.h"

namespace solver {

/// Exchange areas A_i F_ij of planar convex polygons that nothing hides from each other, and form
/// factors of points. All are symmetric in their two polygons up to rounding.

/// Parallel rectangles that face each other across a gap z > 0, edges parallel to x and y: A_1
/// F_12, m^2.
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
/// for aligned rectangles that are not far, integrals along both contours for other near pairs,
/// also touching ones, Gauss on both areas for the rest. 0 <= A_i F_ij <= min(A_i, A_j).
[[nodiscard]] double exchange_area(const Facet& i, const Facet& j);

/// Estimate of the error that the rule leaves in A_i F_ij, m^2: larger than it in all the random
/// pairs of the tests. Rounding to float in storage adds 6e-8 of the value.
[[nodiscard]] double exchange_error_m2(const Facet& i, const Facet& j);

/// Order of the rule for facets this far apart (centre distance / larger size): points per edge of
/// a product rule of Gauss, or a rule exact to the same degree; 0: too near.
[[nodiscard]] inline int far_field_order(double distance_over_size) {
  if (distance_over_size >= 70) return 2;
  if (distance_over_size >= 14) return 3;
  return distance_over_size >= 7 ? 4 : 0;
}

/// Whether two areas are near enough to each other for the closed form of aligned rectangles: it is
/// a difference of terms as large as the larger one, and below this ratio keeps less than 1e-7.
[[nodiscard]] inline bool closed_form_suits(double area_m2, double other_m2) {
  return std::min(area_m2, other_m2) >= 1e-8 * std::max(area_m2, other_m2);
}

/// Product Gauss on both facets; they must face each other wholly.
[[nodiscard]] double far_exchange(const std::vector<QuadraturePoint>& from,
                                  const Eigen::Vector3d& from_normal,
                                  const std::vector<QuadraturePoint>& to,
                                  const Eigen::Vector3d& to_normal);

}  // namespace solver
