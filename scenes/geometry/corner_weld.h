#pragma once
#include <Eigen/Core>
#include <array>
#include <map>
#include <vector>

#include "scenes/geometry/outline.h"

namespace scenes {

/// Numbers places; those within a tolerance of an earlier one get its number.
class CornerWeld {
 public:
  explicit CornerWeld(double tolerance_m) : tolerance_m_(tolerance_m) {}

  int number(const Eigen::Vector3d& p);

  [[nodiscard]] const Eigen::Vector3d& at(int i) const {
    return points_[static_cast<std::size_t>(i)];
  }

  [[nodiscard]] int size() const { return static_cast<int>(points_.size()); }

  /// A ring of welded corners, those that became one left out.
  [[nodiscard]] Outline welded(const Outline& ring);

 private:
  using Cell = std::array<long, 3>;

  [[nodiscard]] Cell cell_of(const Eigen::Vector3d& p) const;

  double tolerance_m_;
  std::vector<Eigen::Vector3d> points_;
  std::map<Cell, std::vector<int>> cells_;  ///< four tolerances wide
};

}  // namespace scenes
