#pragma once
#include <vector>

#include "scenes/mesh/patch_mesh.h"
#include "solver/bounce/radiosity.h"
#include "solver/factors/facet.h"

namespace solver {

/// What solved patches reflect, linear over each patch about its centroid, so that the patch's mean
/// stays what was solved. Slopes are least squares over the neighbours in the surface, made less
/// steep where light would fall below 0 in a corner. In float, padded for vector units.
class ReflectedField {
 public:
  /// @param reflected  B - S, row of ExchangeAreas x band
  ReflectedField(const scenes::PatchMesh& mesh, const Bands& reflected);

  [[nodiscard]] int padded_bands() const { return padded_; }

  /// sum += field at a point of a patch; `sum` holds padded_bands() values
  void add(int patch, const Eigen::Vector3d& point_m, float* sum) const {
    const Frame& frame = frames_[static_cast<std::size_t>(patch)];
    const Eigen::Vector3d r = point_m - frame.centre_m;
    const auto u = static_cast<float>(frame.along.dot(r));
    const auto v = static_cast<float>(frame.across.dot(r));
    const auto n = static_cast<std::size_t>(padded_);
    const float* value = values_.data() + static_cast<std::size_t>(patch) * 3 * n;
    for (std::size_t k = 0; k < n; ++k)
      sum[k] += value[k] + u * value[n + k] + v * value[2 * n + k];
  }

 private:
  struct Frame {
    Eigen::Vector3d centre_m, along, across;
  };

  void set_slopes(const scenes::PatchMesh& mesh, const std::vector<Facet>& facets,
                  const Bands& reflected, std::size_t patch);

  int padded_ = 0;
  std::vector<Frame> frames_;
  std::vector<float> values_;  ///< [patch][value, slope along, slope across][band]
};

}  // namespace solver
