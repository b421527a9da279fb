#pragma once
#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "scenes/room.h"

namespace scenes {

/// A plane polygon, perhaps with holes, that places are measured against.
class FlatFace {
 public:
  explicit FlatFace(const Outline& outline, const std::vector<Outline>& holes = {});

  [[nodiscard]] const PlaneCoordinates& plane() const { return plane_; }

  /// From the nearest of its points, not negative.
  [[nodiscard]] double distance_m(const Eigen::Vector3d& point) const;

  /// Solid angle over 4 pi, positive seen from the front [VanOosterom1983].
  [[nodiscard]] double turns_around(const Eigen::Vector3d& point) const;

 private:
  std::vector<Outline> rings_;  ///< the outline, then the holes
  PlaneCoordinates plane_;
  std::vector<Polygon> flat_;
};

/// The space that faces enclose, and what fits into it.
class Enclosure {
 public:
  Enclosure() = default;
  explicit Enclosure(const std::vector<ShellFace>& shell);

  /// Distance to the nearest face; negative outside.
  [[nodiscard]] double clearance_m(const Eigen::Vector3d& point) const;

  /// The face of the shell that a body reaches through; -1: none. It may touch them.
  [[nodiscard]] int reached_through(const Body& body) const;

 private:
  std::vector<FlatFace> faces_;
  std::vector<std::vector<ConvexPart>> plates_;  ///< of each face
};

/// Pairs of faces that share more than a boundary, to kWeld_m.
/// @param thin_walls  those that lie back to back do not count
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> crossing_faces(
    const std::vector<ShellFace>& shell, bool thin_walls = true);

/// Outside, a lower bound of the distance to the body; negative within. Of a sheet the distance.
[[nodiscard]] double distance_m(const Body& body, const Eigen::Vector3d& point);

/// The mean of its corners.
[[nodiscard]] Eigen::Vector3d middle_of(const ConvexPart& part);

/// Two bodies share more than a boundary; two sheets also where they lie on each other.
[[nodiscard]] bool overlap(const Body& a, const Body& b);

}  // namespace scenes
