#include "scenes/room.h"

#include <algorithm>

namespace scenes {
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
    } else if (light.sky >= 0) {
      lit.skies[static_cast<std::size_t>(light.sky)].scale *= scale;
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

}  // namespace scenes
