#pragma once
#include <embree3/rtcore.h>

#include <Eigen/Core>
#include <array>
#include <vector>

namespace solver {

/// Triangles in Embree; primitive k is triangle k. Rays pass through some from behind: where two
/// faces lie back to back, as on a sheet, either may be met first.
class RayScene {
 public:
  /// @param fronts  normal of each triangle, if those seen from behind are not there; else empty
  explicit RayScene(const std::vector<std::array<Eigen::Vector3d, 3>>& triangles,
                    std::vector<Eigen::Vector3f> fronts = {});
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  [[nodiscard]] RTCScene get() const { return scene_; }

  /// Rays are float: their points are taken from the middle of the scene, wherever it lies.
  [[nodiscard]] Eigen::Vector3f local(const Eigen::Vector3d& p) const {
    return (p - middle_m_).cast<float>();
  }

 private:
  std::vector<Eigen::Vector3f> fronts_;
  Eigen::Vector3d middle_m_;
  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace solver
