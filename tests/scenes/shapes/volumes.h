#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "scenes/room.h"

namespace scenes {

/// Volume that faces enclose, by the tetrahedra that they span with the origin; positive if their
/// outlines run counter-clockwise seen from outside.
inline double volume_within(const std::vector<Outline>& faces) {
  double sum = 0;
  for (const Outline& face : faces) {
    for (std::size_t k = 2; k < face.size(); ++k) sum += face[0].dot(face[k - 1].cross(face[k]));
  }
  return sum / 6;
}

inline double volume_within(const ConvexPart& part) {
  std::vector<Outline> faces;
  for (const std::vector<int>& corners : part.faces) {
    Outline& face = faces.emplace_back();
    for (const int c : corners) face.push_back(part.corners[static_cast<std::size_t>(c)]);
  }
  return volume_within(faces);
}

inline std::vector<Outline> outlines_of(const std::vector<ShellFace>& shell) {
  std::vector<Outline> faces;
  for (const ShellFace& face : shell) faces.push_back(face.outline);
  return faces;
}

/// Of faces without holes that are seen from inside.
inline double volume_within(const std::vector<ShellFace>& shell) {
  return -volume_within(outlines_of(shell));
}

/// Sum of the vector areas; 0 where faces close.
inline Eigen::Vector3d gap_m2(const std::vector<Outline>& faces) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Outline& face : faces) sum += vector_area_m2(face);
  return sum;
}

inline Eigen::Vector3d gap_m2(const std::vector<ShellFace>& shell) {
  return gap_m2(outlines_of(shell));
}

}  // namespace scenes
