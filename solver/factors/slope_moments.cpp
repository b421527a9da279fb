#include "solver/factors/slope_moments.h"

#include <Eigen/Geometry>

namespace solver {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kPoints = 4, kTouchingPoints = 6;
constexpr double kTouching = 1.2;  ///< in sizes: nearer, points crowd at the edges

/// order x order points on each quadrilateral of a fan; s = u^2 (3 - 2 u) crowds them at its edges.
std::vector<QuadraturePoint> crowded_quadrature(const std::vector<Vector3d>& polygon, int order) {
  const GaussRule& rule = gauss(order);
  std::vector<QuadraturePoint> points;
  for (std::size_t i = 1; i + 1 < polygon.size(); i += 2) {
    const Vector3d &a = polygon[0], &b = polygon[i], &c = polygon[i + 1];
    const Vector3d& d = i + 2 < polygon.size() ? polygon[i + 2] : a;
    for (std::size_t k = 0; k < rule.node.size() * rule.node.size(); ++k) {
      const std::size_t s = k / rule.node.size(), t = k % rule.node.size();
      const double x = rule.node[s], y = rule.node[t];
      const double u = x * x * (3 - 2 * x), v = y * y * (3 - 2 * y);
      const Vector3d along_u = (1 - v) * (b - a) + v * (c - d);
      const Vector3d along_v = (1 - u) * (d - a) + u * (c - b);
      const double weight = rule.weight[s] * rule.weight[t] * 36 * x * (1 - x) * y * (1 - y);
      points.push_back({a + u * (b - a) + v * ((1 - u) * (d - a) + u * (c - b)),
                        weight * along_u.cross(along_v).norm()});
    }
  }
  return points;
}

}  // namespace

SlopeMoments::SlopeMoments(const std::vector<Facet>& facets)
    : facets_(facets), bases_(slope_bases(facets)) {
  std::vector<Eigen::Matrix2Xd> slopes;
  Eigen::Index count = 0;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    first_part_.push_back(parts_.size());
    for (const auto& part : parts_of(facets[i].vertices)) parts_.add(part);
    slopes.push_back(slopes_of_parts(facets[i], bases_[i]));
    count += slopes.back().cols();
  }
  first_part_.push_back(parts_.size());
  slopes_.resize(2, count);
  count = 0;
  for (const Eigen::Matrix2Xd& s : slopes) {
    slopes_.middleCols(count, s.cols()) = s;
    count += s.cols();
  }
}

Vector3d SlopeMoments::from_point(const Vector3d& point, const Vector3d& normal,
                                  std::size_t patch) const {
  const std::size_t first = first_part_[patch], end = first_part_[patch + 1];
  const Eigen::VectorXd factors = parts_.from(point, normal, first, end);
  Vector3d moment;
  moment[0] = factors.sum();
  moment.tail<2>() = slopes_.middleCols(static_cast<Eigen::Index>(first), factors.size()) * factors;
  return moment;
}

Matrix3d SlopeMoments::near(std::size_t i, std::size_t j) const {
  if (facets_[i].area_m2 > facets_[j].area_m2) return near(j, i).transpose();
  const Facet &outer = facets_[i], &inner = facets_[j];
  const std::vector<Vector3d> front = clip(outer.vertices, inner.plane());
  Matrix3d moments = Matrix3d::Zero();
  if (front.empty()) return moments;
  const bool touching = (inner.centre - outer.centre).norm() < kTouching * inner.size_m;
  for (const QuadraturePoint& p :
       touching ? crowded_quadrature(front, kTouchingPoints) : quadrature(front, kPoints)) {
    Vector3d psi;
    psi << 1, bases_[i].at(p.position - outer.centre);
    moments += p.weight_m2 * psi * from_point(p.position, outer.normal, j).transpose();
  }
  return moments;
}

}  // namespace solver
