#include "solver/rooms/ambient_term.h"

#include <cmath>

#include "solver/exchange/exchange.h"
#include "solver/factors/pair_factor.h"
#include "solver/rooms/room_faces.h"
#include "solver/sources/direct_light.h"

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::Vector3d;

constexpr int kSides = 6;
using SideWeights = Eigen::Array<double, kSides, 1>;

/// Shares of an element in the sides; they sum to 1.
SideWeights side_weights(const Vector3d& normal) {
  SideWeights weights = SideWeights::Zero();
  for (Index axis = 0; axis < 3; ++axis) {
    weights[2 * axis + (normal[axis] < 0 ? 1 : 0)] = normal[axis] * normal[axis];
  }
  return weights;
}

/// Exchange areas of the box with these side areas, closed.
ExchangeAreas box_exchange(const SideWeights& area_m2) {
  Vector3d side;  // mean areas of opposite sides
  for (Index axis = 0; axis < 3; ++axis) {
    side[axis] = (area_m2[2 * axis] + area_m2[2 * axis + 1]) / 2;
  }
  const Vector3d edge_m = std::sqrt(side.prod()) * side.cwiseInverse();
  Eigen::MatrixXd exchange = Eigen::MatrixXd::Zero(kSides, kSides);
  for (Index i = 0; i < kSides; ++i) {
    for (Index j = i + 1; j < kSides; ++j) {
      const Index a = i / 2, b = j / 2;
      const Index c = a == b ? (a + 1) % 3 : 3 - a - b, d = 3 - a - c;
      const Span along_c{0, edge_m[c]};
      const double value =
          a == b ? parallel_rectangles({0, edge_m[d]}, along_c, {0, edge_m[d]}, along_c, edge_m[a])
                 : perpendicular_rectangles({0, edge_m[b]}, along_c, {0, edge_m[a]}, along_c);
      exchange(i, j) = exchange(j, i) = value;
    }
  }
  return close_exchange(exchange, area_m2);
}

const scenes::Surface& surface_of(const scenes::Room& room, const scenes::PatchMesh& faces,
                                  std::size_t face) {
  return room.surfaces[static_cast<std::size_t>(faces.surface[face])];
}

/// Adds the light of lamps, each scaled to its flux.
void add_lamps(const scenes::Room& room, const std::vector<Facet>& facets, AmbientTerm& term) {
  for (std::size_t l = 0; l < facets.size(); ++l) {
    const ArrayXd& exitance = surface_of(room, term.faces, l).exitance.values;
    if (!(exitance > 0).any()) continue;
    ArrayXd reached_m2 = ArrayXd::Zero(term.faces.size());
    for (std::size_t f = 0; f < facets.size(); ++f) {
      if (f != l) reached_m2[static_cast<Index>(f)] = exchange_area(facets[l], facets[f]);
    }
    const double scaling = facets[l].area_m2 / reached_m2.sum();
    term.lamp_scaling[static_cast<Index>(l)] = scaling;
    for (std::size_t f = 0; f < facets.size(); ++f) {
      const auto row = static_cast<Index>(f);
      term.direct.row(row) += scaling * reached_m2[row] / facets[f].area_m2 * exitance.transpose();
    }
  }
}

/// Interreflection between the sides, which the direct light sets off.
Bands sides_irradiance(const scenes::Room& room, const AmbientTerm& term) {
  const Index bands = term.direct.cols();
  SideWeights area_m2 = SideWeights::Zero();
  Bands reflectance = Bands::Zero(kSides, bands), emission = reflectance;
  for (std::size_t f = 0; f < term.faces.polygon.size(); ++f) {
    const SideWeights counts = term.faces.area_m2[f] * side_weights(term.faces.normal[f]);
    const ArrayXd& rho = surface_of(room, term.faces, f).reflectance.values;
    const ArrayXd reflected = rho * term.direct.row(static_cast<Index>(f)).transpose();
    area_m2 += counts;
    reflectance += (counts.matrix() * rho.matrix().transpose()).array();
    emission += (counts.matrix() * reflected.matrix().transpose()).array();
  }
  reflectance.colwise() /= area_m2;
  emission.colwise() /= area_m2;
  return solve_radiosity(box_exchange(area_m2), emission, Bands::Zero(kSides, bands), reflectance,
                         {.method = Method::direct})
      .irradiance;
}

}  // namespace

Bands AmbientTerm::irradiance() const {
  Bands h = direct;
  for (std::size_t f = 0; f < faces.polygon.size(); ++f) {
    h.row(static_cast<Index>(f)) +=
        (side_weights(faces.normal[f]).matrix().transpose() * indirect.matrix()).array();
  }
  return h;
}

AmbientTerm solve_ambient_term(const scenes::Room& room) {
  const DirectSources sources(room, Visibility());  // nothing hides
  AmbientTerm term{.faces = whole_mesh(room), .sources = sources};
  const std::vector<Facet> facets = facets_of(term.faces);
  term.direct = Bands::Zero(term.faces.size(), room.grid.count);
  term.lamp_scaling = ArrayXd::Zero(term.faces.size());
  add_lamps(room, facets, term);
  const DirectLight light = sources.on_patches(term.faces, facets);
  term.direct += light.irradiance;
  term.sources = sources.scaled(light.scaling);
  term.indirect = sides_irradiance(room, term);
  return term;
}

Bands extended_ambient_term(const scenes::Room& room, const std::vector<scenes::Receiver>& at) {
  const AmbientTerm term = solve_ambient_term(room);
  Bands irradiance(static_cast<Index>(at.size()), room.grid.count);
  for (std::size_t k = 0; k < at.size(); ++k) {
    const Vector3d &point = at[k].at_m, normal = at[k].normal.normalized();
    ArrayXd h =
        (side_weights(normal).matrix().transpose() * term.indirect.matrix()).transpose().array();
    for (std::size_t f = 0; f < term.faces.polygon.size(); ++f) {
      const double scaling = term.lamp_scaling[static_cast<Index>(f)];
      const bool in_front = term.faces.normal[f].dot(point - term.faces.centre[f]) > 1e-12;
      if (scaling == 0 || !in_front) continue;
      h += scaling * point_to_polygon(point, normal, term.faces.polygon[f]) *
           surface_of(room, term.faces, f).exitance.values;
    }
    h += term.sources.at_point(point, normal);
    irradiance.row(static_cast<Index>(k)) = h.transpose();
  }
  return irradiance;
}

}  // namespace solver
