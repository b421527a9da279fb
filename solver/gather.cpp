#include "solver/gather.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "solver/pair_factor.h"
#include "solver/patch_rays.h"

namespace solver {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kDegree = std::numbers::pi / 180;

double row_norm(const VectorXd& weights, const std::vector<double>& area_m2) {
  const Eigen::Map<const Eigen::ArrayXd> area(area_m2.data(), weights.size());
  return std::sqrt((weights.array().square() / area).sum());
}

/// Follows `rays` directions between two cones around the axis, and calls add(patch, cosine, solid
/// angle / 2 pi) for each; plastic-number sequence in (cosine, azimuth), so each ray stands for the
/// same solid angle.
template <typename Function>
void add_directions(const PatchRays& patch_rays, const Vector3d& eye, const Vector3d& axis,
                    double inner_deg, double outer_deg, int rays, Function add) {
  const Vector3d u = axis.unitOrthogonal(), v = axis.cross(u);
  const double inner = std::cos(inner_deg * kDegree), outer = std::cos(outer_deg * kDegree);
  const auto fraction = [](double x) { return x - std::floor(x); };
  for (int k = 0; k < rays; ++k) {
    const double s = fraction(0.5 + k * 0.75487766624669276);
    const double t = fraction(0.5 + k * 0.56984029099805327);
    const double cosine = outer + s * (inner - outer), sine = std::sqrt(1 - cosine * cosine);
    const double azimuth = 2 * std::numbers::pi * t;
    const Vector3d direction =
        cosine * axis + sine * (std::cos(azimuth) * u + std::sin(azimuth) * v);
    const RayHit hit = patch_rays.first_hit(eye, direction);
    if (hit.patch >= 0) add(hit.patch, cosine, (inner - outer) / rays);
  }
}

GatherRow normalised(VectorXd sum, const std::vector<double>& area_m2) {
  if (!(sum.sum() > 0)) throw std::invalid_argument("the eye sees no surface; is it in the room?");
  sum /= sum.sum();
  const double norm = row_norm(sum, area_m2);
  return {.weights = std::move(sum), .standard_error = VectorXd::Zero(sum.size()), .norm = norm};
}

bool inside(const std::vector<Vector3d>& polygon, const Vector3d& normal, const Vector3d& p) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d& a = polygon[i];
    const Vector3d& b = polygon[(i + 1) % polygon.size()];
    if (normal.dot((b - a).cross(p - a)) < -1e-9 * (b - a).norm()) return false;
  }
  return true;
}

/// The surface to look at when the file names no view, and the middle of it.
std::pair<int, Vector3d> default_target(const scenes::Room& room, std::size_t group,
                                        const scenes::PatchMesh& mesh) {
  const auto extent = [&](int s) {  // walls rank by length, which beats any other surface's area
    double area = 0;
    for (std::size_t p = 0; p < mesh.area_m2.size(); ++p) {
      if (mesh.surface[p] == s) area += mesh.area_m2[p];
    }
    const scenes::Surface& surface = room.surfaces[static_cast<std::size_t>(s)];
    if (area == 0 || surface.kind != scenes::SurfaceKind::wall) return area;
    const auto i = static_cast<std::size_t>(surface.index);
    return 1e6 + (room.plan_m[(i + 1) % room.plan_m.size()] - room.plan_m[i]).norm();
  };
  std::vector<int> candidates;
  if (!room.paint.empty()) {
    candidates = room.paint[group].surfaces;
  } else {
    for (int s = 0; s < static_cast<int>(room.surfaces.size()); ++s) {
      if (room.surfaces[static_cast<std::size_t>(s)].kind == scenes::SurfaceKind::wall)
        candidates.push_back(s);
    }
  }
  const int surface = *std::max_element(candidates.begin(), candidates.end(),
                                        [&](int a, int b) { return extent(a) < extent(b); });
  Eigen::AlignedBox3d box;
  for (int p = 0; p < mesh.size(); ++p) {
    const auto i = static_cast<std::size_t>(p);
    if (mesh.surface[i] != surface) continue;
    for (const Vector3d& vertex : mesh.polygon[i]) box.extend(vertex);
  }
  return {surface, box.center()};
}

/// The point of the surface's patches that is nearest to `middle`: itself where it is free, else a
/// patch's centre.
std::optional<ViewedPoint> free_point(const scenes::PatchMesh& mesh, int surface,
                                      const Vector3d& middle) {
  std::optional<ViewedPoint> best;
  double nearest = 1e300;
  for (std::size_t i = 0; i < mesh.polygon.size(); ++i) {
    if (mesh.surface[i] != surface) continue;
    const bool has_middle = std::abs(mesh.normal[i].dot(middle - mesh.centre[i])) < 1e-9 &&
                            inside(mesh.polygon[i], mesh.normal[i], middle);
    const double distance = has_middle ? 0 : (mesh.centre[i] - middle).norm();
    if (distance >= nearest) continue;
    nearest = distance;
    const Vector3d point_m = has_middle ? middle : mesh.centre[i];
    best = {.eye_m = point_m,  // until it is known how far away there is air
            .point_m = point_m,
            .normal = mesh.normal[i],
            .surface = surface};
  }
  return best;
}

/// The weights nearest to those sampled, in units of their variances, that sum to 1.
void close_row(GatherRow& row) {
  constexpr double kRounding = 1e-9;  // lets exact weights take what no variance explains
  const Eigen::ArrayXd variance =
      row.standard_error.array().square() + (kRounding * row.weights.array()).square();
  if (!(variance.sum() > 0)) return;
  const double open = 1 - row.weights.sum();
  row.weights = (row.weights.array() + open / variance.sum() * variance).max(0).matrix();
  row.weights /= row.weights.sum();
}

/// sum over parts of the facet of F(part) (centre of part - centre), scaled to the weight, m
Vector3d first_moment(const Vector3d& point, const Vector3d& normal, const Facet& facet,
                      double weight) {
  constexpr int kParts = 4;  // along an edge
  Vector3d moment = Vector3d::Zero();
  double sum = 0;
  const std::vector<Vector3d>& v = facet.vertices;
  for (std::size_t i = 1; i + 1 < v.size(); i += 2) {
    const Vector3d &a = v[0], &b = v[i], &c = v[i + 1], &d = i + 2 < v.size() ? v[i + 2] : a;
    const auto at = [&](int s, int t) -> Vector3d {
      const double u = static_cast<double>(s) / kParts, w = static_cast<double>(t) / kParts;
      return (1 - w) * ((1 - u) * a + u * b) + w * ((1 - u) * d + u * c);
    };
    for (int s = 0; s < kParts; ++s) {
      for (int t = 0; t < kParts; ++t) {
        const std::vector<Vector3d> part{at(s, t), at(s + 1, t), at(s + 1, t + 1), at(s, t + 1)};
        const double factor = point_to_polygon(point, normal, part);
        moment += factor * ((part[0] + part[1] + part[2] + part[3]) / 4 - facet.centre);
        sum += factor;
      }
    }
  }
  return sum > 0 ? Vector3d(weight / sum * moment) : Vector3d::Zero();
}

/// A common vertex: nothing can stand between them.
bool touch(const Facet& a, const Facet& b) {
  return std::ranges::any_of(a.vertices, [&](const Vector3d& p) {
    return std::ranges::any_of(b.vertices,
                               [&](const Vector3d& q) { return (p - q).norm() < 1e-9; });
  });
}

/// Over a near patch B is not constant: adds weight_j * gradient . first moment, as weights of the
/// neighbours.
void add_gradients(const Vector3d& point, const Vector3d& normal, const scenes::PatchMesh& mesh,
                   const std::vector<Facet>& facets, const GatherOptions& options, GatherRow& row) {
  constexpr double kNear =
      4;  // in patch sizes; farther off the moment is that of the plain centroid
  const VectorXd weights = row.weights;
  for (std::size_t j = 0; j < facets.size(); ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    const bool lamp = !options.lamp.empty() && options.lamp[j];
    const bool near = (facets[j].centre - point).norm() < kNear * facets[j].size_m;
    if (lamp || !near || weights[at] <= 0) continue;
    const Vector3d moment = first_moment(point, normal, facets[j], weights[at]);
    const auto gradient = gradient_weights(mesh, facets, j);
    double part = 1, own = 0;  // no weight may fall below 0: light is never negative
    for (const auto& [k, a] : gradient) {
      const double change = moment.dot(a);
      if (change < 0) part = std::min(part, std::max(0.0, row.weights[k]) / -change);
      own += change;
    }
    if (own > 0) part = std::min(part, std::max(0.0, row.weights[at]) / own);
    for (const auto& [k, a] : gradient) {
      row.weights[k] += part * moment.dot(a);
      row.weights[at] -= part * moment.dot(a);
    }
  }
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
    if (known || (other - normal).norm() < kOnPlane_m) continue;
    if (inside(mesh.polygon[j], other, point)) touched.push_back(other);
  }
  Vector3d moved = point;
  for (const Vector3d& n : touched) moved += kStep_m * n;
  return moved;
}

}  // namespace

GradientWeights gradient_weights(const scenes::PatchMesh& mesh, const std::vector<Facet>& facets,
                                 std::size_t j) {
  constexpr double kReach = 1.6;  // in patch sizes: the eight neighbours of a square
  GradientWeights neighbours;
  Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < facets.size(); ++k) {
    if (k == j || mesh.surface[k] != mesh.surface[j] || mesh.plane[k] != mesh.plane[j]) continue;
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

GatherRow gather_at_point(const Vector3d& at_m, const Vector3d& normal,
                          const scenes::PatchMesh& mesh, const std::vector<Facet>& facets,
                          const Visibility& visibility, const GatherOptions& options) {
  const Vector3d point = off_the_edge(at_m, normal, mesh);
  const auto n = static_cast<Eigen::Index>(facets.size());
  GatherRow row{.weights = VectorXd::Zero(n), .standard_error = VectorXd::Zero(n)};
  const SeparationMask mask = visibility.separation(point, normal);
  for (std::size_t j = 0; j < facets.size(); ++j) {
    const Facet& facet = facets[j];
    if (facet.plane().height_m(point) <= 1e-12) continue;  // on its plane or behind it
    const auto at = static_cast<Eigen::Index>(j);
    row.weights[at] = point_to_polygon(point, normal, facet.vertices);
    if (row.weights[at] > 0 && visibility.may_block(mask, static_cast<int>(j))) {
      const bool lamp = !options.lamp.empty() && options.lamp[j];
      const VisibleShare visible =
          lamp ? visibility.from_point(point, normal, facet, j, options.lamp_error,
                                       options.most_lamp_rays)
               : visibility.from_point(point, normal, facet, j, 1, options.rays);
      row.standard_error[at] = row.weights[at] * visible.standard_error;
      row.weights[at] *= visible.share;
    }
  }
  close_row(row);
  add_gradients(point, normal, mesh, facets, options, row);
  row.norm = row_norm(row.weights, mesh.area_m2);
  return row;
}

ViewRows view_rows(const Vector3d& eye_m, const Vector3d& look_at_m,
                   const scenes::PatchMesh& mesh) {
  const PatchRays rays(mesh);
  const Vector3d axis = (look_at_m - eye_m).normalized();
  constexpr int kCentreRays = 64;
  VectorXd centre = VectorXd::Zero(mesh.size()), background = centre, field = centre,
           near_axis = centre;
  const auto add_to = [&near_axis](VectorXd& sum) {
    return [&near_axis, &sum](int patch, double cosine, double solid_angle) {
      sum[patch] += solid_angle;
      near_axis[patch] += cosine * solid_angle;
    };
  };
  add_directions(rays, eye_m, axis, 0, 1, kCentreRays, add_to(centre));
  add_directions(rays, eye_m, axis, 1, 11, kBackgroundRays, add_to(background));
  add_directions(rays, eye_m, axis, 11, 90, kFieldRays, add_to(field));
  return {.background = normalised(std::move(background), mesh.area_m2),
          .field = normalised(std::move(field), mesh.area_m2),
          .near_axis = normalised(std::move(near_axis), mesh.area_m2)};
}

ViewedPoint viewed_point(const scenes::Room& room, std::size_t group) {
  constexpr double kNoCut_m = 1e9;  // a patch edge longer than any room: faces stay whole
  const scenes::PatchMesh mesh = scenes::mesh_room(room, kNoCut_m);
  const PatchRays rays(mesh);
  std::optional<scenes::View> view = group == 0 ? room.view : std::nullopt;
  if (group < room.paint.size() && room.paint[group].view) view = room.paint[group].view;
  if (view) {
    const RayHit hit = rays.first_hit(view->eye_m, view->look_at_m - view->eye_m);
    if (hit.patch < 0)
      throw std::invalid_argument("the view ray meets nothing; is the eye in the room?");
    const auto p = static_cast<std::size_t>(hit.patch);
    return {.eye_m = view->eye_m,
            .point_m = hit.point_m,
            .normal = mesh.normal[p],
            .surface = mesh.surface[p]};
  }
  const auto [surface, middle] = default_target(room, group, mesh);
  std::optional<ViewedPoint> viewed = free_point(mesh, surface, middle);
  if (!viewed) throw std::invalid_argument("the painted surface is hidden by furniture");
  const RayHit opposite = rays.first_hit(viewed->point_m, viewed->normal);
  const double free_m = opposite.patch < 0 ? 4 : (opposite.point_m - viewed->point_m).norm();
  viewed->eye_m = viewed->point_m + std::min(2.0, free_m / 2) * viewed->normal;
  return *viewed;
}

}  // namespace solver
