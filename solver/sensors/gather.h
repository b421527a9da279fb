#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "scenes/mesh/patch_mesh.h"
#include "solver/factors/point_factors.h"
#include "solver/factors/slope_moments.h"
#include "solver/obstacles/visibility.h"

namespace solver {

/// A linear reading of the patches' radiosities, sum_j w_j B_j.
struct GatherRow {
  Eigen::VectorXd weights;    ///< per row of ExchangeAreas; those of means sum to 1
  double norm = 0;            ///< sqrt(sum_j w_j^2 / A_j), 1/m: see BandReport::norm_error_bound
  double closure_defect = 0;  ///< how far from 1 the weights summed before
};

/// Weights scaled so that those of means, the first, one per area, sum to 1; none where all are 0.
[[nodiscard]] GatherRow closed_row(Eigen::VectorXd weights, const std::vector<double>& area_m2);

/// Gradient of B on patch j = sum_k a_k (B_k - B_j) over its neighbours k in the surface: weighted
/// least squares. Directions in which there is no neighbour have no gradient.
using GradientWeights = std::vector<std::pair<Eigen::Index, Eigen::Vector3d>>;

[[nodiscard]] GradientWeights gradient_weights(const scenes::PatchMesh& mesh,
                                               const std::vector<Facet>& facets, std::size_t j);

/// Reads irradiance at surface elements. Form factors of what they see of each patch are exact
/// [Lambert1760], shadows included; near patches also count the gradient of B, taken from their
/// neighbours in the surface, times the kernel's first moment. On an edge the light is the limit
/// from the air. Where light is linear on patches, its slopes are known, and count with the first
/// moments of all patches.
class PointGather {
 public:
  /// All must outlive this. @param slopes  null: light is constant on patches
  PointGather(const scenes::PatchMesh& mesh, const std::vector<Facet>& facets,
              const Visibility& visibility, const SlopeMoments* slopes = nullptr);

  [[nodiscard]] GatherRow row(const Eigen::Vector3d& at_m, const Eigen::Vector3d& normal) const;

 private:
  using Polygons = std::vector<std::vector<Eigen::Vector3d>>;

  struct Seen {
    Eigen::VectorXd factors;
    std::map<std::size_t, Polygons> in_part;  ///< of patches that something hides: what is left
  };

  [[nodiscard]] Seen seen_from(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;
  [[nodiscard]] Eigen::Vector3d first_moment(const Eigen::Vector3d& point,
                                             const Eigen::Vector3d& normal, std::size_t patch,
                                             const Seen& seen) const;
  [[nodiscard]] Eigen::VectorXd with_slopes(const Eigen::Vector3d& point,
                                            const Eigen::Vector3d& normal, const Seen& seen) const;
  [[nodiscard]] const GradientWeights& gradient(std::size_t patch) const;
  void add_gradients(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, const Seen& seen,
                     Eigen::VectorXd& weights) const;
  void add_gradient(std::size_t patch, const Eigen::Vector3d& moment,
                    Eigen::VectorXd& weights) const;

  const scenes::PatchMesh& mesh_;
  const std::vector<Facet>& facets_;
  const Visibility& visibility_;
  const SlopeMoments* slopes_;
  PointFactors patches_, parts_;         ///< whole, and cut up
  std::vector<std::size_t> first_part_;  ///< of each patch, and one past the last
  Eigen::Matrix3Xd part_middle_m_;
  mutable std::vector<GradientWeights> gradients_;  ///< of patches that were near a point
  mutable std::vector<std::once_flag> gradient_known_;
};

}  // namespace solver
