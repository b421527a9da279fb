#pragma once
#include <string>
#include <vector>

#include "scenes/room.h"

namespace scenes {

/// Rooms built in code, with constant spectra. Surfaces are registered as things are added, so add
/// openings before panels and panels before furniture.
class RoomBuilder {
 public:
  RoomBuilder(std::vector<Eigen::Vector2d> plan_m, double height_m) {
    room_.grid = spectra::kTransportGrid;
    room_.plan_m = std::move(plan_m);
    room_.height_m = height_m;
    add("floor", SurfaceKind::floor, 0);
    add("ceiling", SurfaceKind::ceiling, 0);
    for (int i = 0; i < static_cast<int>(room_.plan_m.size()); ++i) {
      add("wall_" + std::to_string(i + 1), SurfaceKind::wall, i);
    }
  }

  RoomBuilder& opening(int wall, Eigen::Vector2d low_m, Eigen::Vector2d size_m) {
    const int index = static_cast<int>(room_.openings.size());
    room_.openings.push_back({.name = "opening_" + std::to_string(index + 1),
                              .wall = wall,
                              .offset_m = low_m.x(),
                              .sill_m = low_m.y(),
                              .width_m = size_m.x(),
                              .height_m = size_m.y(),
                              .transmittance = spectra::constant(room_.grid, 1)});
    add(room_.openings.back().name, SurfaceKind::opening, index);
    return *this;
  }

  RoomBuilder& panel(int on, Eigen::Vector2d center_m, Eigen::Vector2d size_m) {
    const int index = static_cast<int>(room_.panels.size());
    room_.panels.push_back({.name = "panel_" + std::to_string(index + 1),
                            .on = on,
                            .center_m = center_m,
                            .size_m = size_m});
    add(room_.panels.back().name, SurfaceKind::panel, index);
    return *this;
  }

  RoomBuilder& box(Eigen::Vector3d min_m, Eigen::Vector3d max_m, double rotate_z_deg = 0) {
    const int index = static_cast<int>(room_.furniture.size());
    room_.furniture.push_back({.name = "box_" + std::to_string(index + 1),
                               .min_m = min_m,
                               .max_m = max_m,
                               .rotate_z_deg = rotate_z_deg});
    add(room_.furniture.back().name, SurfaceKind::furniture, index);
    return *this;
  }

  [[nodiscard]] const Room& room() const { return room_; }

 private:
  void add(std::string name, SurfaceKind kind, int index) {
    const double reflectance = kind == SurfaceKind::opening || kind == SurfaceKind::panel ? 0 : 0.5;
    room_.surfaces.push_back({.name = std::move(name),
                              .kind = kind,
                              .index = index,
                              .reflectance = spectra::constant(room_.grid, reflectance),
                              .exitance = spectra::constant(room_.grid, 0)});
  }

  Room room_;
};

inline RoomBuilder rectangular_room(double width_m, double depth_m, double height_m) {
  return {{{0, 0}, {width_m, 0}, {width_m, depth_m}, {0, depth_m}}, height_m};
}

}  // namespace scenes
