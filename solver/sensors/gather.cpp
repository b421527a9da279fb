#include "solver/sensors/gather.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/factors/pair_factor.h"

namespace solver {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using Polygon = std::vector<Vector3d>;

/// A common vertex: nothing can stand between them.
bool touch(const Facet& a, const Facet& b) {
  return std::ranges::any_of(a.vertices, [&](const Vector3d& p) {
    return std::ranges::any_of(b.vertices,
                               [&](const Vector3d& q) { return (p - q).norm() < 1e-9; });
  });
}

/// A point on an edge lies in the plane of a surface that fills up to half of its sky, yet sees it
/// edge-on. It is moved into the air, where the light has its limit.
Vector3d off_the_edge(const Vector3d& point, const Vector3d& normal,
                      const scenes::PatchMesh& mesh) {
  constexpr double kOnPlane_m = 1e-9, kStep_m = 1e-7;
  std::vector<Vector3d> touched;
  for (std::size_t j = 0; j < mesh.polygon.size(); ++j) {
    const Vector3d& other = mesh.normal[j];
    if (std::abs(other.dot(point - mesh.centre[j])) > kOnPlane_m) continue;
    const bool known = std::ranges::any_of(
        touched, [&](const Vector3d& t) { return (t - other).norm() < kOnPlane_m; });
    const bool rises = std::ranges::any_of(
        mesh.polygon[j], [&](const Vector3d& v) { return normal.dot(v - point) > kOnPlane_m; });
    if (known || !rises) continue;
    if (contains(mesh.polygon[j], other, point)) touched.push_back(other);
  }
  Vector3d moved = point;
  for (const Vector3d& n : touched) moved += kStep_m * n;
  return moved - std::min(0.0, normal.dot(moved - point)) * normal;  // not behind its own surface
}

/// psi_1, psi_2 over what four Gauss points see of a patch in full view, whose kernel hardly bends.
Eigen::Vector2d far_slopes(const Vector3d& point, const Vector3d& normal, const Facet& facet,
                           const SlopeBasis& basis) {
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (const QuadraturePoint& q : quadrature(facet.vertices, 2)) {
    const Vector3d r = q.position - point;
    const double r2 = r.squaredNorm();
    const double kernel = std::max(0.0, normal.dot(r)) * -facet.normal.dot(r) / (r2 * r2);
    moment += q.weight_m2 * kernel / std::numbers::pi * basis.at(q.position - facet.centre);
  }
  return moment;
}

}  // namespace

GatherRow closed_row(VectorXd weights, const std::vector<double>& area_m2) {
  const Eigen::Map<const Eigen::ArrayXd> area(area_m2.data(),
                                              static_cast<Eigen::Index>(area_m2.size()));
  const double sum = weights.head(area.size()).sum();
  if (sum > 0) weights /= sum;
  const Eigen::ArrayXd areas = area.replicate(weights.size() / area.size(), 1);
  const double norm = std::sqrt((weights.array().square() / areas).sum());
  return {.weights = std::move(weights), .norm = norm, .closure_defect = std::abs(sum - 1)};
}

GradientWeights gradient_weights(const scenes::PatchMesh& mesh, const std::vector<Facet>& facets,
                                 std::size_t j) {
  constexpr double kReach = 1.6;  // in patch sizes: the eight neighbours of a square
  GradientWeights neighbours;
  Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero();
  std::size_t first = j, end = j + 1;  // patches of a surface are contiguous
  while (first > 0 && mesh.surface[first - 1] == mesh.surface[j]) --first;
  while (end < facets.size() && mesh.surface[end] == mesh.surface[j]) ++end;
  for (std::size_t k = first; k < end; ++k) {
    if (k == j || mesh.plane[k] != mesh.plane[j]) continue;
    const Vector3d r = mesh.centre[k] - mesh.centre[j];
    const double r2 = r.squaredNorm();
    const double reach = kReach * std::max(facets[j].size_m, facets[k].size_m);
    if (r2 > reach * reach || !touch(facets[j], facets[k])) continue;
    neighbours.emplace_back(static_cast<Eigen::Index>(k), r / r2);
    normal_matrix += r * r.transpose() / r2;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(normal_matrix);
  const Eigen::Array3d values = eigen.eigenvalues().array();
  const Eigen::Array3d inverse = (values > 0.1).select(values.inverse(), 0.0);
  const Eigen::Matrix3d pseudo_inverse =
      eigen.eigenvectors() * inverse.matrix().asDiagonal() * eigen.eigenvectors().transpose();
  for (auto& [k, a] : neighbours) a = pseudo_inverse * a;
  return neighbours;
}

PointGather::PointGather(const scenes::PatchMesh& mesh, const std::vector<Facet>& facets,
                         const Visibility& visibility, const SlopeMoments* slopes)
    : mesh_(mesh),
      facets_(facets),
      visibility_(visibility),
      slopes_(slopes),
      gradients_(facets.size()),
      gradient_known_(facets.size()) {
  std::vector<Vector3d> middles;
  for (const Facet& f : facets) {
    patches_.add(f.vertices);
    if (slopes != nullptr) continue;  // has the parts
    first_part_.push_back(parts_.size());
    for (const Polygon& part : parts_of(f.vertices)) {
      parts_.add(part);
      middles.push_back(middle_of(part));
    }
  }
  first_part_.push_back(parts_.size());
  part_middle_m_ = Eigen::Map<Eigen::Matrix3Xd>(middles.data()->data(), 3,
                                                static_cast<Eigen::Index>(middles.size()));
}

PointGather::Seen PointGather::seen_from(const Vector3d& point, const Vector3d& normal) const {
  Seen seen{.factors = patches_.from(point, normal)};
  const SeparationMask mask = visibility_.separation(point, normal);
  const Shadows shadows(visibility_.blockers(), from_point(point));
  for (std::size_t j = 0; j < facets_.size(); ++j) {
    double& factor = seen.factors[static_cast<Eigen::Index>(j)];
    if (factor <= 0 || facets_[j].plane().height_m(point) <= 1e-12) {
      factor = 0;  // on its plane or behind it
    } else if (visibility_.may_block(mask, static_cast<int>(j))) {
      std::vector<Polygon> lit = shadows.lit_parts(facets_[j].vertices);
      if (lit.size() == 1 && lit[0] == facets_[j].vertices) continue;
      factor = 0;
      for (const Polygon& part : lit) factor += point_to_polygon(point, normal, part);
      seen.in_part.emplace(j, std::move(lit));
    }
  }
  return seen;
}

/// sum over what is seen of a patch of F(part) (middle of part - centre), m
Vector3d PointGather::first_moment(const Vector3d& point, const Vector3d& normal, std::size_t patch,
                                   const Seen& seen) const {
  const Vector3d& centre = facets_[patch].centre;
  const auto in_part = seen.in_part.find(patch);
  if (in_part == seen.in_part.end()) {
    const std::size_t first = first_part_[patch], end = first_part_[patch + 1];
    const VectorXd factors = parts_.from(point, normal, first, end);
    const auto middles =
        part_middle_m_.middleCols(static_cast<Eigen::Index>(first), factors.size());
    return (middles.colwise() - centre) * factors;
  }
  Vector3d moment = Vector3d::Zero();
  for (const Polygon& lit : in_part->second) {
    for (const Polygon& part : parts_of(lit)) {
      moment += point_to_polygon(point, normal, part) * (middle_of(part) - centre);
    }
  }
  return moment;
}

const GradientWeights& PointGather::gradient(std::size_t patch) const {
  std::call_once(gradient_known_[patch],
                 [&] { gradients_[patch] = gradient_weights(mesh_, facets_, patch); });
  return gradients_[patch];
}

void PointGather::add_gradients(const Vector3d& point, const Vector3d& normal, const Seen& seen,
                                VectorXd& weights) const {
  constexpr double kNear = 4;  // in patch sizes; farther off the middle of a patch will do
  for (std::size_t j = 0; j < facets_.size(); ++j) {
    const bool near = (facets_[j].centre - point).norm() < kNear * facets_[j].size_m;
    if (!near || seen.factors[static_cast<Eigen::Index>(j)] <= 0) continue;
    add_gradient(j, first_moment(point, normal, j, seen), weights);
  }
}

void PointGather::add_gradient(std::size_t patch, const Vector3d& moment, VectorXd& weights) const {
  const auto at = static_cast<Eigen::Index>(patch);
  const GradientWeights& neighbours = gradient(patch);
  double part = 1, own = 0;  // no weight may fall below 0: light is never negative
  for (const auto& [k, a] : neighbours) {
    const double change = moment.dot(a);
    if (change < 0) part = std::min(part, std::max(0.0, weights[k]) / -change);
    own += change;
  }
  if (own > 0) part = std::min(part, std::max(0.0, weights[at]) / own);
  for (const auto& [k, a] : neighbours) weights[k] += part * moment.dot(a);
  weights[at] -= part * own;
}

VectorXd PointGather::with_slopes(const Vector3d& point, const Vector3d& normal,
                                  const Seen& seen) const {
  constexpr double kNear = 4;  // in patch sizes
  const auto n = static_cast<Eigen::Index>(facets_.size());
  VectorXd weights = VectorXd::Zero(SlopeBasis::kModes * n);
  weights.head(n) = seen.factors;
  for (Eigen::Index j = 0; j < n; ++j) {
    if (seen.factors[j] <= 0) continue;
    const auto patch = static_cast<std::size_t>(j);
    const Facet& facet = facets_[patch];
    const SlopeBasis& basis = slopes_->bases()[patch];
    Eigen::Vector2d moment = Eigen::Vector2d::Zero();
    if (const auto in_part = seen.in_part.find(patch); in_part != seen.in_part.end()) {
      for (const Polygon& lit : in_part->second) {
        for (const Polygon& part : parts_of(lit)) {
          moment +=
              point_to_polygon(point, normal, part) * basis.at(middle_of(part) - facet.centre);
        }
      }
    } else if ((facet.centre - point).norm() < kNear * facet.size_m) {
      moment = slopes_->from_point(point, normal, patch).tail<2>();
    } else {
      moment = far_slopes(point, normal, facet, basis);
    }
    weights[n + j] = moment[0];
    weights[2 * n + j] = moment[1];
  }
  return weights;
}

GatherRow PointGather::row(const Vector3d& at_m, const Vector3d& normal) const {
  const Vector3d point = off_the_edge(at_m, normal, mesh_);
  const Seen seen = seen_from(point, normal);
  if (slopes_ != nullptr) return closed_row(with_slopes(point, normal, seen), mesh_.area_m2);
  VectorXd weights = seen.factors;
  add_gradients(point, normal, seen, weights);
  return closed_row(std::move(weights), mesh_.area_m2);
}

}  // namespace solver
