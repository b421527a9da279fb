#include "paints/piece_bound.h"

#include <algorithm>

namespace paints {
namespace {

constexpr int kDirections = 4;

}  // namespace

double piece_bound(std::span<const Eigen::Vector3d> corners,
                   std::span<const Eigen::Vector3d> deviations, double bulge) {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& corner : corners) x += corner;
  x /= static_cast<double>(corners.size());
  double best = 0;
  for (int i = 0; i < kDirections; ++i) {
    const double length = x.norm();
    if (length == 0) return 0;
    const Eigen::Vector3d* nearest = &corners[0];
    for (const Eigen::Vector3d& corner : corners) {
      if (corner.dot(x) < nearest->dot(x)) nearest = &corner;
    }
    double towards = 0;
    for (const Eigen::Vector3d& deviation : deviations) {
      towards = std::max(towards, -deviation.dot(x));
    }
    best = std::max(best, (nearest->dot(x) - kTowards * towards) / length - kAnyway * bulge);

    const Eigen::Vector3d along = *nearest - x;
    const double along2 = along.squaredNorm();
    if (along2 == 0) break;
    x += std::clamp(-x.dot(along) / along2, 0.0, 1.0) * along;
  }
  return best;
}

}  // namespace paints
