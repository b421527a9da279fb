#pragma once
#include <Eigen/Core>
#include <utility>
#include <vector>

#include "scenes/patch_mesh.h"
#include "scenes/room.h"
#include "solver/visibility.h"

namespace solver {

/// A linear reading of the patches' radiosities, sum_j w_j B_j.
struct GatherRow {
  Eigen::VectorXd weights;         ///< per patch; sum to 1
  Eigen::VectorXd standard_error;  ///< of the weights, from sampled visibility
  double norm = 0;  ///< sqrt(sum_j w_j^2 / A_j), 1/m: see BandReport::norm_error_bound
};

struct GatherOptions {
  std::vector<bool> lamp;    ///< patches whose visible share is sampled until `lamp_error`
  double lamp_error = 1e-3;  ///< standard error of a lamp patch's visible share
  int most_lamp_rays = 4096;
  int rays = 64;  ///< for other patches that something may hide
};

/// Irradiance at a surface element. Form factors from the point are exact [Lambert1760], visible
/// shares come from rays; near patches also count the gradient of B, taken from their neighbours in
/// the surface, times the kernel's first moment. What sampling leaves open is spread over the
/// weights by their variances, so that they sum to 1 as in a closed room. On an edge the light is
/// the limit from the air.
[[nodiscard]] GatherRow gather_at_point(const Eigen::Vector3d& at_m, const Eigen::Vector3d& normal,
                                        const scenes::PatchMesh& mesh,
                                        const std::vector<Facet>& facets,
                                        const Visibility& visibility, const GatherOptions& options);

/// Gradient of B on patch j = sum_k a_k (B_k - B_j) over its neighbours k in the surface: weighted
/// least squares. Directions in which there is no neighbour have no gradient.
using GradientWeights = std::vector<std::pair<Eigen::Index, Eigen::Vector3d>>;

[[nodiscard]] GradientWeights gradient_weights(const scenes::PatchMesh& mesh,
                                               const std::vector<Facet>& facets, std::size_t j);

/// What an eye takes in, as solid-angle means of radiosity [Neumann2004] 2.4.
struct ViewRows {
  GatherRow background;  ///< from 1 to 11 degrees off the axis
  GatherRow field;       ///< from 11 to 90 degrees
  GatherRow near_axis;   ///< 0 to 90 degrees, weighted by the cosine with the axis
};

/// By low-discrepancy rays of equal solid angle, kBackgroundRays and kFieldRays of them.
inline constexpr int kBackgroundRays = 4096;
inline constexpr int kFieldRays = 16384;

[[nodiscard]] ViewRows view_rows(const Eigen::Vector3d& eye_m, const Eigen::Vector3d& look_at_m,
                                 const scenes::PatchMesh& mesh);

/// The point that is looked at, from where, and the surface it lies on.
struct ViewedPoint {
  Eigen::Vector3d eye_m, point_m, normal;
  int surface = 0;
};

/// Of one group of painted surfaces: with a view (of the group, or of the room for the first),
/// where the ray from the eye meets the room. Else the free centre of the longest painted wall (if
/// no wall is painted, of the largest painted surface; if nothing is, of the longest wall), from 2
/// m away on its normal or half the room. Whatever the mesh of the solve.
/// @throws std::invalid_argument  if no such point is free
[[nodiscard]] ViewedPoint viewed_point(const scenes::Room& room, std::size_t group = 0);

}  // namespace solver
