#include "solver/obstacles/ray_scene.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>
#include <utility>

namespace solver {
namespace {

/// Rejects hits of triangles whose front looks away.
void pass_from_behind(const RTCFilterFunctionNArguments* hit) {
  const auto* fronts = static_cast<const Eigen::Vector3f*>(hit->geometryUserPtr);
  for (unsigned k = 0; k < hit->N; ++k) {
    if (hit->valid[k] != -1) continue;
    const Eigen::Vector3f& front = fronts[RTCHitN_primID(hit->hit, hit->N, k)];
    const float along = front.x() * RTCRayN_dir_x(hit->ray, hit->N, k) +
                        front.y() * RTCRayN_dir_y(hit->ray, hit->N, k) +
                        front.z() * RTCRayN_dir_z(hit->ray, hit->N, k);
    if (along >= 0) hit->valid[k] = 0;
  }
}

}  // namespace

RayScene::RayScene(const std::vector<std::array<Eigen::Vector3d, 3>>& triangles,
                   std::vector<Eigen::Vector3f> fronts)
    : fronts_(std::move(fronts)) {
  // Where Embree is the first to use TBB, the worker threads keep its flush-to-zero mode, and later
  // results would depend on the number of threads. So TBB is used first.
  tbb::parallel_for(0, 64, [](int) {});
  Eigen::AlignedBox3d box;
  for (const auto& triangle : triangles) {
    for (const Eigen::Vector3d& corner : triangle) box.extend(corner);
  }
  middle_m_ = box.center();
  device_ = rtcNewDevice(nullptr);
  if (device_ == nullptr) throw std::runtime_error("Embree cannot start");
  scene_ = rtcNewScene(device_);
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  const std::size_t corners = 3 * triangles.size();
  auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), corners));
  auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), corners / 3));
  for (std::size_t k = 0; k < corners; ++k) {
    index[k] = static_cast<unsigned>(k);
    const Eigen::Vector3f v = local(triangles[k / 3][k % 3]);
    std::copy_n(v.data(), 3, vertex + 3 * k);
  }
  if (!fronts_.empty()) {
    rtcSetGeometryUserData(geometry, fronts_.data());
    rtcSetGeometryIntersectFilterFunction(geometry, pass_from_behind);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_);
}

RayScene::~RayScene() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

}  // namespace solver
