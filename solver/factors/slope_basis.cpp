#include "solver/factors/slope_basis.h"

#include <Eigen/Geometry>
#include <cmath>

namespace solver {
namespace {

using Eigen::Vector3d;
using Polygon = std::vector<Vector3d>;

constexpr double kNoWidth_m2 = 1e-24;

}  // namespace

/// Gram-Schmidt on the coordinates along and across the first edge.
SlopeBasis slope_basis(const Facet& facet) {
  const Vector3d along = (facet.vertices[1] - facet.vertices[0]).normalized();
  const Vector3d across = facet.normal.cross(along);
  double uu = 0, uv = 0, vv = 0;  // second moments over the area, m^2
  for (const QuadraturePoint& p : quadrature(facet.vertices, 2)) {
    const Vector3d r = p.position - facet.centre;
    const double u = along.dot(r), v = across.dot(r), share = p.weight_m2 / facet.area_m2;
    uu += share * u * u;
    uv += share * u * v;
    vv += share * v * v;
  }
  SlopeBasis basis{.gradient_per_m = {Vector3d::Zero(), Vector3d::Zero()}};
  if (uu <= kNoWidth_m2) return basis;
  basis.gradient_per_m[0] = along / std::sqrt(uu);
  const double rest = vv - uv * uv / uu;
  if (rest > kNoWidth_m2) {
    basis.gradient_per_m[1] = (across - uv / uu * along) / std::sqrt(rest);
  }
  return basis;
}

std::vector<SlopeBasis> slope_bases(const std::vector<Facet>& facets) {
  std::vector<SlopeBasis> bases;
  bases.reserve(facets.size());
  for (const Facet& f : facets) bases.push_back(slope_basis(f));
  return bases;
}

std::vector<Polygon> parts_of(const Polygon& v) {
  constexpr int kParts = 4;
  std::vector<Polygon> all;
  for (std::size_t i = 1; i + 1 < v.size(); i += 2) {
    const Vector3d &a = v[0], &b = v[i], &c = v[i + 1], &d = i + 2 < v.size() ? v[i + 2] : a;
    const auto at = [&](int s, int t) -> Vector3d {
      const double u = static_cast<double>(s) / kParts, w = static_cast<double>(t) / kParts;
      return (1 - w) * ((1 - u) * a + u * b) + w * ((1 - u) * d + u * c);
    };
    for (int s = 0; s < kParts; ++s) {
      for (int t = 0; t < kParts; ++t) {
        all.push_back({at(s, t), at(s + 1, t), at(s + 1, t + 1), at(s, t + 1)});
      }
    }
  }
  return all;
}

Vector3d middle_of(const Polygon& polygon) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& v : polygon) sum += v;
  return sum / static_cast<double>(polygon.size());
}

Eigen::Matrix2Xd slopes_of_parts(const Facet& facet, const SlopeBasis& basis) {
  const std::vector<Polygon> parts = parts_of(facet.vertices);
  Eigen::Matrix2Xd slopes(2, static_cast<Eigen::Index>(parts.size()));
  Eigen::Array2d square = Eigen::Array2d::Zero();
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Eigen::Vector2d slope = basis.at(middle_of(parts[k]) - facet.centre);
    const Vector3d twice_area = (parts[k][2] - parts[k][0]).cross(parts[k][3] - parts[k][1]);
    square += twice_area.norm() / (2 * facet.area_m2) * slope.array().square();
    slopes.col(static_cast<Eigen::Index>(k)) = slope;
  }
  const Eigen::Array2d stretch = (square > 0).select(square.inverse(), 0.0);
  return stretch.matrix().asDiagonal() * slopes;
}

}  // namespace solver
