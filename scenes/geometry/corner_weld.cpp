#include "scenes/geometry/corner_weld.h"

#include <cmath>

namespace scenes {

CornerWeld::Cell CornerWeld::cell_of(const Eigen::Vector3d& p) const {
  const auto index = [this](double x) { return std::lround(x / (4 * tolerance_m_)); };
  return {index(p.x()), index(p.y()), index(p.z())};
}

int CornerWeld::number(const Eigen::Vector3d& p) {
  const Cell cell = cell_of(p);
  for (long k = 0; k < 27; ++k) {
    const auto found =
        cells_.find({cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1});
    if (found == cells_.end()) continue;
    for (const int i : found->second) {
      if ((at(i) - p).norm() <= tolerance_m_) return i;
    }
  }
  points_.push_back(p);
  cells_[cell].push_back(size() - 1);
  return size() - 1;
}

Outline CornerWeld::welded(const Outline& ring) {
  Outline kept;
  for (const Eigen::Vector3d& p : ring) {
    const Eigen::Vector3d& corner = at(number(p));
    if (kept.empty() || kept.back() != corner) kept.push_back(corner);
  }
  while (kept.size() > 1 && kept.front() == kept.back()) kept.pop_back();
  return kept;
}

}  // namespace scenes
