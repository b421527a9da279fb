// The reflectances of a room file, and the list of surfaces.
#include <fmt/format.h>

#include <algorithm>

#include "scenes/files/room_reader.h"
#include "scenes/geometry/fits.h"

namespace scenes {

using spectra::JsonNode;
using spectra::JsonObject;

namespace {

/// `outer` holds all of `inner`; both are convex.
bool covers(const Polygon& outer, const Polygon& inner) {
  return std::ranges::all_of(inner,
                             [&](const auto& corner) { return is_inside_or_on(outer, corner); });
}

/// Where a box touches a wall, in the wall's frame; empty if it does not.
Polygon contact_with_wall(const Box& box, const Frame& wall) {
  const Polygon foot = footprint(box);
  for (std::size_t i = 0; i < foot.size(); ++i) {
    const Eigen::Vector2d from = foot[i] - wall.origin_m.head<2>();
    const Eigen::Vector2d to = foot[(i + 1) % foot.size()] - wall.origin_m.head<2>();
    const Eigen::Vector2d normal = wall.normal.head<2>(), along = wall.along.head<2>();
    if (std::abs(from.dot(normal)) > kTouch_m || std::abs(to.dot(normal)) > kTouch_m) continue;
    const auto [low, high] = std::minmax({from.dot(along), to.dot(along)});
    return rectangle({low, box.min_m.z()}, {high, box.max_m.z()});
  }
  return {};
}

Polygon contact_with(const Box& box, const Room& room, int surface) {
  const bool touches =
      surface == 0 ? box.min_m.z() <= kTouch_m : box.max_m.z() >= room.height_m - kTouch_m;
  if (surface < 2) return touches ? footprint(box) : Polygon{};
  return contact_with_wall(box, frame_of(room, surface));
}

}  // namespace

void RoomReader::read_surfaces() {
  add_surface("floor", SurfaceKind::floor, 0);
  add_surface("ceiling", SurfaceKind::ceiling, 0);
  for (std::size_t i = 0; i < wall_names_.size(); ++i) {
    add_surface(wall_names_[i], SurfaceKind::wall, i);
  }
  for (std::size_t i = 0; i < room_.openings.size(); ++i) {
    add_surface(room_.openings[i].name, SurfaceKind::opening, i);
  }
  for (std::size_t i = 0; i < room_.panels.size(); ++i) {
    add_surface(room_.panels[i].name, SurfaceKind::panel, i);
  }
  for (std::size_t i = 0; i < room_.furniture.size(); ++i) {
    add_surface(room_.furniture[i].name, SurfaceKind::furniture, i);
  }

  const auto node = top_.need("surfaces");
  if (!node) return;
  std::vector<std::string> known{"walls"};
  for (const Surface& s : room_.surfaces) {
    if (s.kind != SurfaceKind::panel && !s.name.empty()) known.push_back(s.name);
  }
  const JsonObject given = walls_known_ ? node->object(known) : node->any_object();
  std::optional<Reflectance> walls;
  if (const auto all = given.find("walls")) walls = curves_.reflectance(*all);
  for (Surface& surface : room_.surfaces) set_reflectance(surface, given, walls);
}

void RoomReader::add_surface(const std::string& name, SurfaceKind kind, std::size_t index) {
  room_.surfaces.push_back({.name = name,
                            .kind = kind,
                            .index = static_cast<int>(index),
                            .reflectance = curves_.zero(),
                            .exitance = curves_.zero()});
}

void RoomReader::set_reflectance(Surface& surface, const JsonObject& given,
                                 const std::optional<Reflectance>& walls) {
  const auto index = static_cast<std::size_t>(surface.index);
  std::optional<Reflectance> chosen;
  if (surface.kind == SurfaceKind::panel) {
    chosen = lamps_[index].reflectance;
    surface.exitance = lamps_[index].exitance;
  } else if (const auto own = given.find(surface.name)) {
    chosen = curves_.reflectance(*own);
  } else if (surface.kind == SurfaceKind::wall) {
    chosen = walls;
  }
  if (surface.kind == SurfaceKind::opening && opening_exitance_[index]) {
    surface.exitance = *opening_exitance_[index];
    if (!chosen) chosen = Reflectance{.spectrum = curves_.zero()};
  }
  if (chosen) {
    surface.reflectance = chosen->spectrum;
    surface.reconstructed = chosen->reconstructed;
    return;
  }
  const bool may_be_lit = surface.kind == SurfaceKind::opening && !lights_known_;
  if (surface.name.empty() || may_be_lit) return;
  const std::string as_wall = surface.kind == SurfaceKind::wall ? "\"walls\" or " : "";
  const std::string or_lit = surface.kind == SurfaceKind::opening ? ", or light it" : "";
  given.fault(fmt::format("\"{}\" has no reflectance", surface.name),
              fmt::format("add {}\"{}\"{}", as_wall, surface.name, or_lit));
}

void RoomReader::check_covered() const {
  for (std::size_t b = 0; b < room_.furniture.size(); ++b) {
    const Box& box = room_.furniture[b];
    if (!is_sound(box)) continue;
    const auto check = [&](const std::string& name, const Polygon& extent, int surface) {
      if (surface < 0 || !is_sound(extent)) return;
      const Polygon contact = contact_with(box, room_, surface);
      if (contact.empty() || !covers(contact, extent)) return;
      box_places_[b].fault(fmt::format("it covers \"{}\" wholly", name), "move one of them");
    };
    for (const Opening& o : room_.openings)
      check(o.name, extent_of(o), o.wall < 0 ? -1 : o.wall + 2);
    for (const Panel& p : room_.panels) check(p.name, extent_of(p), p.on);
  }
}

}  // namespace scenes
