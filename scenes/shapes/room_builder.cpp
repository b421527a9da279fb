#include "scenes/shapes/room_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "scenes/shapes/shell.h"

namespace scenes {

RoomBuilder::RoomBuilder(const Polygon& plan_m, double height_m, double reflectance,
                         const spectra::Grid& grid)
    : RoomBuilder(plan_m, std::vector<RoofPlane>{{.height_m = height_m}}, reflectance, grid) {}

RoomBuilder::RoomBuilder(const Polygon& plan_m, const std::vector<RoofPlane>& planes,
                         double reflectance, const spectra::Grid& grid)
    : reflectance_(reflectance) {
  room_.grid = grid;
  room_.shell = roofed_shell(plan_m, planes);
  add("floor", SurfaceKind::floor);
  add("ceiling", SurfaceKind::ceiling);
  for (std::size_t i = 1; i <= plan_m.size(); ++i) {
    add(fmt::format("wall_{}", i), SurfaceKind::wall);
  }
}

RoomBuilder::RoomBuilder(std::vector<ShellFace> shell, double reflectance,
                         const spectra::Grid& grid)
    : reflectance_(reflectance) {
  room_.grid = grid;
  room_.shell = std::move(shell);
  for (std::size_t i = 0; i < room_.shell.size(); ++i) {
    room_.shell[i].surface = static_cast<int>(i);
    add(fmt::format("face_{}", i + 1), SurfaceKind::wall);
  }
}

RoomBuilder& RoomBuilder::opening(int wall, const Eigen::Vector2d& low_m,
                                  const Eigen::Vector2d& size_m, double transmittance) {
  const int face = face_of(wall + 2);
  const Frame& frame = room_.shell[static_cast<std::size_t>(face)].frame;
  const std::size_t index = room_.openings.size();
  room_.openings.push_back({.name = fmt::format("opening_{}", index + 1),
                            .face = face,
                            .outline = rectangle_in(frame, low_m, low_m + size_m),
                            .transmittance = spectra::constant(room_.grid, transmittance)});
  add(room_.openings.back().name, SurfaceKind::opening, index);
  return *this;
}

RoomBuilder& RoomBuilder::panel(int face, const Eigen::Vector2d& centre_m,
                                const Eigen::Vector2d& size_m) {
  const Frame& frame = room_.shell.at(static_cast<std::size_t>(face)).frame;
  const std::size_t index = room_.panels.size();
  room_.panels.push_back(
      {.name = fmt::format("panel_{}", index + 1),
       .face = face,
       .outline = rectangle_in(frame, centre_m - size_m / 2, centre_m + size_m / 2)});
  add(room_.panels.back().name, SurfaceKind::panel, index);
  return *this;
}

RoomBuilder& RoomBuilder::box(const Eigen::Vector3d& min_m, const Eigen::Vector3d& max_m,
                              double rotate_z_deg) {
  return body(
      box_body(fmt::format("box_{}", room_.furniture.size() + 1), min_m, max_m, rotate_z_deg));
}

RoomBuilder& RoomBuilder::body(Body body) {
  const std::size_t index = room_.furniture.size();
  room_.furniture.push_back(std::move(body));
  add(room_.furniture.back().name, SurfaceKind::furniture, index);
  return *this;
}

int RoomBuilder::face_of(int surface) const {
  const auto face = std::ranges::find(room_.shell, surface, &ShellFace::surface);
  if (face == room_.shell.end()) throw std::invalid_argument("the room has no such surface");
  return static_cast<int>(face - room_.shell.begin());
}

void RoomBuilder::add(std::string name, SurfaceKind kind, std::size_t index) {
  const bool black = kind == SurfaceKind::opening || kind == SurfaceKind::panel;
  room_.surfaces.push_back({.name = std::move(name),
                            .kind = kind,
                            .index = static_cast<int>(index),
                            .reflectance = spectra::constant(room_.grid, black ? 0 : reflectance_),
                            .exitance = spectra::constant(room_.grid, 0)});
}

Polygon rectangular_plan(double width_m, double depth_m) {
  return {{0, 0}, {width_m, 0}, {width_m, depth_m}, {0, depth_m}};
}

}  // namespace scenes
