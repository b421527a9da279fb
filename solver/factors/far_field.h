#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "solver/factors/facet.h"
#include "solver/factors/slope_basis.h"

namespace solver {

/// Patches that are taken at once; a multiple of every vector length.
inline constexpr int kFarPatches = 64;

/// One patch i against kFarPatches patches j, seen from centre to centre.
struct FarRow {
  using Floats = std::array<float, kFarPatches>;
  using Doubles = std::array<double, kFarPatches>;

  std::size_t i = 0, first = 0;      ///< patch i, and the first patch j
  Doubles distance_over_size;        ///< of the larger patch
  Doubles area_factor_m2;            ///< A_i A_j / (pi r^2)
  Doubles cosines;                   ///< cos_i cos_j at the centres
  Floats inverse_m;                  ///< 1 / r
  Floats twice_x, twice_y, twice_z;  ///< 2 (centre of j - centre of i) / r^2, 1/m
  Floats cos_i, cos_j;
};

/// Points of quadrilaterals and triangles for rules that are exact to degree 3, 5 and 7, laid out
/// so that one vector holds the same point of neighbouring patches. The kernel between the centres
/// is taken in double; how it differs at the points, which is small where patches are far, in
/// float. So a far pair keeps rounding to float, 6e-8.
class FarField {
 public:
  static constexpr std::size_t kMostPoints = 16;  ///< of a patch

  /// @param bases  of the facets; empty: no moments are asked for
  explicit FarField(const std::vector<Facet>& facets, const std::vector<SlopeBasis>& bases = {});

  /// Five and more corners have no product rule here.
  [[nodiscard]] bool has_rule(std::size_t patch) const { return has_rule_[patch]; }

  /// Patch i against the patches first..first+63.
  void start(std::size_t i, std::size_t first, FarRow& row) const;

  /// A_i F_ij, m^2, by the rules of `order`, where that is not 0; other entries are left alone.
  void exchange(const FarRow& row, const std::array<int, kFarPatches>& order,
                float* exchange_area_m2) const;

  /// <psi_a, K psi_b>, m^2, a on patch i and b on patch j, at [3 a + b], by the same rules; with
  /// [0] for what the rule makes of A_i F_ij.
  using Moments = std::array<FarRow::Floats, 9>;
  void moments(const FarRow& row, const std::array<int, kFarPatches>& order,
               Moments& moments_m2) const;

 private:
  struct Rule {
    std::vector<std::size_t> points;  ///< per patch
    std::vector<float> x, y, z;  ///< offsets from the centre, point-major: [point][padded patch]
    std::vector<float> weight;   ///< share of the area; 0 beyond a patch's last point
    std::array<std::vector<float>, 2> slope;  ///< psi_1, psi_2 at the points
  };

  template <typename Visit>
  void for_each_vector(const FarRow& row, const std::array<int, kFarPatches>& order,
                       const Visit& visit) const;
  void add_points(const Facet& facet, const SlopeBasis* basis, std::size_t patch);

  std::size_t padded_ = 0;
  std::array<Rule, 5> rules_;  ///< by the order of exchange(): 2, 3, 4
  std::vector<float> normal_x_, normal_y_, normal_z_;
  std::array<std::vector<double>, 3> centre_m_, normal_;
  std::vector<double> area_m2_, size_m_;
  std::vector<bool> has_rule_;
};

}  // namespace solver
