#include "solver/sources/area_lamps.h"

#include <span>

#include "solver/factors/pair_factor.h"

namespace solver {

using Eigen::ArrayXd;
using Eigen::Vector3d;

AreaLamps::AreaLamps(const std::vector<Facet>& facets, const std::vector<ArrayXd>& exitance,
                     const Visibility& visibility)
    : visibility_(visibility) {
  for (std::size_t f = 0; f < facets.size(); ++f) {
    if (!(exitance[f] > 0).any()) continue;
    lamps_.push_back({facets[f], exitance[f], visibility.separation(facets[f])});
    factors_.add(facets[f].vertices);
  }
  for (const Blocker& blocker : visibility.blockers()) alone_.push_back({blocker});
}

void AreaLamps::add(const Vector3d& point, const Vector3d& normal, ArrayXd& irradiance) const {
  if (lamps_.empty()) return;
  const Eigen::VectorXd whole = factors_.from(point, normal);
  SeparationMask mask;
  for (std::size_t l = 0; l < lamps_.size(); ++l) {
    const Lamp& lamp = lamps_[l];
    const double factor = whole[static_cast<Eigen::Index>(l)];
    if (factor <= 0 || lamp.facet.plane().height_m(point) <= 1e-12) continue;
    if (mask.empty()) mask = visibility_.separation(point, normal);
    const Polygons lit = lit_parts(lamp, mask, point);
    if (lit.size() == 1 && lit[0] == lamp.facet.vertices) {
      irradiance += factor * lamp.exitance;
    } else {
      for (const auto& part : lit) {
        irradiance += point_to_polygon(point, normal, part) * lamp.exitance;
      }
    }
  }
}

AreaLamps::Polygons AreaLamps::lit_parts(const Lamp& lamp, const SeparationMask& mask,
                                         const Vector3d& point) const {
  Polygons lit{lamp.facet.vertices};
  for (std::size_t b = 0; b < alone_.size() && !lit.empty(); ++b) {
    if (!Visibility::may_block(std::span(&mask[b], 1), std::span(&lamp.mask[b], 1))) continue;
    const Shadows shadow(alone_[b], from_point(point));
    Polygons left;
    for (const auto& part : lit) {
      for (auto& piece : shadow.lit_parts(part)) left.push_back(std::move(piece));
    }
    lit = std::move(left);
  }
  return lit;
}

}  // namespace solver
