#include "solver/sources/luminaire_light.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace solver {
namespace {

using Eigen::Vector3d;

constexpr int kLevels = 5, kMostForPatches = 3;
/// Parts of a luminaire as large as it is far away.
constexpr double kPartsForPatches = 5, kPartsForPoints = 10;
constexpr double kTolerance = 1e-4;  ///< of the mean illuminance of all patches
constexpr double kFlush_m = 1e-6;

}  // namespace

LuminaireSource::LuminaireSource(const scenes::PlacedLuminaire& luminaire,
                                 const std::vector<Blocker>& blockers)
    : luminaire_(luminaire), per_lumen_(luminaire.spectral_flux.values / luminaire.type->flux_lm) {
  const Vector3d& size = luminaire.type->size_m;
  if (size.z() == 0) {
    faces_.push_back({.normal = Vector3d::Zero(), .area_m2 = 1});
  } else {
    for (int k = 0; k < 6; ++k) {  // x, y, z, each to both sides
      const Vector3d axis = luminaire.axes.col(k / 2);
      faces_.push_back({.normal = k % 2 == 0 ? axis : Vector3d(-axis),
                        .area_m2 = size[(k / 2 + 1) % 3] * size[(k / 2 + 2) % 3]});
    }
  }
  std::vector<Elements> levels;
  for (int level = 0; level < (size.maxCoeff() > 0 ? kLevels : 1); ++level) {
    levels.push_back(cut(1 << level, blockers));
  }
  levels_ = std::make_shared<const std::vector<Elements>>(std::move(levels));
}

LuminaireSource::Elements LuminaireSource::cut(int longest_parts,
                                               const std::vector<Blocker>& blockers) const {
  Elements elements;
  if (longest_parts == 1) {  // the point, whatever the body
    elements.push_back(
        {.at_m = luminaire_.at_m, .face = -1, .shadows = {blockers, from_point(luminaire_.at_m)}});
    return elements;
  }
  const double part_m = luminaire_.type->size_m.maxCoeff() / longest_parts;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const int across = faces_.size() == 1 ? 2 : static_cast<int>(f / 2);
    if (faces_[f].area_m2 > 0) add_face(elements, static_cast<int>(f), across, part_m, blockers);
  }
  return elements;
}

/// Equal rectangles of one face; of a disc those whose centres lie in it.
void LuminaireSource::add_face(Elements& elements, int face, int across, double part_m,
                               const std::vector<Blocker>& blockers) const {
  const Vector3d& size = luminaire_.type->size_m;
  const int u = (across + 1) % 3, v = (across + 2) % 3;
  const auto parts = [&](int axis) {
    return std::max(1, static_cast<int>(std::ceil(size[axis] / part_m - 1e-9)));
  };
  const int along_u = parts(u), along_v = parts(v);
  std::vector<Vector3d> centres;
  for (int i = 0; i < along_u; ++i) {
    for (int j = 0; j < along_v; ++j) {
      const double s = (i + 0.5) / along_u - 0.5, t = (j + 0.5) / along_v - 0.5;
      const bool disc = luminaire_.type->shape == scenes::LuminousShape::ellipse;
      if (disc && s * s + t * t > 0.25) continue;
      Vector3d local = Vector3d::Zero();
      local[u] = s * size[u];
      local[v] = t * size[v];
      if (faces_.size() > 1) local[across] = (face % 2 == 0 ? 0.5 : -0.5) * size[across];
      centres.push_back(luminaire_.at_m + luminaire_.axes * local);
    }
  }
  for (const Vector3d& centre : centres) {
    elements.push_back({.at_m = centre,
                        .face = face,
                        .share = 1 / static_cast<double>(centres.size()),
                        .shadows = {blockers, from_point(centre)}});
  }
}

double LuminaireSource::distance_m(const Vector3d& point) const {
  const Vector3d local = luminaire_.axes.transpose() * (point - luminaire_.at_m);
  const Vector3d half = luminaire_.type->size_m / 2;
  return (local - local.cwiseMax(-half).cwiseMin(half)).norm();
}

const LuminaireSource::Elements& LuminaireSource::elements(double distance,
                                                           double parts_per_distance,
                                                           int most) const {
  const double parts = parts_per_distance * luminaire_.type->size_m.maxCoeff() / distance;
  std::size_t level = 0;
  const std::size_t last = std::min(static_cast<std::size_t>(most), levels_->size() - 1);
  while (level < last && static_cast<double>(1 << level) < parts) ++level;
  return (*levels_)[level];
}

const LuminaireSource::Elements& LuminaireSource::elements_for(
    const std::vector<Facet>& facets) const {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Facet& facet : facets) {
    if (facet.plane().height_m(luminaire_.at_m) <= kFlush_m) continue;
    nearest_m = std::min(nearest_m, distance_m(facet.centre));
    for (const Vector3d& corner : facet.vertices) {
      nearest_m = std::min(nearest_m, distance_m(corner));
    }
  }
  return elements(nearest_m, kPartsForPatches, kMostForPatches);
}

double LuminaireSource::intensity_cd(const Element& element, const Vector3d& direction) const {
  const double whole_cd = luminaire_.type->intensity.at(luminaire_.axes.transpose() * direction);
  if (element.face < 0 || faces_.size() == 1) return whole_cd * element.share;
  double shown = 0, all = 0;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const double area = faces_[f].area_m2 * std::max(0.0, faces_[f].normal.dot(direction));
    all += area;
    if (static_cast<int>(f) == element.face) shown = area;
  }
  return all > 0 ? whole_cd * element.share * shown / all : 0;
}

std::vector<Vector3d> LuminaireSource::on_facets(const std::vector<Facet>& facets,
                                                 const std::vector<SlopeBasis>& bases) const {
  const scenes::IntensityTable& table = luminaire_.type->intensity;
  double area_m2 = 0;
  for (const Facet& facet : facets) area_m2 += facet.area_m2;
  const Elements& elements = elements_for(facets);
  // Errors of many elements cancel: each may have more of its own light.
  const double tolerance = kTolerance * luminaire_.type->flux_lm / area_m2 /
                           std::sqrt(static_cast<double>(elements.size()));
  std::vector<Vector3d> flux(facets.size(), Vector3d::Zero());
  tbb::parallel_for(std::size_t{0}, facets.size(), [&](std::size_t i) {
    const Facet& facet = facets[i];
    for (const Element& element : elements) {
      if (facet.plane().height_m(element.at_m) <= kFlush_m) continue;
      const Intensity intensity{.at = [&](const Vector3d& d) { return intensity_cd(element, d); },
                                .most_within =
                                    [&](const Vector3d& d, double radius_rad) {
                                      return element.share *
                                             table.most_within(luminaire_.axes.transpose() * d,
                                                               radius_rad);
                                    },
                                .finest_rad = table.finest_step_deg() * std::numbers::pi / 180};
      for (const auto& part : element.shadows.lit_parts(facet.vertices)) {
        flux[i] += lit_flux(part, facet, bases.empty() ? nullptr : &bases[i], element.at_m,
                            intensity, tolerance);
      }
    }
  });
  return flux;
}

double LuminaireSource::flux_lm(const std::vector<Facet>& facets, double arriving_lm) const {
  for (const Element& element : elements_for(facets)) {
    for (const Facet& facet : facets) {
      const bool flush = std::abs(facet.plane().height_m(element.at_m)) <= kFlush_m &&
                         contains(facet.vertices, facet.normal, element.at_m);
      if (flush) return arriving_lm;
    }
  }
  return luminaire_.type->flux_lm;
}

double LuminaireSource::at_point(const Vector3d& point, const Vector3d& normal) const {
  const double distance = distance_m(point);
  if (!(distance > 0)) return 0;
  double illuminance = 0;
  for (const Element& element : elements(distance, kPartsForPoints, kLevels)) {
    const Vector3d ray = point - element.at_m;
    const double cosine_over_square = -normal.dot(ray) / std::pow(ray.norm(), 3);
    if (cosine_over_square > 0 && !element.shadows.contain(point)) {
      illuminance += intensity_cd(element, ray) * cosine_over_square;
    }
  }
  return illuminance;
}

}  // namespace solver
