#include "solver/direct_light.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/pair_factor.h"

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Vector3d;
using std::numbers::pi;

/// The sun through one opening: a prism of parallel light.
struct Beam {
  int surface = 0;  ///< the opening
  Vector3d to_sun;
  Plane opening;             ///< front: into the room
  std::vector<Plane> sides;  ///< the prism is in front of all
  Shadows shadows;           ///< of what is on the room's side of the opening
  ArrayXd normal_irradiance;
};

std::vector<Beam> beams(const scenes::Room& room, const std::vector<Blocker>& blockers) {
  std::vector<Beam> all;
  for (const scenes::Sun& sun : room.suns) {
    for (int s = 0; s < static_cast<int>(room.surfaces.size()); ++s) {
      const scenes::Surface& surface = room.surfaces[static_cast<std::size_t>(s)];
      if (surface.kind != scenes::SurfaceKind::opening) continue;
      const Facet glass = make_facet(scenes::rectangle_of(room, s));
      const Vector3d to_sun = towards_sun(sun);
      if (-glass.normal.dot(to_sun) <= 1e-9) continue;  // the sun is behind the wall
      Beam beam{.surface = s,
                .to_sun = to_sun,
                .opening = glass.plane(),
                .shadows = {in_front_of(blockers, glass.plane()), from_direction(to_sun)}};
      for (std::size_t k = 0; k < glass.vertices.size(); ++k) {
        const Vector3d& a = glass.vertices[k];
        const Vector3d edge = glass.vertices[(k + 1) % glass.vertices.size()] - a;
        const Vector3d inward = beam.to_sun.cross(edge).normalized();
        const double side = inward.dot(glass.centre - a) > 0 ? 1 : -1;
        beam.sides.push_back({side * inward, side * inward.dot(a)});
      }
      beam.normal_irradiance =
          sun.normal_irradiance.values *
          room.openings[static_cast<std::size_t>(surface.index)].transmittance.values;
      all.push_back(std::move(beam));
    }
  }
  return all;
}

/// Area times cosine of the part of a facet that a beam lights, m^2.
double lit_area_m2(const Facet& facet, const Beam& beam) {
  const double cosine = facet.normal.dot(beam.to_sun);
  if (cosine <= 1e-12) return 0;
  std::vector<Vector3d> lit = clip(facet.vertices, beam.opening);
  for (const Plane& side : beam.sides) {
    if (!lit.empty()) lit = clip(lit, side);
  }
  if (lit.empty()) return 0;
  double area_m2 = 0;
  for (std::vector<Vector3d>& part : beam.shadows.lit_parts(lit)) {
    area_m2 += make_facet(std::move(part)).area_m2;
  }
  return area_m2 * cosine;
}

/// Adds shares of a source's flux, scaled to sum to `whole`, as irradiance.
void spread(ArrayXd share, double whole, const ArrayXd& per_band, const std::vector<Facet>& facets,
            DirectLight& light) {
  const double sum = share.sum();
  if (!(sum > 0)) return;
  light.largest_scaling = std::max(light.largest_scaling, std::abs(whole / sum - 1));
  share *= whole / sum;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    light.irradiance.row(row) += share[row] / facets[i].area_m2 * per_band.transpose();
  }
}

}  // namespace

Vector3d towards_sun(const scenes::Sun& sun) {
  const double azimuth = sun.azimuth_deg * pi / 180, altitude = sun.altitude_deg * pi / 180;
  return {std::sin(azimuth) * std::cos(altitude), std::cos(azimuth) * std::cos(altitude),
          std::sin(altitude)};
}

double solid_angle(const Vector3d& point, const std::vector<Vector3d>& polygon) {
  double sum = 0;
  const Vector3d a = (polygon[0] - point).normalized();
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const Vector3d b = (polygon[k] - point).normalized(), c = (polygon[k + 1] - point).normalized();
    sum -= 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
  }
  return sum;
}

DirectLight direct_light_on_patches(const scenes::Room& room, const scenes::PatchMesh& mesh,
                                    const std::vector<Facet>& facets,
                                    const Visibility& visibility) {
  const auto n = static_cast<Eigen::Index>(facets.size());
  DirectLight light{.irradiance = Bands::Zero(n, room.grid.count)};
  for (const scenes::PointLight& lamp : room.point_lights) {
    const Shadows shadows(visibility.blockers(), from_point(lamp.at_m));
    ArrayXd angle = ArrayXd::Zero(n);
    tbb::parallel_for(std::size_t{0}, facets.size(), [&](std::size_t i) {
      const Facet& facet = facets[i];
      if (facet.plane().height_m(lamp.at_m) <= 0) return;
      for (const auto& part : shadows.lit_parts(facet.vertices)) {
        angle[static_cast<Eigen::Index>(i)] += solid_angle(lamp.at_m, part);
      }
    });
    spread(angle, 4 * pi, lamp.spectral_flux.values / (4 * pi), facets, light);
  }
  for (const Beam& beam : beams(room, visibility.blockers())) {
    ArrayXd lit = ArrayXd::Zero(n);
    double open_area_m2 = 0;  // of the opening's patches: furniture may cover a part
    tbb::parallel_for(std::size_t{0}, facets.size(), [&](std::size_t i) {
      lit[static_cast<Eigen::Index>(i)] = lit_area_m2(facets[i], beam);
    });
    for (std::size_t i = 0; i < facets.size(); ++i) {
      if (mesh.surface[i] == beam.surface) open_area_m2 += facets[i].area_m2;
    }
    spread(lit, open_area_m2 * -beam.opening.normal.dot(beam.to_sun), beam.normal_irradiance,
           facets, light);
  }
  return light;
}

ArrayXd direct_light_at_point(const scenes::Room& room, const Vector3d& point,
                              const Vector3d& normal, const Visibility& visibility) {
  ArrayXd irradiance = ArrayXd::Zero(room.grid.count);
  for (const scenes::PointLight& lamp : room.point_lights) {
    const Vector3d r = lamp.at_m - point;
    const double cosine_over_square = normal.dot(r) / std::pow(r.norm(), 3);
    if (cosine_over_square <= 0) continue;
    const Shadows shadows(visibility.blockers(), from_point(lamp.at_m));
    if (!shadows.contain(point)) {
      irradiance += lamp.spectral_flux.values / (4 * pi) * cosine_over_square;
    }
  }
  for (const Beam& beam : beams(room, visibility.blockers())) {
    const double cosine = normal.dot(beam.to_sun);
    const bool in_prism = beam.opening.height_m(point) > 0 &&
                          std::all_of(beam.sides.begin(), beam.sides.end(),
                                      [&](const Plane& side) { return side.height_m(point) >= 0; });
    if (cosine > 0 && in_prism && !beam.shadows.contain(point)) {
      irradiance += beam.normal_irradiance * cosine;
    }
  }
  return irradiance;
}

}  // namespace solver
