#include "scenes/room.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <stdexcept>

namespace scenes {
namespace {

struct Rectangle {
  Eigen::Vector2d min_m, max_m;  ///< in the frame of the surface that holds it
};

Rectangle extent_of(const Opening& o) {
  const Eigen::Vector2d low(o.offset_m, o.sill_m);
  return {low, low + Eigen::Vector2d(o.width_m, o.height_m)};
}

Rectangle extent_of(const Panel& p) {
  return {p.center_m - p.size_m / 2, p.center_m + p.size_m / 2};
}

const Surface& surface_at(const Room& room, int surface) {
  return room.surfaces.at(static_cast<std::size_t>(surface));
}

Frame frame_of_wall(const Room& room, std::size_t wall) {
  const Eigen::Vector2d from = room.plan_m.at(wall);
  const Eigen::Vector2d to = room.plan_m[(wall + 1) % room.plan_m.size()];
  // stableNormalized: exactly 1 along an axis, so that axis-aligned rooms have exact patches.
  const Eigen::Vector2d along = (to - from).stableNormalized();
  return {.origin_m = {from.x(), from.y(), 0},
          .along = {along.x(), along.y(), 0},
          .up = Eigen::Vector3d::UnitZ(),
          .normal = {-along.y(), along.x(), 0}};
}

}  // namespace

int find_surface(const Room& room, std::string_view name) {
  const auto it = std::ranges::find(room.surfaces, name, &Surface::name);
  return it == room.surfaces.end() ? -1 : static_cast<int>(it - room.surfaces.begin());
}

int paint_group(const Room& room, int surface) {
  for (std::size_t g = 0; g < room.paint.size(); ++g) {
    if (std::ranges::find(room.paint[g].surfaces, surface) != room.paint[g].surfaces.end())
      return static_cast<int>(g);
  }
  return -1;
}

Room relit(const Room& room, const Scenario& scenario) {
  Room lit = room;
  for (Surface& s : lit.surfaces) s.exitance.values.setZero();
  for (std::size_t k = 0; k < room.lights.size(); ++k) {
    const Light& light = room.lights[k];
    const double scale = scenario.scale[k];
    if (light.point >= 0) {
      lit.point_lights[static_cast<std::size_t>(light.point)].spectral_flux.values *= scale;
    } else if (light.luminaire >= 0) {
      lit.luminaires[static_cast<std::size_t>(light.luminaire)].spectral_flux.values *= scale;
    } else if (light.sun >= 0) {
      lit.suns[static_cast<std::size_t>(light.sun)].normal_irradiance.values *= scale;
    } else {
      const auto lamp = std::ranges::find_if(lit.surfaces, [&](const Surface& s) {
        return s.kind == light.kind && s.index == light.index;
      });
      lamp->exitance.values += scale * light.exitance.values;
    }
  }
  return lit;
}

std::vector<Eigen::Vector2d> footprint(const Box& box) {
  const Eigen::Vector2d low = box.min_m.head<2>(), high = box.max_m.head<2>();
  const Eigen::Vector2d centre = (low + high) / 2;
  std::vector<Eigen::Vector2d> corners{low, {high.x(), low.y()}, high, {low.x(), high.y()}};
  // Added as a displacement (R - 1)(p - c): a box that is not rotated keeps its exact coordinates.
  const Eigen::Matrix2d turn =
      Eigen::Rotation2Dd(box.rotate_z_deg * std::numbers::pi / 180).toRotationMatrix() -
      Eigen::Matrix2d::Identity();
  for (Eigen::Vector2d& corner : corners) corner += turn * (corner - centre);
  return corners;
}

Frame frame_of(const Room& room, int surface) {
  const Surface& s = surface_at(room, surface);
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                        z = Eigen::Vector3d::UnitZ();
  const auto index = static_cast<std::size_t>(s.index);
  switch (s.kind) {
    case SurfaceKind::floor:
      return {.origin_m = Eigen::Vector3d::Zero(), .along = x, .up = y, .normal = z};
    case SurfaceKind::ceiling:
      return {.origin_m = room.height_m * z, .along = x, .up = y, .normal = -z};
    case SurfaceKind::wall:
      return frame_of_wall(room, index);
    case SurfaceKind::opening:
      return frame_of_wall(room, static_cast<std::size_t>(room.openings.at(index).wall));
    case SurfaceKind::panel:
      return frame_of(room, room.panels.at(index).on);
    case SurfaceKind::furniture:
      break;
  }
  throw std::invalid_argument(fmt::format("furniture \"{}\" has no single frame", s.name));
}

std::vector<Eigen::Vector3d> rectangle_of(const Room& room, int surface) {
  const Surface& s = surface_at(room, surface);
  const auto index = static_cast<std::size_t>(s.index);
  if (s.kind != SurfaceKind::opening && s.kind != SurfaceKind::panel) {
    throw std::invalid_argument(fmt::format("\"{}\" is neither opening nor panel", s.name));
  }
  const auto [low, high] = s.kind == SurfaceKind::opening ? extent_of(room.openings.at(index))
                                                          : extent_of(room.panels.at(index));
  const Frame frame = frame_of(room, surface);
  const auto at = [&frame](double u, double v) -> Eigen::Vector3d {
    return frame.origin_m + u * frame.along + v * frame.up;
  };
  std::vector<Eigen::Vector3d> corners{at(low.x(), low.y()), at(high.x(), low.y()),
                                       at(high.x(), high.y()), at(low.x(), high.y())};
  const bool mirrored = frame.along.cross(frame.up).dot(frame.normal) < 0;
  if (mirrored) std::ranges::reverse(corners);
  return corners;
}

}  // namespace scenes
