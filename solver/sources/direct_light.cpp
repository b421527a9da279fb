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
      const scenes::Opening& opening = room.openings[static_cast<std::size_t>(surface.index)];
      const Facet glass = make_facet(opening.outline);
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
          (opening.glass ? opening.glass->transmittance(-glass.normal.dot(to_sun))
                         : opening.transmittance.values);
      all.push_back(std::move(beam));
    }
  }
  return all;
}

/// Of skies that shine.
std::vector<WindowLight> windows(const scenes::Room& room, const Visibility& visibility) {
  std::vector<WindowLight> all;
  std::shared_ptr<const Visibility> shared;
  for (const scenes::Sky& sky : room.skies) {
    if (!(sky.scale > 0) || !(sky.cd_m2 > 0)) continue;
    if (!shared) shared = std::make_shared<const Visibility>(visibility);
    for (int s = 0; s < static_cast<int>(room.surfaces.size()); ++s) {
      if (room.surfaces[static_cast<std::size_t>(s)].kind == scenes::SurfaceKind::opening) {
        all.emplace_back(room, s, sky, shared);
      }
    }
  }
  return all;
}

/// Adds a sky's light through a window, scaled in each band to what comes in.
void add_skylight(const WindowLight& window, const scenes::PatchMesh& mesh,
                  const std::vector<Facet>& facets, const std::vector<SlopeBasis>& bases,
                  DirectLight& light) {
  const auto n = static_cast<Eigen::Index>(facets.size());
  Bands arriving = window.on_facets(facets, bases);
  double open_area_m2 = 0;  // of the opening's patches: furniture may cover a part
  BandRow sum = BandRow::Zero(arriving.cols());
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto patch = static_cast<std::size_t>(i);
    if (mesh.surface[patch] == window.surface()) open_area_m2 += facets[patch].area_m2;
    sum += facets[patch].area_m2 * arriving.row(i);
  }
  const BandRow whole = open_area_m2 * window.entering().transpose();
  const BandRow scaling = (sum > 0).select(whole / sum, BandRow::Ones(sum.size()));
  arriving.rowwise() *= scaling;
  light.irradiance += arriving;
  light.scaling.push_back(sum.sum() > 0 ? whole.sum() / sum.sum() : 1);
}

/// What a source sends to a patch, of its own measure of flux: in all, and with psi_1 and psi_2.
using Share = Eigen::Vector3d;

/// What a beam reaches of a polygon.
std::vector<std::vector<Vector3d>> lit_parts(std::vector<Vector3d> polygon, const SunBeam& beam) {
  polygon = clip(polygon, beam.opening);
  for (const Plane& side : beam.sides) {
    if (!polygon.empty()) polygon = clip(polygon, side);
  }
  if (polygon.empty()) return {};
  return beam.shadows.lit_parts(polygon);
}

/// Area times cosine of the part of a facet that a beam lights, m^2.
Share lit_area_m2(const Facet& facet, const SlopeBasis* basis, const SunBeam& beam) {
  Share share = Share::Zero();
  const double cosine = facet.normal.dot(beam.to_sun);
  if (cosine <= 1e-12) return share;
  for (std::vector<Vector3d>& vertices : lit_parts(facet.vertices, beam)) {
    const Facet part = make_facet(std::move(vertices));
    share[0] += part.area_m2;
    if (basis != nullptr && part.area_m2 > 0) {
      share.tail<2>() += part.area_m2 * basis->at(part.centre - facet.centre);
    }
  }
  return share * cosine;
}

/// Solid angle of what a lamp lights of a facet, sr.
Share lit_angle(const Facet& facet, const SlopeBasis* basis, const PointSource& lamp) {
  Share share = Share::Zero();
  if (facet.plane().height_m(lamp.at_m) <= 0) return share;
  for (const auto& part : lamp.shadows.lit_parts(facet.vertices)) {
    // All parts show their front. A silhouette that nearly lies in an edge leaves slivers as
    // thin as rounding, of either sign.
    const double angle = solid_angle(lamp.at_m, part);
    if (!(angle > 0)) continue;
    share[0] += angle;
    if (basis == nullptr) continue;
    const Vector3d moment = solid_angle_moment(lamp.at_m, part, facet.normal);
    share.tail<2>() += basis->at(moment + angle * (lamp.at_m - facet.centre));
  }
  return share;
}

/// Adds shares of a source's flux, scaled to sum to `whole`, as irradiance.
void spread(const std::vector<Share>& shares, double whole, const ArrayXd& per_band,
            const std::vector<Facet>& facets, DirectLight& light) {
  const auto n = static_cast<Eigen::Index>(facets.size());
  ArrayXd in_all(n);
  for (Eigen::Index i = 0; i < n; ++i) in_all[i] = shares[static_cast<std::size_t>(i)][0];
  const double sum = in_all.sum();
  light.scaling.push_back(sum > 0 ? whole / sum : 1);
  for (std::size_t i = 0; i < facets.size(); ++i) {
    const Share scaled = light.scaling.back() * shares[i];
    for (Eigen::Index row = static_cast<Eigen::Index>(i), a = 0; row < light.irradiance.rows();
         row += n, ++a) {
      light.irradiance.row(row) += scaled[a] / facets[i].area_m2 * per_band.transpose();
    }
  }
}

/// As if nothing stood in the way.
ArrayXd lamp_light(const PointSource& lamp, const Vector3d& point, const Vector3d& normal) {
  const Vector3d r = lamp.at_m - point;
  return lamp.intensity * (std::max(0.0, normal.dot(r)) / std::pow(r.norm(), 3));
}

bool lights(const SunBeam& beam, const Vector3d& point) {
  return beam.opening.height_m(point) > 0 &&
         std::ranges::all_of(beam.sides, [&](const Plane& p) { return p.height_m(point) >= 0; }) &&
         !beam.shadows.contain(point);
}

/// Adds the mean of a source's light over a polygon: `lit` says whether the source reaches a point,
/// `parts` gives what it reaches of the polygon, `light` is its irradiance where it does.
template <typename Lit, typename Parts, typename Light>
void add_over(const std::vector<Vector3d>& polygon, const Vector3d& middle, const Lit& lit,
              const Parts& parts, const Light& light, ArrayXd& sum) {
  const auto corners = static_cast<std::size_t>(std::ranges::count_if(polygon, lit));
  if (corners == polygon.size()) {
    sum += light(middle);
  } else if (corners > 0) {
    const double whole_m2 = make_facet(polygon).area_m2;
    for (std::vector<Vector3d>& vertices : parts(polygon)) {
      const Facet part = make_facet(std::move(vertices));
      if (part.area_m2 > 0) sum += part.area_m2 / whole_m2 * light(part.centre);
    }
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

/// With h the point's height over the plane, (x - foot) h / r^3 = -h grad(1 / r).
Vector3d solid_angle_moment(const Vector3d& point, const std::vector<Vector3d>& polygon,
                            const Vector3d& normal) {
  const double height_m = normal.dot(point - polygon[0]);
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector3d r = polygon[k] - point, edge = polygon[(k + 1) % polygon.size()] - polygon[k];
    const double length_m = edge.norm();
    if (!(length_m > 0)) continue;
    const Vector3d along = edge / length_m;
    const double from = along.dot(r), distance_m = (r - from * along).norm();
    const double inverse_r = std::asinh((from + length_m) / distance_m) -
                             std::asinh(from / distance_m);  // integral of 1 / r along the edge
    sum -= height_m * inverse_r * along.cross(normal);
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
  for (const scenes::PlacedLuminaire& luminaire : room.luminaires) {
    luminaires_.emplace_back(luminaire, visibility.blockers());
  }
  windows_ = windows(room, visibility);
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
  for (LuminaireSource& luminaire : sources.luminaires_) luminaire.scale(by.at(k++));
  for (WindowLight& window : sources.windows_) window.scale(by.at(k++));
  return sources;
}

DirectLight DirectSources::on_patches(const scenes::PatchMesh& mesh,
                                      const std::vector<Facet>& facets,
                                      const std::vector<SlopeBasis>& bases) const {
  const auto n = static_cast<Eigen::Index>(facets.size());
  const int modes = bases.empty() ? 1 : SlopeBasis::kModes;
  DirectLight light{.irradiance = Bands::Zero(modes * n, bands_)};
  const auto of_each = [&](const auto& share) {
    std::vector<Share> shares(facets.size());
    tbb::parallel_for(std::size_t{0}, facets.size(), [&](std::size_t i) {
      shares[i] = share(facets[i], bases.empty() ? nullptr : &bases[i]);
    });
    return shares;
  };
  for (const PointSource& lamp : lamps_) {
    const auto angles =
        of_each([&](const Facet& f, const SlopeBasis* basis) { return lit_angle(f, basis, lamp); });
    spread(angles, 4 * pi, lamp.intensity, facets, light);
  }
  for (const SunBeam& beam : beams_) {
    double open_area_m2 = 0;  // of the opening's patches: furniture may cover a part
    for (std::size_t i = 0; i < facets.size(); ++i) {
      if (mesh.surface[i] == beam.surface) open_area_m2 += facets[i].area_m2;
    }
    const auto areas = of_each(
        [&](const Facet& f, const SlopeBasis* basis) { return lit_area_m2(f, basis, beam); });
    spread(areas, open_area_m2 * -beam.opening.normal.dot(beam.to_sun), beam.normal_irradiance,
           facets, light);
  }
  for (const LuminaireSource& luminaire : luminaires_) {
    const std::vector<Share> flux = luminaire.on_facets(facets, bases);
    double arriving_lm = 0;
    for (const Share& share : flux) arriving_lm += share[0];
    spread(flux, luminaire.flux_lm(facets, arriving_lm), luminaire.per_lumen(), facets, light);
  }
  for (const WindowLight& window : windows_) add_skylight(window, mesh, facets, bases, light);
  return light;
}

ArrayXd DirectSources::skylight_at(const Vector3d& point, const Vector3d& normal) const {
  ArrayXd irradiance = ArrayXd::Zero(bands_);
  for (const WindowLight& window : windows_) irradiance += window.at_point(point, normal);
  return irradiance;
}

ArrayXd DirectSources::radiance(const Vector3d& point, const Vector3d& pane, int surface) const {
  ArrayXd radiance = ArrayXd::Zero(bands_);
  for (const WindowLight& window : windows_) {
    if (window.surface() == surface) radiance += window.radiance(point, pane);
  }
  return radiance;
}

ArrayXd DirectSources::at_point(const Vector3d& point, const Vector3d& normal) const {
  return sharp_at(point, normal) + skylight_at(point, normal);
}

ArrayXd DirectSources::sharp_at(const Vector3d& point, const Vector3d& normal) const {
  ArrayXd irradiance = ArrayXd::Zero(bands_);
  for (const PointSource& lamp : lamps_) {
    if (!lamp.shadows.contain(point)) irradiance += lamp_light(lamp, point, normal);
  }
  for (const SunBeam& beam : beams_) {
    const double cosine = normal.dot(beam.to_sun);
    if (cosine > 0 && lights(beam, point)) irradiance += beam.normal_irradiance * cosine;
  }
  for (const LuminaireSource& luminaire : luminaires_) {
    irradiance += luminaire.per_lumen() * luminaire.at_point(point, normal);
  }
  return irradiance;
}

ArrayXd DirectSources::over(const std::vector<Vector3d>& polygon, const Vector3d& middle,
                            const Vector3d& normal) const {
  ArrayXd irradiance = ArrayXd::Zero(bands_);
  for (const PointSource& lamp : lamps_) {
    add_over(
        polygon, middle, [&](const Vector3d& p) { return !lamp.shadows.contain(p); },
        [&](const auto& whole) { return lamp.shadows.lit_parts(whole); },
        [&](const Vector3d& p) { return lamp_light(lamp, p, normal); }, irradiance);
  }
  for (const SunBeam& beam : beams_) {
    const double cosine = normal.dot(beam.to_sun);
    if (cosine <= 0) continue;
    add_over(
        polygon, middle, [&](const Vector3d& p) { return lights(beam, p); },
        [&](const auto& whole) { return lit_parts(whole, beam); },
        [&](const Vector3d&) { return beam.normal_irradiance * cosine; }, irradiance);
  }
  for (const LuminaireSource& luminaire : luminaires_) {
    irradiance += luminaire.per_lumen() * luminaire.at_point(middle, normal);
  }
  return irradiance;
}

}  // namespace solver
