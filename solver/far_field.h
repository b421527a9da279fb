#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "solver/facet.h"

namespace solver {

/// Patches of one tile row or column; a multiple of every vector length.
inline constexpr int kTile = 64;

/// One patch i against one vector of patches j, as the kernel reads them.
struct FarPairs {
  int points;                      ///< of the product rule, on either side
  std::size_t stride;              ///< between the arrays of two points
  const float *xi, *yi, *zi, *wi;  ///< offsets of patch i
  const float *xj, *yj, *zj, *wj;  ///< offsets of the first patch j
  std::array<float, 3> ni;         ///< normal of i
  const float *njx, *njy, *njz;    ///< normals of j
  const float *rx, *ry, *rz;       ///< centre of j minus centre of i
  float* out;
};

/// Gauss points of quadrilaterals and triangles for product rules of 2, 3 and 4 points an edge,
/// laid out so that one vector holds the same point of neighbouring patches. Offsets from the
/// patch's centre, in float: a far pair keeps 2e-7.
class FarField {
 public:
  explicit FarField(const std::vector<Facet>& facets);

  /// Five and more corners have no product rule here.
  [[nodiscard]] bool has_rule(std::size_t patch) const { return has_rule_[patch]; }

  /// A_i F_ij of patch i with the patches first..first+63 whose order is not 0; other entries are
  /// left alone.
  void exchange(std::size_t i, std::size_t first, const std::array<int, kTile>& order,
                std::array<float, kTile>& exchange_area_m2) const;

 private:
  struct Rule {
    int points = 0;
    std::vector<float> x, y, z, weight;  ///< point-major: [point][padded patch]
  };

  std::size_t padded_ = 0;
  std::array<Rule, 5> rules_;  ///< by points per edge: 2, 3, 4
  std::vector<float> normal_x_, normal_y_, normal_z_;
  std::vector<double> centre_x_, centre_y_, centre_z_;
  std::vector<bool> has_rule_;
};

}  // namespace solver
