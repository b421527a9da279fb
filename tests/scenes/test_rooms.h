#pragma once
#include "scenes/shapes/room_builder.h"

namespace scenes {

inline RoomBuilder rectangular_room(double width_m, double depth_m, double height_m) {
  return {rectangular_plan(width_m, depth_m), height_m};
}

}  // namespace scenes
