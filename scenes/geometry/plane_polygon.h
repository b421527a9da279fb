#pragma once
#include <Eigen/Core>
#include <vector>

namespace scenes {

/// Corners in one plane, counter-clockwise, in metres; the last is joined to the first.
using Polygon = std::vector<Eigen::Vector2d>;

/// A directed line; `direction` has length 1.
struct Line {
  Eigen::Vector2d point, direction;

  /// Distance of p, positive on the left of the line.
  [[nodiscard]] double left_by(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d d = p - point;
    return direction.x() * d.y() - direction.y() * d.x();
  }
};

/// The line along edge i, from corner i to the next: a convex polygon lies on its left.
[[nodiscard]] Line edge_line(const Polygon& polygon, std::size_t i);

/// Positive if counter-clockwise.
[[nodiscard]] double area(const Polygon& polygon);

/// Centroid of the area, which must not be zero.
[[nodiscard]] Eigen::Vector2d centroid(const Polygon& polygon);

/// The part of a convex polygon on the left of a line; empty if there is none
/// [SutherlandHodgman1974].
[[nodiscard]] Polygon clip(const Polygon& convex, const Line& line);

/// Area that two convex polygons share.
[[nodiscard]] double shared_area(const Polygon& convex, const Polygon& other_convex);

/// Drops corners that lie on the straight line between their neighbours, to `tolerance_m`.
[[nodiscard]] Polygon without_collinear_corners(const Polygon& polygon, double tolerance_m);

}  // namespace scenes
