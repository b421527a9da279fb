#include "solver/factors/facet.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace solver {
namespace {

using Eigen::Vector3d;

constexpr double kOnPlane_m = 1e-12;

bool is_rectangle(const std::vector<Vector3d>& v) {
  if (v.size() != 4) return false;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d a = v[(i + 1) % 4] - v[i], b = v[(i + 2) % 4] - v[(i + 1) % 4];
    if (std::abs(a.dot(b)) > 1e-12 * a.norm() * b.norm()) return false;
  }
  return true;
}

/// Golub-Welsch: nodes are the eigenvalues of the Jacobi matrix of the Legendre polynomials.
GaussRule golub_welsch(int points) {
  Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(points, points);
  for (int k = 1; k < points; ++k) {
    jacobi(k, k - 1) = jacobi(k - 1, k) = k / std::sqrt(4.0 * k * k - 1);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(jacobi);
  GaussRule rule;
  for (int k = 0; k < points; ++k) {
    rule.node.push_back((1 + eigen.eigenvalues()[k]) / 2);
    rule.weight.push_back(eigen.eigenvectors()(0, k) * eigen.eigenvectors()(0, k));
  }
  return rule;
}

}  // namespace

Facet make_facet(std::vector<Vector3d> vertices) {
  Facet f{.vertices = std::move(vertices), .centre = Vector3d::Zero(), .normal = Vector3d::Zero()};
  const std::vector<Vector3d>& v = f.vertices;
  Vector3d twice_area = Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < v.size(); ++i) {
    twice_area += (v[i] - v[0]).cross(v[i + 1] - v[0]);
  }
  f.area_m2 = twice_area.norm() / 2;
  f.normal = twice_area.normalized();
  for (std::size_t i = 1; i + 1 < v.size(); ++i) {
    const double share = (v[i] - v[0]).cross(v[i + 1] - v[0]).dot(f.normal) / (2 * f.area_m2);
    f.centre += share * (v[0] + v[i] + v[i + 1]) / 3;
  }
  double diameter_squared = 0;
  for (const Vector3d& p : v) {
    for (const Vector3d& q : v) {
      diameter_squared = std::max(diameter_squared, (p - q).squaredNorm());
    }
  }
  f.size_m = std::sqrt(diameter_squared / 2);
  f.rectangle = is_rectangle(v);
  return f;
}

std::vector<Vector3d> clip(const std::vector<Vector3d>& polygon, const Plane& plane) {
  std::vector<Vector3d> front;
  const bool some_in_front = std::any_of(polygon.begin(), polygon.end(), [&](const Vector3d& p) {
    return plane.height_m(p) > kOnPlane_m;
  });
  if (!some_in_front) return front;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double hp = plane.height_m(p), hq = plane.height_m(q);
    if (hp >= -kOnPlane_m) front.push_back(p);
    if ((hp > kOnPlane_m && hq < -kOnPlane_m) || (hp < -kOnPlane_m && hq > kOnPlane_m)) {
      front.push_back(p + (q - p) * (hp / (hp - hq)));
    }
  }
  if (front.size() < 3) front.clear();
  return front;
}

bool contains(const std::vector<Vector3d>& polygon, const Vector3d& normal, const Vector3d& p) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d& a = polygon[i];
    const Vector3d& b = polygon[(i + 1) % polygon.size()];
    if (normal.dot((b - a).cross(p - a)) < -1e-9 * (b - a).norm()) return false;
  }
  return true;
}

const GaussRule& gauss(int points) {
  static const std::array<GaussRule, 8> kRules{golub_welsch(1), golub_welsch(2), golub_welsch(3),
                                               golub_welsch(4), golub_welsch(5), golub_welsch(6),
                                               golub_welsch(7), golub_welsch(8)};
  return kRules.at(static_cast<std::size_t>(points - 1));
}

std::vector<QuadraturePoint> quadrature(const std::vector<Vector3d>& polygon, int order) {
  const GaussRule& rule = gauss(order);
  std::vector<QuadraturePoint> points;
  for (std::size_t i = 1; i + 1 < polygon.size(); i += 2) {
    const Vector3d &a = polygon[0], &b = polygon[i], &c = polygon[i + 1];
    const Vector3d& d = i + 2 < polygon.size() ? polygon[i + 2] : a;
    for (std::size_t s = 0; s < rule.node.size(); ++s) {
      for (std::size_t t = 0; t < rule.node.size(); ++t) {
        const double u = rule.node[s], v = rule.node[t];
        const Vector3d along_u = (1 - v) * (b - a) + v * (c - d);
        const Vector3d along_v = (1 - u) * (d - a) + u * (c - b);
        points.push_back({a + u * (b - a) + v * ((1 - u) * (d - a) + u * (c - b)),
                          rule.weight[s] * rule.weight[t] * along_u.cross(along_v).norm()});
      }
    }
  }
  return points;
}

Vector3d area_point(const Facet& facet, double s, double t) {
  const std::vector<Vector3d>& polygon = facet.vertices;
  if (facet.rectangle) {
    return polygon[0] + s * (polygon[1] - polygon[0]) + t * (polygon[3] - polygon[0]);
  }
  const auto twice_area = [&](std::size_t i) {
    return (polygon[i] - polygon[0]).cross(polygon[i + 1] - polygon[0]).norm();
  };
  double left = s * 2 * facet.area_m2;
  std::size_t i = 1;
  while (i + 2 < polygon.size() && left > twice_area(i)) left -= twice_area(i++);
  const double u =
      std::sqrt(std::min(1.0, left / twice_area(i)));  // share of the area below u is u^2
  return polygon[0] + u * ((1 - t) * (polygon[i] - polygon[0]) + t * (polygon[i + 1] - polygon[0]));
}

}  // namespace solver
