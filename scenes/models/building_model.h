#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "scenes/geometry/outline.h"

namespace scenes {

/// What a building model says of a room, in metres: plain data that knows no file format.

/// Diffuse reflectance by linear r, g, b, or what a glass lets through.
struct ModelFinish {
  Eigen::Array3d reflectance = Eigen::Array3d::Zero();
  double transmittance = 0;  ///< at right angles, of light; 0: opaque
};

enum class ModelFaceKind { wall, floor, ceiling, open };

/// A window or a door in the plane of its face.
struct ModelPart {
  std::string name;
  Outline outline;
  std::vector<Outline> holes;
  ModelFinish finish;
  bool outdoors = true;
  std::string neighbour;  ///< room on the other side, by identifier
};

struct ModelFace {
  std::string name;
  Outline outline;
  std::vector<Outline> holes;
  ModelFinish finish;
  ModelFaceKind kind = ModelFaceKind::wall;
  std::string neighbour;  ///< room on the other side, by identifier
  std::vector<ModelPart> parts;
};

/// A thin polygon that reflects on both sides.
struct ModelSheet {
  std::string name;
  Outline outline;
  std::vector<Outline> holes;
  ModelFinish finish;
};

struct ModelSensor {
  std::string name;
  Eigen::Vector3d at_m, normal;
  std::string room;  ///< by identifier or name; empty: not said
};

struct ModelRoom {
  std::string identifier, name;
  std::vector<ModelFace> faces;
  std::vector<ModelSheet> sheets;
};

struct BuildingModel {
  std::string name;
  std::vector<ModelRoom> rooms;
  std::vector<ModelSensor> sensors;
  double tolerance_m = 0.01;       ///< corners nearer than this are one
  std::vector<std::string> notes;  ///< what was assumed, and what is not carried over
};

}  // namespace scenes
