#include "solver/point_factors.h"

#include <algorithm>
#include <numbers>

#include "solver/pair_factor.h"

// Highway compiles this file once per instruction set and picks at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solver/point_factors.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include <hwy/contrib/math/math-inl.h>
// clang-format on

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

/// 1/2pi sum over the edges of (angle in which the point sees the edge) n . (normal of that angle)
/// [Lambert1760]
void quad_factors(const Quads& q, const double* point, const double* normal) {
  const hn::ScalableTag<double> d;
  using V = hn::Vec<decltype(d)>;
  const Vectors<V> p{hn::Set(d, point[0]), hn::Set(d, point[1]), hn::Set(d, point[2])};
  const Vectors<V> n{hn::Set(d, normal[0]), hn::Set(d, normal[1]), hn::Set(d, normal[2])};
  for (std::size_t i = 0; i < q.count; i += hn::Lanes(d)) {
    const auto corner = [&](std::size_t k) -> Vectors<V> {
      return {hn::Sub(hn::LoadU(d, q.vertex_m[k][0] + i), p.x),
              hn::Sub(hn::LoadU(d, q.vertex_m[k][1] + i), p.y),
              hn::Sub(hn::LoadU(d, q.vertex_m[k][2] + i), p.z)};
    };
    Vectors<V> r = corner(3);
    V sum = hn::Zero(d), lowest = dot(n, r), highest = lowest;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vectors<V> next = corner(k), c = cross(next, r);
      const V height = dot(n, next), sine = hn::Sqrt(dot(c, c));
      lowest = hn::Min(lowest, height);
      highest = hn::Max(highest, height);
      const V edge = hn::Mul(angle(d, sine, dot(r, next)), hn::Div(dot(n, c), sine));
      sum = hn::Add(sum, hn::IfThenElseZero(hn::Gt(sine, hn::Zero(d)), edge));
      r = next;
    }
    hn::StoreU(hn::Mul(sum, hn::Set(d, std::numbers::inv_pi / 2)), d, q.factor + i);
    hn::StoreU(lowest, d, q.lowest_m + i);
    hn::StoreU(highest, d, q.highest_m + i);
  }
}

}  // namespace solver::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace solver {
namespace {

HWY_EXPORT(quad_factors);

constexpr double kOnHorizon_m = 1e-12;
constexpr std::size_t kMostLanes = 32;

}  // namespace

void PointFactors::add(const std::vector<Eigen::Vector3d>& polygon) {
  const Eigen::Index number = polygon_.empty() ? 0 : polygon_.back() + 1;
  for (std::size_t k = 1; k + 1 < polygon.size(); k += 2) {
    const std::array<std::size_t, 4> from{0, k, k + 1, std::min(k + 2, polygon.size() - 1)};
    const std::size_t at = polygon_.size();
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<double>& values = vertex_m_[c][axis];
        if (at % kMostLanes == 0) values.resize(at + kMostLanes);  // whole vectors can be read
        values[at] = polygon[from[c]][static_cast<Eigen::Index>(axis)];
      }
    }
    polygon_.push_back(number);
  }
}

Eigen::VectorXd PointFactors::from(const Eigen::Vector3d& point,
                                   const Eigen::Vector3d& normal) const {
  Eigen::VectorXd factors = Eigen::VectorXd::Zero(polygon_.empty() ? 0 : polygon_.back() + 1);
  Eigen::ArrayX3d results(vertex_m_[0][0].size(), 3);
  Quads quads{.count = polygon_.size(),
              .factor = results.col(0).data(),
              .lowest_m = results.col(1).data(),
              .highest_m = results.col(2).data()};
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      quads.vertex_m[c][axis] = vertex_m_[c][axis].data();
    }
  }
  HWY_DYNAMIC_DISPATCH(quad_factors)(quads, point.data(), normal.data());
  for (std::size_t i = 0; i < polygon_.size(); ++i) {
    if (quads.highest_m[i] <= kOnHorizon_m) continue;
    double factor = quads.factor[i];
    if (quads.lowest_m[i] < -kOnHorizon_m) {
      std::vector<Eigen::Vector3d> quad;
      for (const auto& c : vertex_m_) quad.emplace_back(c[0][i], c[1][i], c[2][i]);
      factor = point_to_polygon(point, normal, quad);
    }
    factors[polygon_[i]] += factor;
  }
  return factors;
}

}  // namespace solver

#endif
