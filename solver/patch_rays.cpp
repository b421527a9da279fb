#include "solver/patch_rays.h"

#include <limits>

#include "solver/ray_scene.h"

namespace solver {

struct PatchRays::Scene {
  std::vector<int> patch_of;  ///< per triangle
  std::unique_ptr<RayScene> rays;
};

PatchRays::PatchRays(const scenes::PatchMesh& mesh)
    : mesh_(mesh), scene_(std::make_unique<Scene>()) {
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;
  for (int p = 0; p < mesh.size(); ++p) {
    const auto& v = mesh.polygon[static_cast<std::size_t>(p)];
    for (std::size_t k = 1; k + 1 < v.size(); ++k) {
      triangles.push_back({v[0], v[k], v[k + 1]});
      scene_->patch_of.push_back(p);
    }
  }
  scene_->rays = std::make_unique<RayScene>(triangles);
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

}  // namespace solver
