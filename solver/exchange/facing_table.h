#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "scenes/mesh/patch_mesh.h"

namespace solver {

/// Which patches can face each other. For every plane of the mesh it holds how far each patch
/// reaches in front of it; where all patches of two planes are to each other alike, it looks no
/// further.
class FacingTable {
 public:
  enum class Pair : std::uint8_t { none, straddling, facing, mixed };

  explicit FacingTable(const scenes::PatchMesh& mesh);

  [[nodiscard]] Pair relation(std::size_t i, std::size_t j) const {
    const Pair pair = of_planes_[plane_of_[i] * planes_ + plane_of_[j]];
    return pair != Pair::mixed ? pair
                               : relation(heights_[plane_of_[i] * patches_ + j],
                                          heights_[plane_of_[j] * patches_ + i]);
  }

 private:
  struct Range {
    double lowest_m = 1e300, highest_m = -1e300;

    void extend(double height_m) {
      lowest_m = std::min(lowest_m, height_m);
      highest_m = std::max(highest_m, height_m);
    }
  };

  static Pair relation(const Range& j_over_i, const Range& i_over_j) {
    constexpr double kOnPlane_m = 1e-12;
    if (std::min(j_over_i.highest_m, i_over_j.highest_m) <= kOnPlane_m) return Pair::none;
    return std::min(j_over_i.lowest_m, i_over_j.lowest_m) >= -kOnPlane_m ? Pair::facing
                                                                         : Pair::straddling;
  }

  std::size_t patches_, planes_ = 0;
  std::vector<std::size_t> plane_of_;
  std::vector<Range> heights_;   ///< [plane][patch]
  std::vector<Pair> of_planes_;  ///< [plane][plane]
};

}  // namespace solver
