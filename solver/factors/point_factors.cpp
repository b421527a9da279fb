#include "solver/factors/point_factors.h"

#include <algorithm>
#include <numbers>

// Highway compiles this file once per instruction set and picks at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solver/factors/point_factors.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Needs the target that foreach_target.h has chosen.
#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();

namespace solver::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct Vectors {
  V x, y, z;
};

template <class V>
HWY_INLINE V dot(const Vectors<V>& a, const Vectors<V>& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}

template <class V>
HWY_INLINE Vectors<V> cross(const Vectors<V>& a, const Vectors<V>& b) {
  return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
          hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
}

/// The angle between two vectors from its sine and cosine, times the same length; 0 to pi.
template <class D, class V>
HWY_INLINE V angle(D d, V sine, V cosine) {
  const V least = hn::Set(d, 1e-300), zero = hn::Zero(d);
  const V adjacent = hn::Max(hn::Abs(cosine), least);
  const V acute = hn::Atan(d, hn::Div(sine, adjacent));
  return hn::IfThenElse(hn::Lt(cosine, zero), hn::Sub(hn::Set(d, std::numbers::pi), acute), acute);
}

/// (angle in which the origin sees the edge from a to b) n . (normal of that angle)
template <class D, class V>
HWY_INLINE V edge_term(D d, const Vectors<V>& a, const Vectors<V>& b, const Vectors<V>& n) {
  const Vectors<V> c = cross(b, a);
  const V sine = hn::Sqrt(dot(c, c));
  const V term = hn::Mul(angle(d, sine, dot(a, b)), hn::Div(dot(n, c), sine));
  return hn::IfThenElseZero(hn::Gt(sine, hn::Zero(d)), term);
}

/// a + part (b - a)
template <class V>
HWY_INLINE Vectors<V> between(const Vectors<V>& a, const Vectors<V>& b, V part) {
  return {hn::MulAdd(part, hn::Sub(b.x, a.x), a.x), hn::MulAdd(part, hn::Sub(b.y, a.y), a.y),
          hn::MulAdd(part, hn::Sub(b.z, a.z), a.z)};
}

template <class M, class V>
HWY_INLINE Vectors<V> choose(M mask, const Vectors<V>& yes, const Vectors<V>& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
          hn::IfThenElse(mask, yes.z, no.z)};
}

/// Corners relative to the point, and their heights over its horizon.
template <class V>
struct Corners {
  Vectors<V> r[4];
  V height_m[4];
};

template <class D, class V>
HWY_INLINE V sum_of_edges(D d, const Corners<V>& c, const Vectors<V>& n) {
  V sum = edge_term(d, c.r[3], c.r[0], n);
  for (std::size_t k = 1; k < 4; ++k) sum = hn::Add(sum, edge_term(d, c.r[k - 1], c.r[k], n));
  return sum;
}

/// What reaches below the horizon is cut off there: the edge from where the outline goes down to
/// where it comes up again closes the polygon.
template <class D, class V>
HWY_INLINE V sum_above_horizon(D d, const Corners<V>& c, const Vectors<V>& n) {
  const V zero = hn::Zero(d);
  V sum = zero;
  Vectors<V> down{zero, zero, zero}, up = down;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vectors<V>&from = c.r[(k + 3) % 4], &to = c.r[k];
    const V h = c.height_m[(k + 3) % 4], next = c.height_m[k];
    const auto goes_down = hn::And(hn::Ge(h, zero), hn::Lt(next, zero));
    const auto comes_up = hn::And(hn::Lt(h, zero), hn::Ge(next, zero));
    const auto above = hn::Or(hn::Ge(h, zero), hn::Ge(next, zero));
    const Vectors<V> cut = between(from, to, hn::Div(h, hn::Sub(h, next)));
    down = choose(goes_down, cut, down);
    up = choose(comes_up, cut, up);
    const V term = edge_term(d, choose(comes_up, cut, from), choose(goes_down, cut, to), n);
    sum = hn::Add(sum, hn::IfThenElseZero(above, term));
  }
  return hn::Add(sum, edge_term(d, down, up, n));
}

/// 1/2pi sum over the edges of what is above the horizon [Lambert1760]
void quad_factors(const Quads& q, const double* point, const double* normal) {
  const hn::ScalableTag<double> d;
  using V = hn::Vec<decltype(d)>;
  const V zero = hn::Zero(d), on_horizon = hn::Set(d, 1e-12);
  const Vectors<V> p{hn::Set(d, point[0]), hn::Set(d, point[1]), hn::Set(d, point[2])};
  const Vectors<V> n{hn::Set(d, normal[0]), hn::Set(d, normal[1]), hn::Set(d, normal[2])};
  for (std::size_t i = 0; i < q.count; i += hn::Lanes(d)) {
    Corners<V> c;
    for (std::size_t k = 0; k < 4; ++k) {
      c.r[k] = {hn::Sub(hn::LoadU(d, q.vertex_m[k][0] + i), p.x),
                hn::Sub(hn::LoadU(d, q.vertex_m[k][1] + i), p.y),
                hn::Sub(hn::LoadU(d, q.vertex_m[k][2] + i), p.z)};
      const V height = dot(n, c.r[k]);
      c.height_m[k] = hn::IfThenElseZero(hn::Gt(hn::Abs(height), on_horizon), height);
    }
    const V *h = c.height_m, lowest = hn::Min(hn::Min(h[0], h[1]), hn::Min(h[2], h[3])),
            highest = hn::Max(hn::Max(h[0], h[1]), hn::Max(h[2], h[3]));
    const auto rises = hn::Gt(highest, zero);
    V sum = zero;
    if (!hn::AllFalse(d, rises)) {
      sum =
          hn::AllTrue(d, hn::Ge(lowest, zero)) ? sum_of_edges(d, c, n) : sum_above_horizon(d, c, n);
    }
    sum = hn::IfThenElseZero(rises, sum);
    hn::StoreU(hn::Mul(sum, hn::Set(d, std::numbers::inv_pi / 2)), d, q.factor + i);
  }
}

}  // namespace solver::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace solver {
namespace {

HWY_EXPORT(quad_factors);

constexpr std::size_t kMostLanes = 32;
constexpr std::size_t kChunk = 64;  ///< quadrilaterals at a time
static_assert(kChunk % kMostLanes == 0);

}  // namespace

void PointFactors::add(const std::vector<Eigen::Vector3d>& polygon) {
  std::size_t at = first_quad_.back();
  for (std::size_t k = 1; k + 1 < polygon.size(); k += 2, ++at) {
    const std::array<std::size_t, 4> from{0, k, k + 1, std::min(k + 2, polygon.size() - 1)};
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<double>& values = vertex_m_[c][axis];
        if (values.size() < at + kMostLanes) values.resize(2 * at + kMostLanes);
        values[at] = polygon[from[c]][static_cast<Eigen::Index>(axis)];
      }
    }
  }
  first_quad_.push_back(at);
}

Eigen::VectorXd PointFactors::from(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                                   std::size_t first, std::size_t end) const {
  Eigen::VectorXd factors = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(end - first));
  std::array<double, kChunk> factor;
  std::size_t polygon = first;
  for (std::size_t q = first_quad_[first]; q < first_quad_[end]; q += kChunk) {
    Quads quads{.count = std::min(kChunk, first_quad_[end] - q), .factor = factor.data()};
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        quads.vertex_m[c][axis] = &vertex_m_[c][axis][q];
      }
    }
    HWY_DYNAMIC_DISPATCH(quad_factors)(quads, point.data(), normal.data());
    for (std::size_t i = 0; i < quads.count; ++i) {
      while (first_quad_[polygon + 1] <= q + i) ++polygon;
      factors[static_cast<Eigen::Index>(polygon - first)] += factor[i];
    }
  }
  return factors;
}

}  // namespace solver

#endif
