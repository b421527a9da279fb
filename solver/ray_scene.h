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

 private:
  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace solver
