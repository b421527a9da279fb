// The reflectances of a room file, and the list of surfaces.
#include <fmt/format.h>

#include "scenes/files/room_reader.h"

namespace scenes {

using spectra::JsonNode;
using spectra::JsonObject;

void RoomReader::read_surfaces() {
  for (const auto& [name, kind] : shell_surfaces_) add_surface(name, kind);
  for (std::size_t i = 0; i < room_.openings.size(); ++i) {
    add_surface(room_.openings[i].name, SurfaceKind::opening, i);
  }
  for (std::size_t i = 0; i < room_.panels.size(); ++i) {
    add_surface(room_.panels[i].name, SurfaceKind::panel, i);
  }
  for (std::size_t i = 0; i < room_.furniture.size(); ++i) {
    const std::string& name = room_.furniture[i].name;
    const auto materials = materials_.find(name);
    if (materials == materials_.end()) {
      add_surface(name, SurfaceKind::furniture, i);
      continue;
    }
    for (std::size_t part = 0; part < materials->second.size(); ++part) {
      add_surface(name + "." + materials->second[part], SurfaceKind::furniture, i);
      room_.surfaces.back().part = static_cast<int>(part);
    }
  }

  const auto node = top_.need("surfaces");
  if (!node) return;
  std::vector<std::string> known{"walls"};
  for (const Surface& s : room_.surfaces) {
    if (s.kind != SurfaceKind::panel && !s.name.empty()) known.push_back(s.name);
  }
  for (const auto& [mesh, materials] : materials_) known.push_back(mesh);
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
  } else if (surface.kind == SurfaceKind::furniture) {
    const auto all = given.find(room_.furniture[index].name);
    if (all) chosen = curves_.reflectance(*all);
  }
  // What is outside is dark but for its light, and what falls onto a pane comes back in part.
  if (surface.kind == SurfaceKind::opening && !chosen && !room_.skies.empty()) {
    chosen = Reflectance{.spectrum = curves_.zero()};
    if (const auto& glass = room_.openings[index].glass) {
      chosen->spectrum.values = glass->diffuse_reflectance();
    }
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

}  // namespace scenes
