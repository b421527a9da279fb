#include "solver/sensors/eye.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "solver/obstacles/patch_rays.h"

namespace solver {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kDegree = std::numbers::pi / 180;

/// Follows `rays` directions between two cones around the axis, and calls add(hit, cosine, solid
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
    if (hit.patch >= 0) add(hit, cosine, (inner - outer) / rays);
  }
}

GatherRow seen(VectorXd sum, const std::vector<double>& area_m2) {
  if (!(sum.head(static_cast<Eigen::Index>(area_m2.size())).sum() > 0))
    throw std::invalid_argument("the eye sees no surface; is it in the room?");
  return closed_row(std::move(sum), area_m2);
}

/// Of a wall: its longest level edge.
double length_m(const scenes::Room& room, int surface) {
  double longest_m = 0;
  for (const scenes::ShellFace& face : room.shell) {
    if (face.surface != surface) continue;
    for (std::size_t k = 0; k < face.outline.size(); ++k) {
      const Vector3d edge = face.outline[(k + 1) % face.outline.size()] - face.outline[k];
      if (std::abs(edge.z()) < scenes::kCoplanar_m) longest_m = std::max(longest_m, edge.norm());
    }
  }
  return longest_m;
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
    return 1e6 + length_m(room, s);
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
                            contains(mesh.polygon[i], mesh.normal[i], middle);
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

}  // namespace

ViewRows view_rows(const Vector3d& eye_m, const Vector3d& look_at_m, const scenes::PatchMesh& mesh,
                   const std::vector<SlopeBasis>& bases) {
  const PatchRays rays(mesh);
  const Vector3d axis = (look_at_m - eye_m).normalized();
  constexpr int kCentreRays = 64;
  const int n = mesh.size(), modes = bases.empty() ? 1 : SlopeBasis::kModes;
  VectorXd background = VectorXd::Zero(Eigen::Index{modes} * n), field = background,
           near_axis = background;
  const auto add = [&](const RayHit& hit, double weight, VectorXd& sum) {
    sum[hit.patch] += weight;
    if (bases.empty()) return;
    const auto patch = static_cast<std::size_t>(hit.patch);
    const Eigen::Vector2d psi = bases[patch].at(hit.point_m - mesh.centre[patch]);
    sum[n + hit.patch] += weight * psi[0];
    sum[2 * n + hit.patch] += weight * psi[1];
  };
  const auto add_to = [&](VectorXd* sum) {
    return [&, sum](const RayHit& hit, double cosine, double solid_angle) {
      if (sum != nullptr) add(hit, solid_angle, *sum);
      add(hit, cosine * solid_angle, near_axis);
    };
  };
  add_directions(rays, eye_m, axis, 0, 1, kCentreRays, add_to(nullptr));
  add_directions(rays, eye_m, axis, 1, 11, kBackgroundRays, add_to(&background));
  add_directions(rays, eye_m, axis, 11, 90, kFieldRays, add_to(&field));
  return {.background = seen(std::move(background), mesh.area_m2),
          .field = seen(std::move(field), mesh.area_m2),
          .near_axis = seen(std::move(near_axis), mesh.area_m2)};
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
