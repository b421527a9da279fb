#include "solver/obstacles/patch_rays.h"

#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "solver/obstacles/ray_scene.h"

namespace solver {

struct PatchRays::Scene {
  std::vector<int> patch_of;  ///< per triangle
  std::unique_ptr<RayScene> rays;
};

namespace {

/// Some patches lie back to back: on sheets, and walls without thickness.
bool has_thin_faces(const scenes::PatchMesh& mesh) {
  std::map<int, int> first;  // patch of each plane
  for (int p = 0; p < mesh.size(); ++p) first.emplace(mesh.plane[static_cast<std::size_t>(p)], p);
  for (const auto& [plane, a] : first) {
    for (const auto& [other, b] : first) {
      const auto i = static_cast<std::size_t>(a), k = static_cast<std::size_t>(b);
      if ((mesh.normal[i] + mesh.normal[k]).norm() < 1e-9 &&
          std::abs(mesh.normal[i].dot(mesh.centre[i] - mesh.centre[k])) < 1e-9) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

PatchRays::PatchRays(const scenes::PatchMesh& mesh)
    : mesh_(mesh), scene_(std::make_unique<Scene>()) {
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;
  std::vector<Eigen::Vector3f> fronts;
  const bool thin = has_thin_faces(mesh);
  for (int p = 0; p < mesh.size(); ++p) {
    const auto& v = mesh.polygon[static_cast<std::size_t>(p)];
    for (std::size_t k = 1; k + 1 < v.size(); ++k) {
      triangles.push_back({v[0], v[k], v[k + 1]});
      scene_->patch_of.push_back(p);
      if (thin) fronts.push_back(mesh.normal[static_cast<std::size_t>(p)].cast<float>());
    }
  }
  scene_->rays = std::make_unique<RayScene>(triangles, std::move(fronts));
}

PatchRays::~PatchRays() = default;

RayHit PatchRays::first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
  const Eigen::Vector3f from = scene_->rays->local(origin);
  RTCRayHit ray{};
  ray.ray.org_x = from.x();
  ray.ray.org_y = from.y();
  ray.ray.org_z = from.z();
  ray.ray.dir_x = static_cast<float>(direction.x());
  ray.ray.dir_y = static_cast<float>(direction.y());
  ray.ray.dir_z = static_cast<float>(direction.z());
  ray.ray.tnear = 1e-5F;
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.ray.mask = ~0U;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_->rays->get(), &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {-1, origin};
  const int patch = scene_->patch_of[ray.hit.primID];
  const auto p = static_cast<std::size_t>(patch);
  const Eigen::Vector3d& n = mesh_.normal[p];
  const double t = n.dot(mesh_.centre[p] - origin) / n.dot(direction);
  return {patch, origin + t * direction};
}

ParallelHits PatchRays::first_hits(const std::array<Eigen::Vector3d, kRayPacket>& origin, int count,
                                   const Eigen::Vector3d& direction) const {
  alignas(64) RTCRayHit16 rays{};
  alignas(64) std::array<int, kRayPacket> valid{};
  const Eigen::Vector3f d = direction.cast<float>();
  for (int k = 0; k < count; ++k) {
    const auto lane = static_cast<std::size_t>(k);
    const Eigen::Vector3f from = scene_->rays->local(origin[lane]);
    valid[lane] = -1;
    rays.ray.org_x[k] = from.x();
    rays.ray.org_y[k] = from.y();
    rays.ray.org_z[k] = from.z();
    rays.ray.dir_x[k] = d.x();
    rays.ray.dir_y[k] = d.y();
    rays.ray.dir_z[k] = d.z();
    rays.ray.tfar[k] = std::numeric_limits<float>::infinity();
    rays.ray.mask[k] = ~0U;
    rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid.data(), scene_->rays->get(), &context, &rays);
  ParallelHits hits;
  hits.patch.fill(-1);
  for (int k = 0; k < count; ++k) {
    const auto lane = static_cast<std::size_t>(k);
    if (rays.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) continue;
    const int patch = scene_->patch_of[rays.hit.primID[k]];
    if (mesh_.normal[static_cast<std::size_t>(patch)].dot(direction) >= 0) continue;
    hits.patch[lane] = patch;
    hits.distance_m[lane] = static_cast<double>(rays.ray.tfar[k]);
  }
  return hits;
}

}  // namespace solver
