#include "solver/sources/direct_light.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/factors/pair_factor.h"

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Vector3d;
using std::numbers::pi;

std::vector<SunBeam> beams(const scenes::Room& room, const std::vector<Blocker>& blockers) {
  std::vector<SunBeam> all;
  for (const scenes::Sun& sun : room.suns) {
    for (int s = 0; s < static_cast<int>(room.surfaces.size()); ++s) {
      const scenes::Surface& surface = room.surfaces[static_cast<std::size_t>(s)];
      if (surface.kind != scenes::SurfaceKind::opening) continue;
      const Facet glass = make_facet(scenes::rectangle_of(room, s));
      const Vector3d to_sun = towards_sun(sun);
      if (-glass.normal.dot(to_sun) <= 1e-9) continue;  // the sun is behind the wall
      SunBeam beam{.surface = s,
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
double lit_area_m2(const Facet& facet, const SunBeam& beam) {
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
  light.scaling.push_back(sum > 0 ? whole / sum : 1);
  share *= light.scaling.back();
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

DirectSources::DirectSources(const scenes::Room& room, const Visibility& visibility)
    : bands_(room.grid.count), beams_(beams(room, visibility.blockers())) {
  for (const scenes::PointLight& lamp : room.point_lights) {
    lamps_.push_back({.at_m = lamp.at_m,
                      .intensity = lamp.spectral_flux.values / (4 * pi),
                      .shadows = {visibility.blockers(), from_point(lamp.at_m)}});
  }
}

double DirectLight::largest_scaling() const {
  double largest = 0;
  for (const double scale : scaling) largest = std::max(largest, std::abs(scale - 1));
  return largest;
}

DirectSources DirectSources::scaled(const std::vector<double>& by) const {
  DirectSources sources = *this;
  std::size_t k = 0;
  for (PointSource& lamp : sources.lamps_) lamp.intensity *= by.at(k++);
  for (SunBeam& beam : sources.beams_) beam.normal_irradiance *= by.at(k++);
  return sources;
}

DirectLight DirectSources::on_patches(const scenes::PatchMesh& mesh,
                                      const std::vector<Facet>& facets) const {
  const auto n = static_cast<Eigen::Index>(facets.size());
  DirectLight light{.irradiance = Bands::Zero(n, bands_)};
  for (const PointSource& lamp : lamps_) {
    ArrayXd angle = ArrayXd::Zero(n);
    tbb::parallel_for(std::size_t{0}, facets.size(), [&](std::size_t i) {
      if (facets[i].plane().height_m(lamp.at_m) <= 0) return;
      for (const auto& part : lamp.shadows.lit_parts(facets[i].vertices)) {
        // All parts show their front. A silhouette that nearly lies in an edge leaves slivers as
        // thin as rounding, of either sign.
        angle[static_cast<Eigen::Index>(i)] += std::max(0.0, solid_angle(lamp.at_m, part));
      }
    });
    spread(angle, 4 * pi, lamp.intensity, facets, light);
  }
  for (const SunBeam& beam : beams_) {
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

ArrayXd DirectSources::at_point(const Vector3d& point, const Vector3d& normal) const {
  ArrayXd irradiance = ArrayXd::Zero(bands_);
  for (const PointSource& lamp : lamps_) {
    const Vector3d r = lamp.at_m - point;
    const double cosine_over_square = normal.dot(r) / std::pow(r.norm(), 3);
    if (cosine_over_square > 0 && !lamp.shadows.contain(point)) {
      irradiance += lamp.intensity * cosine_over_square;
    }
  }
  for (const SunBeam& beam : beams_) {
    const double cosine = normal.dot(beam.to_sun);
    const bool in_prism =
        beam.opening.height_m(point) > 0 &&
        std::ranges::all_of(beam.sides, [&](const Plane& p) { return p.height_m(point) >= 0; });
    if (cosine > 0 && in_prism && !beam.shadows.contain(point)) {
      irradiance += beam.normal_irradiance * cosine;
    }
  }
  return irradiance;
}

}  // namespace solver
