#include "solver/sources/window_light.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "scenes/skies/sphere_integral.h"

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Vector3d;
using Quad = std::array<Vector3d, 4>;
using std::numbers::pi;

/// Points along each side of a piece of the opening; along each side of a piece of a patch.
constexpr int kPointOrder = 8, kPatchOrder = 3, kOuterOrder = 3;
/// How often a piece of the opening, or of a patch, is quartered at most.
constexpr int kMostLevels = 8, kMostPatchLevels = 4;

/// Calls add(position, area) for the points of a product Gauss rule on a piece that is no longer
/// than it is far away.
template <typename Add>
void for_points(const Quad& q, const Vector3d& from, int order, int level, const Add& add) {
  const Vector3d centre = (q[0] + q[1] + q[2] + q[3]) / 4;
  double radius_m = 0;
  for (const Vector3d& corner : q) radius_m = std::max(radius_m, (corner - centre).norm());
  if (level < kMostLevels && 2 * radius_m > (centre - from).norm()) {
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector3d &corner = q[k], &next = q[(k + 1) % 4], &before = q[(k + 3) % 4];
      for_points({corner, (corner + next) / 2, centre, (corner + before) / 2}, from, order,
                 level + 1, add);
    }
    return;
  }
  const GaussRule& rule = gauss(order);
  const auto points = static_cast<std::size_t>(order);
  for (std::size_t s = 0; s < points; ++s) {
    for (std::size_t t = 0; t < points; ++t) {
      const double u = rule.node[s], v = rule.node[t];
      const Vector3d along_u = (1 - v) * (q[1] - q[0]) + v * (q[2] - q[3]);
      const Vector3d along_v = (1 - u) * (q[3] - q[0]) + u * (q[2] - q[1]);
      add(q[0] + u * (q[1] - q[0]) + v * along_v,
          rule.weight[s] * rule.weight[t] * along_u.cross(along_v).norm());
    }
  }
}

/// A convex polygon as quadrilaterals around its first corner.
std::vector<Quad> quads_of(const std::vector<Vector3d>& polygon) {
  if (polygon.size() == 4) return {{polygon[0], polygon[1], polygon[2], polygon[3]}};
  std::vector<Quad> quads;
  for (std::size_t k = 1; k + 1 < polygon.size(); k += 2) {
    quads.push_back({polygon[0], polygon[k], polygon[k + 1],
                     k + 2 < polygon.size() ? polygon[k + 2] : polygon[0]});
  }
  return quads;
}

Plane flipped(const Plane& plane) { return {-plane.normal, -plane.offset_m}; }

}  // namespace

WindowLight::WindowLight(const scenes::Room& room, int surface, const scenes::Sky& sky,
                         std::shared_ptr<const Visibility> visibility)
    : surface_(surface), sky_(sky), visibility_(std::move(visibility)) {
  const auto index = room.surfaces[static_cast<std::size_t>(surface)].index;
  const scenes::Opening& opening = room.openings[static_cast<std::size_t>(index)];
  glass_ = opening.glass;
  transmittance_ = opening.transmittance.values;
  opening_ = make_facet(opening.outline);
  mask_ = visibility_->separation(opening_);
  const Vector3d level(-opening_.normal.x(), -opening_.normal.y(), 0);
  upright_ = level.norm() > 1e-6;
  outwards_ = upright_ ? level.normalized() : Vector3d::UnitX();
  along_ = Vector3d::UnitZ().cross(outwards_);
  opposite_ = ArrayXd::Zero(sky_.ground.size());
  if (sky_.obstruction && upright_) {
    opposite_ = sky_.obstruction->reflectance / pi *
                scenes::irradiance_outside(scenes::unscaled(sky_), -outwards_);
  }
  for (const Blocker& blocker : visibility_->blockers()) alone_.push_back({blocker});
}

double WindowLight::obstruction_rad(const Vector3d& point) const {
  const scenes::Obstruction& o = *sky_.obstruction;
  if (!o.distance_m) return o.angle_deg * pi / 180;
  const double away_m = outwards_.dot(opening_.centre - point) + *o.distance_m;
  return std::atan2(*o.top_m - point.z(), away_m);
}

WindowLight::Station WindowLight::station(const Vector3d& point, const Vector3d& normal) const {
  Station from{.point = point, .normal = normal, .horizon = {Vector3d::UnitZ(), point.z()}};
  if (!sky_.obstruction || !upright_) return from;
  const double angle = obstruction_rad(point);
  if (angle <= 0) return from;
  const Vector3d above = std::cos(angle) * Vector3d::UnitZ() - std::sin(angle) * outwards_;
  from.over_obstruction = {above, above.dot(point)};
  from.obstructed = true;
  return from;
}

std::vector<WindowLight::Polygon> WindowLight::seen_from(const Vector3d& point,
                                                         const Vector3d& normal) const {
  if (opening_.plane().height_m(point) <= 1e-12) return {};
  Polygon front = clip(opening_.vertices, {normal, normal.dot(point)});
  if (front.empty()) return {};
  std::vector<Polygon> seen{std::move(front)};
  if (alone_.empty()) return seen;
  const SeparationMask mask = visibility_->separation(point, normal);
  for (std::size_t b = 0; b < alone_.size() && !seen.empty(); ++b) {
    if (!Visibility::may_block(std::span(&mask[b], 1), std::span(&mask_[b], 1))) continue;
    const Shadows shadow(alone_[b], from_point(point));
    std::vector<Polygon> left;
    for (const Polygon& part : seen) {
      for (Polygon& piece : shadow.lit_parts(part)) left.push_back(std::move(piece));
    }
    seen = std::move(left);
  }
  return seen;
}

/// Of the light in a direction, what comes in; per distinct transmittance of the glass.
ArrayXd WindowLight::passed(const Vector3d& direction) const {
  if (!glass_) return ArrayXd::Ones(1);
  return glass_->distinct_transmittance(-opening_.normal.dot(direction));
}

void WindowLight::add_part(const Station& from, Polygon part, int order, Sums& sums) const {
  const double height_m = opening_.plane().height_m(from.point);
  const auto add_even = [&](const Polygon& piece, Eigen::VectorXd& sum) {
    for (const Quad& quad : quads_of(piece)) {
      for_points(quad, from.point, order, 0, [&](const Vector3d& position, double area_m2) {
        const Vector3d ray = position - from.point;
        const double square_m2 = ray.squaredNorm();
        const double weight = from.normal.dot(ray) * height_m / (square_m2 * square_m2) * area_m2;
        sum += weight * passed(ray / std::sqrt(square_m2)).matrix();
      });
    }
  };
  const Polygon ground = clip(part, flipped(from.horizon));
  if (!ground.empty()) add_even(ground, sums.ground);
  part = clip(part, from.horizon);
  if (from.obstructed && !part.empty()) {
    const Polygon hidden = clip(part, flipped(from.over_obstruction));
    if (!hidden.empty()) add_even(hidden, sums.opposite);
    part = clip(part, from.over_obstruction);
  }
  if (!part.empty()) add_sky(from, part, order, sums);
}

void WindowLight::add_sky(const Station& from, const Polygon& part, int order, Sums& sums) const {
  const double height_m = opening_.plane().height_m(from.point);
  const Vector3d& to_sun = sky_.pattern.to_sun;
  std::vector<Polygon> pieces{part};
  if (-opening_.normal.dot(to_sun) > 1e-6) {  // the planes through the point and the sun's image
    const Vector3d across = along_.cross(to_sun), upwards = across.cross(to_sun);
    for (const Vector3d& side : {across, upwards}) {
      const Plane cut{side.normalized(), side.normalized().dot(from.point)};
      std::vector<Polygon> halves;
      for (const Polygon& piece : pieces) {
        for (const Plane& half : {cut, flipped(cut)}) {
          if (Polygon kept = clip(piece, half); !kept.empty()) halves.push_back(std::move(kept));
        }
      }
      pieces = std::move(halves);
    }
  }
  for (const Polygon& piece : pieces) {
    for (const Quad& quad : quads_of(piece)) {
      for_points(quad, from.point, order, 0, [&](const Vector3d& position, double area_m2) {
        const Vector3d ray = position - from.point;
        const double square_m2 = ray.squaredNorm();
        const Vector3d direction = ray / std::sqrt(square_m2);
        const double weight = from.normal.dot(ray) * height_m / (square_m2 * square_m2) * area_m2;
        sums.sky += weight * scenes::component_weights(sky_, direction) *
                    passed(direction).matrix().transpose();
      });
    }
  }
}

ArrayXd WindowLight::in_bands(const Sums& sums) const {
  const auto spread = [&](const Eigen::VectorXd& distinct) -> ArrayXd {
    return glass_ ? glass_->in_bands(distinct.array()) : ArrayXd(transmittance_ * distinct[0]);
  };
  ArrayXd light =
      sky_.scale * (sky_.ground * spread(sums.ground) + opposite_ * spread(sums.opposite));
  for (Eigen::Index k = 0; k < sums.sky.rows(); ++k) {
    light += sky_.components.col(k).array() * spread(sums.sky.row(k).transpose());
  }
  return light;
}

ArrayXd WindowLight::integral(const Vector3d& point, const Vector3d& normal, int order) const {
  const std::vector<Polygon> seen = seen_from(point, normal);
  if (seen.empty()) return ArrayXd::Zero(sky_.ground.size());
  const Eigen::Index distinct = passed(-opening_.normal).size();
  Sums sums{.sky = Eigen::MatrixXd::Zero(sky_.components.cols(), distinct),
            .ground = Eigen::VectorXd::Zero(distinct),
            .opposite = Eigen::VectorXd::Zero(distinct)};
  const Station from = station(point, normal);
  for (const Polygon& part : seen) add_part(from, part, order, sums);
  return in_bands(sums);
}

ArrayXd WindowLight::at_point(const Vector3d& point, const Vector3d& normal) const {
  return integral(point, normal, kPointOrder);
}

/// To the nearest part of the opening, or a little less.
double WindowLight::distance_m(const Vector3d& point) const {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Polygon& part : parts_of(opening_.vertices)) {
    const Vector3d middle = middle_of(part);
    double radius_m = 0;
    for (const Vector3d& corner : part) radius_m = std::max(radius_m, (corner - middle).norm());
    nearest_m = std::min(nearest_m, (middle - point).norm() - radius_m);
  }
  return std::max(0.0, nearest_m);
}

void WindowLight::add_facet(const Facet& facet, const SlopeBasis* basis, const Polygon& part,
                            int level, Bands& means) const {
  const Vector3d middle = middle_of(part);
  double radius_m = 0;
  for (const Vector3d& corner : part) radius_m = std::max(radius_m, (corner - middle).norm());
  for (const Quad& q : quads_of(part)) {
    if (level < kMostPatchLevels && 2 * radius_m > distance_m(middle)) {
      const Vector3d centre = (q[0] + q[1] + q[2] + q[3]) / 4;
      for (std::size_t k = 0; k < 4; ++k) {
        const Vector3d &corner = q[k], &next = q[(k + 1) % 4], &before = q[(k + 3) % 4];
        add_facet(facet, basis, {corner, (corner + next) / 2, centre, (corner + before) / 2},
                  level + 1, means);
      }
      continue;
    }
    for_points(q, middle + 1e9 * facet.normal, kOuterOrder, 0,
               [&](const Vector3d& position, double area_m2) {
                 const BandRow light = area_m2 / facet.area_m2 *
                                       integral(position, facet.normal, kPatchOrder).transpose();
                 means.row(0) += light;
                 if (basis == nullptr) return;
                 const Eigen::Vector2d psi = basis->at(position - facet.centre);
                 means.row(1) += psi[0] * light;
                 means.row(2) += psi[1] * light;
               });
  }
}

Bands WindowLight::on_facets(const std::vector<Facet>& facets,
                             const std::vector<SlopeBasis>& bases) const {
  const auto n = static_cast<Eigen::Index>(facets.size());
  const Eigen::Index modes = bases.empty() ? 1 : SlopeBasis::kModes;
  Bands all = Bands::Zero(modes * n, sky_.ground.size());
  tbb::parallel_for(std::size_t{0}, facets.size(), [&](std::size_t i) {
    const Facet& facet = facets[i];
    if (clip(opening_.vertices, facet.plane()).empty() ||
        clip(facet.vertices, opening_.plane()).empty()) {
      return;
    }
    Bands means = Bands::Zero(SlopeBasis::kModes, all.cols());
    add_facet(facet, bases.empty() ? nullptr : &bases[i], facet.vertices, 0, means);
    for (Eigen::Index a = 0; a < modes; ++a) {
      all.row(a * n + static_cast<Eigen::Index>(i)) = means.row(a);
    }
  });
  return all;
}

ArrayXd WindowLight::entering() const {
  const Eigen::Index distinct = passed(-opening_.normal).size();
  Sums sums{.sky = Eigen::MatrixXd::Zero(sky_.components.cols(), distinct),
            .ground = Eigen::VectorXd::Zero(distinct),
            .opposite = Eigen::VectorXd::Zero(distinct)};
  const Vector3d out = -opening_.normal, up = Vector3d::UnitZ();
  for (const QuadraturePoint& at : quadrature(opening_.vertices, 4)) {
    const double share = at.weight_m2 / opening_.area_m2;
    const auto weighted = [&](const Vector3d& d, double solid_angle) -> Eigen::VectorXd {
      return share * solid_angle * out.dot(d) * passed(d).matrix();
    };
    const Station from = station(at.position, out);
    std::vector<Vector3d> sky{up, out};
    if (from.obstructed) {
      sky.push_back(from.over_obstruction.normal);
      scenes::for_directions(out, {up, out, -from.over_obstruction.normal},
                             [&](const Vector3d& d, double a) { sums.opposite += weighted(d, a); });
    }
    scenes::for_directions(out, {-up, out},
                           [&](const Vector3d& d, double a) { sums.ground += weighted(d, a); });
    scenes::for_directions(sky_.pattern.to_sun, sky, [&](const Vector3d& d, double a) {
      sums.sky += scenes::component_weights(sky_, d) * weighted(d, a).transpose();
    });
    if (!sky_.obstruction || !sky_.obstruction->distance_m) {  // alike from all points
      const double all = 1 / share;
      sums.sky *= all;
      sums.ground *= all;
      sums.opposite *= all;
      break;
    }
  }
  return in_bands(sums);
}

ArrayXd WindowLight::radiance(const Vector3d& point, const Vector3d& pane) const {
  const Vector3d direction = (pane - point).normalized();
  if (-opening_.normal.dot(direction) <= 0) return ArrayXd::Zero(sky_.ground.size());
  const Station from = station(point, direction);
  const ArrayXd outside =
      from.obstructed && direction.z() > 0 && from.over_obstruction.normal.dot(direction) <= 0
          ? ArrayXd(sky_.scale * opposite_)
          : scenes::radiance(sky_, direction);
  return glass_ ? ArrayXd(outside * glass_->transmittance(-opening_.normal.dot(direction)))
                : ArrayXd(outside * transmittance_);
}

}  // namespace solver
