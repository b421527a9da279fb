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

constexpr int kShadowRays = 1024;

/// The sun through one opening: a prism of parallel light.
struct Beam {
  int surface = 0;  ///< the opening
  Vector3d to_sun;
  Plane opening;             ///< front: into the room
  std::vector<Plane> sides;  ///< the prism is in front of all
  ArrayXd normal_irradiance;

  /// Where the line from p towards the sun leaves through the opening.
  [[nodiscard]] Vector3d exit_point(const Vector3d& p) const {
    return p - opening.height_m(p) / opening.normal.dot(to_sun) * to_sun;
  }
};

std::vector<Beam> beams(const scenes::Room& room) {
  std::vector<Beam> all;
  for (const scenes::Sun& sun : room.suns) {
    for (int s = 0; s < static_cast<int>(room.surfaces.size()); ++s) {
      const scenes::Surface& surface = room.surfaces[static_cast<std::size_t>(s)];
      if (surface.kind != scenes::SurfaceKind::opening) continue;
      const Facet glass = make_facet(scenes::rectangle_of(room, s));
      Beam beam{.surface = s, .to_sun = towards_sun(sun), .opening = glass.plane()};
      const double cosine = -glass.normal.dot(beam.to_sun);
      if (cosine <= 1e-9) continue;  // the sun is behind the wall
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
double lit_area_m2(const Facet& facet, const Beam& beam, const Visibility& visibility,
                   std::uint64_t seed) {
  const double cosine = facet.normal.dot(beam.to_sun);
  if (cosine <= 1e-12) return 0;
  std::vector<Vector3d> lit = clip(facet.vertices, beam.opening);
  for (const Plane& side : beam.sides) {
    if (!lit.empty()) lit = clip(lit, side);
  }
  if (lit.empty()) return 0;
  const Facet part = make_facet(std::move(lit));
  if (!(part.area_m2 > 0)) return 0;
  const VisibleShare open = visibility.towards(part, seed, kShadowRays, [&](const Vector3d& p) {
    return Visibility::Target{beam.exit_point(p), 1};
  });
  return part.area_m2 * cosine * open.share;
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
    ArrayXd angle = ArrayXd::Zero(n);
    tbb::parallel_for(std::size_t{0}, facets.size(), [&](std::size_t i) {
      const Facet& facet = facets[i];
      if (facet.plane().height_m(lamp.at_m) <= 0) return;
      const VisibleShare open = visibility.towards(facet, i, kShadowRays, [&](const Vector3d& p) {
        const Vector3d r = lamp.at_m - p;
        return Visibility::Target{lamp.at_m, facet.normal.dot(r) / std::pow(r.norm(), 3)};
      });
      angle[static_cast<Eigen::Index>(i)] = solid_angle(lamp.at_m, facet.vertices) * open.share;
    });
    spread(angle, 4 * pi, lamp.spectral_flux.values / (4 * pi), facets, light);
  }
  for (const Beam& beam : beams(room)) {
    ArrayXd lit = ArrayXd::Zero(n);
    double open_area_m2 = 0;  // of the opening's patches: furniture may cover a part
    tbb::parallel_for(std::size_t{0}, facets.size(), [&](std::size_t i) {
      lit[static_cast<Eigen::Index>(i)] = lit_area_m2(facets[i], beam, visibility, i);
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
    if (cosine_over_square > 0 && visibility.open_segment(point, lamp.at_m)) {
      irradiance += lamp.spectral_flux.values / (4 * pi) * cosine_over_square;
    }
  }
  for (const Beam& beam : beams(room)) {
    const double cosine = normal.dot(beam.to_sun);
    const bool in_prism = beam.opening.height_m(point) > 0 &&
                          std::all_of(beam.sides.begin(), beam.sides.end(),
                                      [&](const Plane& side) { return side.height_m(point) >= 0; });
    if (cosine > 0 && in_prism && visibility.open_segment(point, beam.exit_point(point))) {
      irradiance += beam.normal_irradiance * cosine;
    }
  }
  return irradiance;
}

}  // namespace solver
