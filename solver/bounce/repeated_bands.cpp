#include "solver/bounce/repeated_bands.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace solver {
namespace {

using Eigen::Index;

/// b = factor a, up to the rounding of one product.
bool proportional(const Bands& light, Index b, Index a, double factor) {
  constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
  return ((light.col(b) - factor * light.col(a)).abs() <= kRounding * light.col(b).abs()).all();
}

}  // namespace

std::vector<RepeatedBand> take_repeated_bands(const Bands& light, const Bands& reflectance,
                                              std::vector<Index>& lit) {
  std::vector<RepeatedBand> repeats;
  std::vector<Index> kept;
  for (const Index b : lit) {
    const auto factor = [&](Index a) { return light.col(b).sum() / light.col(a).sum(); };
    const auto same = std::ranges::find_if(kept, [&](Index a) {
      return std::isfinite(factor(a)) && (reflectance.col(a) == reflectance.col(b)).all() &&
             proportional(light, b, a, factor(a));
    });
    if (same == kept.end()) {
      kept.push_back(b);
    } else {
      repeats.push_back({b, *same, factor(*same)});
    }
  }
  lit = std::move(kept);
  return repeats;
}

}  // namespace solver
