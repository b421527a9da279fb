#include "scenes/geometry/outline.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace scenes {

Eigen::Vector3d vector_area_m2(const Outline& outline) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector3d edge = outline[(i + 1) % outline.size()] - outline[i];
    sum += (outline[i] - outline[0]).cross(edge) / 2;
  }
  return sum;
}

PlaneCoordinates::PlaneCoordinates(const Outline& outline) {
  Eigen::Vector3d longest = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector3d edge = outline[(i + 1) % outline.size()] - outline[i];
    if (edge.norm() > longest.norm()) longest = edge;
  }
  // stableNormalized is exact along an axis, so axis-aligned rooms keep their exact coordinates.
  normal_ = vector_area_m2(outline).stableNormalized();
  along_ = longest.stableNormalized();
  up_ = normal_.cross(along_);
  offset_m_ = normal_.dot(outline[0]);
}

bool PlaneCoordinates::same_plane(const PlaneCoordinates& other, int facing) const {
  return (normal_ - facing * other.normal_).norm() <= kCoplanar_m &&
         std::abs(offset_m_ - facing * other.offset_m_) <= kCoplanar_m;
}

Polygon PlaneCoordinates::flatten(const Outline& outline) const {
  Polygon flat;
  for (const Eigen::Vector3d& p : outline) flat.push_back(flatten(p));
  if (area(flat) < 0) std::ranges::reverse(flat);
  return flat;
}

}  // namespace scenes
