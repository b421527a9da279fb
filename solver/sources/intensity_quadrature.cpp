#include "solver/sources/intensity_quadrature.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace solver {
namespace {

using Eigen::Vector3d;
using Quad = std::array<Vector3d, 4>;

constexpr int kMostLevels = 16, kCoarse = 2, kFine = 3;

class Integral {
 public:
  Integral(const Facet& facet, const SlopeBasis* basis, const Vector3d& light_m,
           const Intensity& intensity, double tolerance)
      : facet_(facet),
        basis_(basis),
        light_m_(light_m),
        intensity_(intensity),
        tolerance_(tolerance),
        height_m_(facet.plane().height_m(light_m)) {}

  [[nodiscard]] Vector3d over(const Quad& quad, int level) const {
    const Vector3d centre = (quad[0] + quad[1] + quad[2] + quad[3]) / 4;
    double radius_m = 0;
    for (const Vector3d& corner : quad) radius_m = std::max(radius_m, (corner - centre).norm());
    const double distance_m = (centre - light_m_).norm();
    if (level < kMostLevels && 2 * radius_m > distance_m) return quartered(quad, level);
    const double angle_rad = std::asin(std::min(1.0, radius_m / distance_m));
    const bool may_hide = angle_rad > intensity_.finest_rad && level < kMostLevels;
    const double most = may_hide ? intensity_.most_within(centre - light_m_, angle_rad) : 0;
    if (may_hide && most == 0) return Vector3d::Zero();
    const Sum coarse = gauss_sum(quad, kCoarse), fine = gauss_sum(quad, kFine);
    const double error = (fine.flux - coarse.flux).cwiseAbs().maxCoeff();
    const double hidden =
        may_hide ? (most - 2 * fine.peak) * height_m_ / std::pow(distance_m, 3) : 0;
    if (level < kMostLevels && (error > tolerance_ * fine.area_m2 || hidden > tolerance_)) {
      return quartered(quad, level);
    }
    return fine.flux;
  }

 private:
  struct Sum {
    Vector3d flux = Vector3d::Zero();
    double area_m2 = 0, peak = 0;
  };

  [[nodiscard]] Sum gauss_sum(const Quad& q, int order) const {
    const GaussRule& rule = gauss(order);
    const auto points = static_cast<std::size_t>(order);
    Sum sum;
    for (std::size_t s = 0; s < points; ++s) {
      for (std::size_t t = 0; t < points; ++t) {
        const double u = rule.node[s], v = rule.node[t];
        const Vector3d along_u = (1 - v) * (q[1] - q[0]) + v * (q[2] - q[3]);
        const Vector3d along_v = (1 - u) * (q[3] - q[0]) + u * (q[2] - q[1]);
        const Vector3d point = q[0] + u * (q[1] - q[0]) + v * along_v;
        const double area_m2 =
            rule.weight[s] * rule.weight[t] * facet_.normal.dot(along_u.cross(along_v));
        const Vector3d ray = point - light_m_;
        const double square_m2 = ray.squaredNorm(), candela = intensity_.at(ray);
        const double flux = candela * height_m_ / (square_m2 * std::sqrt(square_m2)) * area_m2;
        sum.flux[0] += flux;
        if (basis_ != nullptr) sum.flux.tail<2>() += flux * basis_->at(point - facet_.centre);
        sum.area_m2 += area_m2;
        sum.peak = std::max(sum.peak, candela);
      }
    }
    return sum;
  }

  [[nodiscard]] Vector3d quartered(const Quad& q, int level) const {
    const Vector3d centre = (q[0] + q[1] + q[2] + q[3]) / 4;
    Vector3d sum = Vector3d::Zero();
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector3d &corner = q[k], &next = q[(k + 1) % 4], &before = q[(k + 3) % 4];
      sum += over({corner, (corner + next) / 2, centre, (corner + before) / 2}, level + 1);
    }
    return sum;
  }

  const Facet& facet_;
  const SlopeBasis* basis_;
  const Vector3d& light_m_;
  const Intensity& intensity_;
  double tolerance_, height_m_;
};

}  // namespace

Vector3d lit_flux(const std::vector<Vector3d>& part, const Facet& facet, const SlopeBasis* basis,
                  const Vector3d& light_m, const Intensity& intensity, double tolerance) {
  const Integral integral(facet, basis, light_m, intensity, tolerance);
  if (part.size() == 4) return integral.over({part[0], part[1], part[2], part[3]}, 0);
  Vector3d centre = Vector3d::Zero(), sum = Vector3d::Zero();
  for (const Vector3d& corner : part) centre += corner / static_cast<double>(part.size());
  for (std::size_t k = 0; k < part.size(); ++k) {
    const Vector3d &corner = part[k], &next = part[(k + 1) % part.size()],
                   &before = part[(k + part.size() - 1) % part.size()];
    sum += integral.over({corner, (corner + next) / 2, centre, (corner + before) / 2}, 0);
  }
  return sum;
}

}  // namespace solver
