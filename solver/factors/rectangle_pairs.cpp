#include "solver/factors/rectangle_pairs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

// Highway compiles this file once per instruction set and picks at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solver/factors/rectangle_pairs.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Needs the target that foreach_target.h has chosen.
#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();

namespace solver::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;

/// Four ends of edges against each other: + - - +, the signs of the corner sums.
struct Four {
  V v[4];
};

HWY_INLINE V alternating(V a, V b, V c, V d) { return hn::Add(hn::Sub(a, b), hn::Sub(d, c)); }

/// log of v0 v3 / (v1 v2)
HWY_INLINE V log_ratio(D d, V v0, V v1, V v2, V v3) {
  return hn::Log(d, hn::Div(hn::Mul(v0, v3), hn::Mul(v1, v2)));
}

HWY_INLINE V load(D d, const RectangleBatch::Values& values, std::size_t k) {
  return hn::LoadU(d, values.data() + k);
}

/// Two ends minus two others.
HWY_INLINE Four differences(D d, const RectangleBatch::Values* ends,
                            const RectangleBatch::Values* others, std::size_t k) {
  const V a0 = load(d, ends[0], k), a1 = load(d, ends[1], k);
  const V b0 = load(d, others[0], k), b1 = load(d, others[1], k);
  return {{hn::Sub(a0, b0), hn::Sub(a0, b1), hn::Sub(a1, b0), hn::Sub(a1, b1)}};
}

/// sum_j +-v_j a atan(v_j / a), a > 0
HWY_INLINE V angle_terms(D d, const Four& v, V a) {
  const V inverse = hn::Div(hn::Set(d, 1.0), a);
  V term[4];
  for (int k = 0; k < 4; ++k) {
    term[k] = hn::Mul(v.v[k], hn::Atan(d, hn::Mul(v.v[k], inverse)));
  }
  return hn::Mul(a, alternating(term[0], term[1], term[2], term[3]));
}

/// G = [v a atan(v/a) + u b atan(u/b) - z^2/2 ln(u^2 + v^2 + z^2)] / 2pi, a^2 = u^2 + z^2, b^2 =
/// v^2 + z^2. The factor of the logarithms is common, so that one of their product is enough.
void parallel(const RectangleBatch::Values* edges, std::size_t size, double* exchange_area_m2) {
  const D d;
  for (std::size_t k = 0; k < size; k += hn::Lanes(d)) {
    const Four u = differences(d, edges, edges + 4, k), v = differences(d, edges + 2, edges + 6, k);
    const V z = load(d, edges[8], k), z2 = hn::Mul(z, z);
    V along_v[4], along_u[4], ratio[4];
    for (int m = 0; m < 4; ++m) {
      const V a2 = hn::MulAdd(u.v[m], u.v[m], z2), b2 = hn::MulAdd(v.v[m], v.v[m], z2);
      along_v[m] = angle_terms(d, v, hn::Sqrt(a2));
      along_u[m] = angle_terms(d, u, hn::Sqrt(b2));
      V r2[4];
      for (int n = 0; n < 4; ++n) r2[n] = hn::MulAdd(v.v[n], v.v[n], a2);
      ratio[m] = hn::Div(hn::Mul(r2[0], r2[3]), hn::Mul(r2[1], r2[2]));
    }
    const V angles = hn::Add(alternating(along_v[0], along_v[1], along_v[2], along_v[3]),
                             alternating(along_u[0], along_u[1], along_u[2], along_u[3]));
    const V logarithm = log_ratio(d, ratio[0], ratio[1], ratio[2], ratio[3]);
    const V sum = hn::NegMulAdd(hn::Mul(z2, hn::Set(d, 0.5)), logarithm, angles);
    hn::StoreU(hn::Mul(sum, hn::Set(d, 0.5 * std::numbers::inv_pi)), d, exchange_area_m2 + k);
  }
}

/// G = [d c atan(d/c) - (c^2 - d^2)/4 ln(c^2 + d^2)] / 2pi, c^2 = x^2 + xi^2. Where c or d is 0 its
/// terms vanish; what keeps their logarithms finite does not matter.
void perpendicular(const RectangleBatch::Values* edges, std::size_t size,
                   double* exchange_area_m2) {
  const D d;
  const V tiny = hn::Set(d, 1e-100);
  for (std::size_t k = 0; k < size; k += hn::Lanes(d)) {
    const Four along = differences(d, edges + 2, edges + 6, k);
    V angle[4], c2_log[4], d2_log[4], r2[4][4];
    for (std::size_t m = 0; m < 4; ++m) {
      const V x = load(d, edges[m / 2], k);
      const V xi = load(d, edges[4 + m % 2], k);
      const V c2 = hn::MulAdd(x, x, hn::Mul(xi, xi));
      angle[m] = angle_terms(d, along, hn::Max(hn::Sqrt(c2), tiny));
      for (std::size_t n = 0; n < 4; ++n) {
        r2[m][n] = hn::Max(hn::MulAdd(along.v[n], along.v[n], c2), tiny);
      }
      c2_log[m] = hn::Mul(c2, log_ratio(d, r2[m][0], r2[m][1], r2[m][2], r2[m][3]));
    }
    for (std::size_t n = 0; n < 4; ++n) {
      d2_log[n] = hn::Mul(hn::Mul(along.v[n], along.v[n]),
                          log_ratio(d, r2[0][n], r2[1][n], r2[2][n], r2[3][n]));
    }
    const V logarithms = hn::Sub(alternating(c2_log[0], c2_log[1], c2_log[2], c2_log[3]),
                                 alternating(d2_log[0], d2_log[1], d2_log[2], d2_log[3]));
    const V sum = hn::NegMulAdd(logarithms, hn::Set(d, 0.25),
                                alternating(angle[0], angle[1], angle[2], angle[3]));
    hn::StoreU(hn::Mul(sum, hn::Set(d, 0.5 * std::numbers::inv_pi)), d, exchange_area_m2 + k);
  }
}

}  // namespace solver::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace solver {
namespace {

using Eigen::Vector3d;

HWY_EXPORT(parallel);
HWY_EXPORT(perpendicular);

/// Which of two perpendicular unit vectors an edge lies along: 0, 1, or neither.
std::optional<std::size_t> axis_along(const Vector3d& edge, const Vector3d& first,
                                      const Vector3d& second) {
  constexpr double kAligned = 1e-12;
  if (std::abs(edge.dot(second)) < kAligned) return 0;
  if (std::abs(edge.dot(first)) < kAligned) return 1;
  return {};
}

Span around(double centre, double half) { return {centre - half, centre + half}; }

Span in_front(Span s) { return {std::max(s.from, 0.0), std::max(s.to, 0.0)}; }

}  // namespace

std::optional<AxedRectangle> rectangle_of(const Facet& f) {
  if (!f.rectangle) return {};
  const Vector3d first = f.vertices[1] - f.vertices[0], second = f.vertices[2] - f.vertices[1];
  return AxedRectangle{.centre = f.centre,
                       .normal = f.normal,
                       .along = first.normalized(),
                       .half_edge_m = {first.norm() / 2, second.norm() / 2}};
}

std::optional<RectanglePair> aligned(const AxedRectangle& i, const AxedRectangle& j) {
  const double cosine = i.normal.dot(j.normal);
  const Vector3d r = j.centre - i.centre;
  if (cosine < -1 + 1e-14) {
    const Vector3d across = i.normal.cross(i.along);
    const auto turn = axis_along(j.along, i.along, across);
    if (!turn) return {};
    return RectanglePair{.planes = Planes::parallel,
                         .x = around(0, i.half_edge_m[0]),
                         .y = around(0, i.half_edge_m[1]),
                         .xi = around(r.dot(i.along), j.half_edge_m[*turn]),
                         .eta = around(r.dot(across), j.half_edge_m[1 - *turn]),
                         .gap_m = r.dot(i.normal)};
  }
  if (std::abs(cosine) > 1e-13) return {};
  // From the line where the planes meet, i extends along j's normal and j along i's.
  const Vector3d line = i.normal.cross(j.normal);
  const auto turn_i = axis_along(i.along, j.normal, line),
             turn_j = axis_along(j.along, i.normal, line);
  if (!turn_i || !turn_j) return {};
  return RectanglePair{.planes = Planes::perpendicular,
                       .x = in_front(around(-r.dot(j.normal), i.half_edge_m[*turn_i])),
                       .y = around(0, i.half_edge_m[1 - *turn_i]),
                       .xi = in_front(around(r.dot(i.normal), j.half_edge_m[*turn_j])),
                       .eta = around(r.dot(line), j.half_edge_m[1 - *turn_j])};
}

double exchange_area(const RectanglePair& pair) {
  RectangleBatch batch(pair.planes);
  batch.add(pair);
  return batch.evaluate()[0];
}

void RectangleBatch::add(const RectanglePair& p) {
  const std::array values{p.x.from, p.x.to,     p.y.from, p.y.to, p.xi.from,
                          p.xi.to,  p.eta.from, p.eta.to, p.gap_m};
  for (std::size_t k = 0; k < values.size(); ++k) edges_[k][size_] = values[k];
  ++size_;
}

const RectangleBatch::Values& RectangleBatch::evaluate() {
  if (planes_ == Planes::parallel) {
    HWY_DYNAMIC_DISPATCH(parallel)(edges_.data(), size_, exchange_area_m2_.data());
  } else {
    HWY_DYNAMIC_DISPATCH(perpendicular)(edges_.data(), size_, exchange_area_m2_.data());
  }
  size_ = 0;
  return exchange_area_m2_;
}

}  // namespace solver

#endif
