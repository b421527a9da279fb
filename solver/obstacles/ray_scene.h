#pragma once
#include <embree3/rtcore.h>

#include <Eigen/Core>
#include <array>
#include <vector>

namespace solver {

/// Triangles in Embree; primitive k is triangle k.
class RayScene {
 public:
  explicit RayScene(const std::vector<std::array<Eigen::Vector3d, 3>>& triangles);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  [[nodiscard]] RTCScene get() const { return scene_; }

  /// Rays are float: their points are taken from the middle of the scene, wherever it lies.
  [[nodiscard]] Eigen::Vector3f local(const Eigen::Vector3d& p) const {
    return (p - middle_m_).cast<float>();
  }

 private:
  Eigen::Vector3d middle_m_;
  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace solver
