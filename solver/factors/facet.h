#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

namespace solver {

/// A plane with a side: n . p > offset is in front.
struct Plane {
  Eigen::Vector3d normal;
  double offset_m = 0;

  [[nodiscard]] double height_m(const Eigen::Vector3d& p) const { return normal.dot(p) - offset_m; }
};

/// A planar convex polygon, counter-clockwise seen from its front.
struct Facet {
  std::vector<Eigen::Vector3d> vertices;
  Eigen::Vector3d centre, normal;
  double area_m2 = 0;
  double size_m = 0;       ///< diameter / sqrt 2: the edge of a square
  bool rectangle = false;  ///< four right angles

  [[nodiscard]] Plane plane() const { return {normal, normal.dot(centre)}; }
};

/// @param vertices  at least three, convex, counter-clockwise
[[nodiscard]] Facet make_facet(std::vector<Eigen::Vector3d> vertices);

/// The part in front of a plane; empty if none is. Vertices closer than 1e-12 m count as on the
/// plane.
[[nodiscard]] std::vector<Eigen::Vector3d> clip(const std::vector<Eigen::Vector3d>& polygon,
                                                const Plane& plane);

/// Whether a point of its plane lies in a convex polygon, edges included to 1e-9 m.
[[nodiscard]] bool contains(const std::vector<Eigen::Vector3d>& polygon,
                            const Eigen::Vector3d& normal, const Eigen::Vector3d& p);

/// Nodes and weights of Gauss-Legendre on [0, 1], 1 to 8 points.
struct GaussRule {
  std::vector<double> node, weight;
};

[[nodiscard]] const GaussRule& gauss(int points);

struct QuadraturePoint {
  Eigen::Vector3d position;
  double weight_m2 = 0;
};

/// order x order Gauss points on each quadrilateral of a fan; a last triangle collapses one edge.
/// The weights sum to the area.
[[nodiscard]] std::vector<QuadraturePoint> quadrature(const std::vector<Eigen::Vector3d>& polygon,
                                                      int order);

/// A point of the facet for (s, t) in the unit square; equal areas of the square map to equal
/// areas.
[[nodiscard]] Eigen::Vector3d area_point(const Facet& facet, double s, double t);

}  // namespace solver
