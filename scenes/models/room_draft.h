#pragma once
#include <string>
#include <vector>

#include "scenes/models/building_model.h"

namespace scenes {

/// Rooms of a building model as one room of ours: what a room file says, before it is written.
struct RoomDraft {
  struct Face {
    std::string surface;
    Outline outline;
    std::vector<Outline> holes;
  };

  struct Opening {
    std::string name;
    Outline outline;  ///< convex
    ModelFinish finish;
    bool lit = false;  ///< a window to the outdoors
  };

  struct Finish {
    std::string name;
    ModelFinish finish;
  };

  std::string name;
  std::vector<Face> faces;
  std::vector<Opening> openings;
  std::vector<ModelSheet> sheets;
  std::vector<ModelSensor> sensors;
  std::vector<Finish> surfaces;
  std::vector<std::string> notes;
};

/// @param rooms  identifiers or names; several are joined where open faces or glass lie between
/// them. None: the only room of the model
/// @throws std::invalid_argument  if there is no such room (it lists those that there are), or if a
/// room is open to one that was not asked for
[[nodiscard]] RoomDraft draft_room(const BuildingModel& model,
                                   const std::vector<std::string>& rooms);

}  // namespace scenes
