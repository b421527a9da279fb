#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "solver/obstacles/blocker.h"

namespace solver {

/// A point a row, m, relative to Segments::local's origin.
using Points16 = Eigen::Array<float, 16, 3>;

/// Planes of a blocker as the kernel takes them, relative to the same origin: outside is in front.
struct FloatPlane {
  float x, y, z, offset_m;
};

/// Segments against convex blockers, 16 at once, in float.
class Segments {
 public:
  Segments() = default;
  explicit Segments(const std::vector<Blocker>& blockers);

  /// Floats count from the middle of all blockers, wherever they lie.
  [[nodiscard]] Eigen::Vector3f local(const Eigen::Vector3d& p) const {
    return (p - middle_m_).cast<float>();
  }

  /// Bit k is set if segment k passes through the blocker. Segments that touch its surface, to
  /// rounding, pass; so do those that only start or end on it.
  [[nodiscard]] std::uint32_t blocked(std::size_t blocker, const Points16& from,
                                      const Points16& to) const;

 private:
  struct Body {
    std::vector<FloatPlane> planes;
    bool plate = false;  ///< the first plane is the plate's, the others stand on its edges
  };

  Eigen::Vector3d middle_m_ = Eigen::Vector3d::Zero();
  std::vector<Body> bodies_;
};

}  // namespace solver
