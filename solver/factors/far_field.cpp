#include "solver/factors/far_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

// Highway compiles this file once per instruction set and picks at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solver/factors/far_field.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef SOLVER_FAR_FIELD_ARGUMENTS
#define SOLVER_FAR_FIELD_ARGUMENTS

namespace solver {

/// One patch against the patches of a tile column, as `start_row` reads them.
struct RowSources {
  std::array<double, 3> centre_i, normal_i;
  double area_i_m2, size_i_m;
  std::array<const double*, 3> centre_j, normal_j;
  const double *area_j_m2, *size_j_m;
};

/// One patch i against one vector of patches j, as `far_pairs` reads them.
struct FarPairs {
  std::size_t points_i, points_j;  ///< of the rules on either side
  std::size_t stride;              ///< between the arrays of two points
  const float *xi, *yi, *zi, *wi;  ///< of patch i
  const float *xj, *yj, *zj, *wj;  ///< of the first patch j
  std::array<float, 3> ni;         ///< normal of i
  const float *njx, *njy, *njz;    ///< normals of j
  const FarRow* row;
  std::size_t at;  ///< of the first patch j in the row
  float* out;
  std::array<const float*, 2> slope_i{}, slope_j{};  ///< psi_1, psi_2 of patch i, of the first j
};

}  // namespace solver
#endif

HWY_BEFORE_NAMESPACE();

namespace solver::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void start_row(const RowSources& s, FarRow& row) {
  const hn::ScalableTag<double> d;
  const hn::Rebind<float, decltype(d)> f;
  using V = hn::Vec<decltype(d)>;
  const auto store = [&](V v, FarRow::Floats& to, std::size_t k)
                         HWY_ATTR { hn::StoreU(hn::DemoteTo(f, v), f, to.data() + k); };
  for (std::size_t k = 0; k < kFarPatches; k += hn::Lanes(d)) {
    V r[3], r2 = hn::Zero(d), height_i = hn::Zero(d), height_j = hn::Zero(d);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      r[axis] = hn::Sub(hn::LoadU(d, s.centre_j[axis] + k), hn::Set(d, s.centre_i[axis]));
      r2 = hn::MulAdd(r[axis], r[axis], r2);
      height_i = hn::MulAdd(r[axis], hn::Set(d, s.normal_i[axis]), height_i);
      height_j = hn::NegMulAdd(r[axis], hn::LoadU(d, s.normal_j[axis] + k), height_j);
    }
    const V distance = hn::Sqrt(r2), inverse2 = hn::Div(hn::Set(d, 1.0), r2);
    const V inverse = hn::Mul(inverse2, distance), twice = hn::Add(inverse2, inverse2);
    const V cos_i = hn::Mul(height_i, inverse), cos_j = hn::Mul(height_j, inverse);
    const V areas =
        hn::Mul(hn::LoadU(d, s.area_j_m2 + k), hn::Set(d, s.area_i_m2 * std::numbers::inv_pi));
    const V size = hn::Max(hn::LoadU(d, s.size_j_m + k), hn::Set(d, s.size_i_m));
    hn::StoreU(hn::Div(distance, size), d, row.distance_over_size.data() + k);
    hn::StoreU(hn::Mul(areas, inverse2), d, row.area_factor_m2.data() + k);
    hn::StoreU(hn::Mul(cos_i, cos_j), d, row.cosines.data() + k);
    store(inverse, row.inverse_m, k);
    store(hn::Mul(r[0], twice), row.twice_x, k);
    store(hn::Mul(r[1], twice), row.twice_y, k);
    store(hn::Mul(r[2], twice), row.twice_z, k);
    store(cos_i, row.cos_i, k);
    store(cos_j, row.cos_j, k);
  }
}

using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;

struct Vec3 {
  V x, y, z;
};

HWY_INLINE V dot(const Vec3& a, const Vec3& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}

HWY_INLINE Vec3 load(const float* x, const float* y, const float* z) {
  const D d;
  return {hn::LoadU(d, x), hn::LoadU(d, y), hn::LoadU(d, z)};
}

HWY_INLINE Vec3 broadcast(float x, float y, float z) {
  const D d;
  return {hn::Set(d, x), hn::Set(d, y), hn::Set(d, z)};
}

/// What belongs to a point p of patch i alone: its offset, its share of e, and with its weight w
/// w (c_j + b), w c_i b, w c_i c_j.
struct FromPoint {
  float x = 0, y = 0, z = 0;
  V e, w_cos_j, w_ci_b, w_product;
};

/// @return their number, even: an odd one gets another of weight 0, at the centre
HWY_INLINE std::size_t prepare(const FarPairs& pair, V s, const Vec3& twice_r, FromPoint* points) {
  const D d;
  const V ci = hn::LoadU(d, pair.row->cos_i.data() + pair.at),
          cj = hn::LoadU(d, pair.row->cos_j.data() + pair.at);
  const Vec3 nj = load(pair.njx, pair.njy, pair.njz);
  const std::size_t even = pair.points_i + pair.points_i % 2;
  for (std::size_t k = 0; k < even; ++k) {
    FromPoint& p = points[k];
    const std::size_t from = k * pair.stride;
    const bool real = k < pair.points_i;
    if (real) p.x = pair.xi[from], p.y = pair.yi[from], p.z = pair.zi[from];
    const Vec3 offset = broadcast(p.x, p.y, p.z);
    const V w = hn::Set(d, real ? pair.wi[from] : 0), b = hn::Mul(s, dot(offset, nj));
    p.e = hn::MulSub(hn::Mul(s, s), dot(offset, offset), dot(offset, twice_r));
    p.w_cos_j = hn::Mul(w, hn::Add(cj, b));
    p.w_ci_b = hn::Mul(w, hn::Mul(ci, b));
    p.w_product = hn::Mul(w, hn::Mul(ci, cj));
  }
  return even;
}

/// By how much the mean of cos cos / r^2 over the points exceeds its value at the centres, r being
/// 1 there. With p and q the points' offsets over r and rho the direction from i to j, it is the
/// mean of
///   (c_i + a)(c_j + b) / (1 + e)^2 - c_i c_j
///     = [a (c_j + b) + c_i b - c_i c_j (2 e + e^2)] / (1 + e)^2,
///   a = n_i . q, b = n_j . p, e = 2 rho . (q - p) + (q - p)^2:
/// small numbers, in which rounding is small too. Two points p share a division.
void far_pairs(const FarPairs& pair) {
  const D d;
  const FarRow& row = *pair.row;
  const V s = hn::LoadU(d, row.inverse_m.data() + pair.at), s2 = hn::Mul(s, s);
  const Vec3 twice_r = load(row.twice_x.data() + pair.at, row.twice_y.data() + pair.at,
                            row.twice_z.data() + pair.at);
  const Vec3 ni = broadcast(pair.ni[0], pair.ni[1], pair.ni[2]);
  FromPoint points[FarField::kMostPoints];
  const std::size_t even = prepare(pair, s, twice_r, points);
  V sum = hn::Zero(d);
  for (std::size_t k = 0; k < pair.points_j; ++k) {
    const std::size_t at = k * pair.stride;
    const Vec3 q = load(pair.xj + at, pair.yj + at, pair.zj + at);
    const V a = hn::Mul(s, dot(q, ni)), e_q = hn::MulAdd(s2, dot(q, q), dot(q, twice_r));
    const V minus_2s2 = hn::Mul(s2, hn::Set(d, -2));
    const Vec3 t{hn::Mul(minus_2s2, q.x), hn::Mul(minus_2s2, q.y), hn::Mul(minus_2s2, q.z)};
    const auto excess = [&](const FromPoint& p) HWY_ATTR {  // (1 + e)^2 - 1
      V e = hn::MulAdd(t.z, hn::Set(d, p.z), hn::Add(p.e, e_q));
      e = hn::MulAdd(t.x, hn::Set(d, p.x), hn::MulAdd(t.y, hn::Set(d, p.y), e));
      return hn::MulAdd(e, e, hn::Add(e, e));
    };
    const auto numerator = [&](const FromPoint& p, V of_p) HWY_ATTR {
      return hn::NegMulAdd(p.w_product, of_p, hn::MulAdd(a, p.w_cos_j, p.w_ci_b));
    };
    V inner = hn::Zero(d);
    for (const FromPoint* p = points; p < points + even; p += 2) {
      const V first = excess(p[0]), second = excess(p[1]);
      const V r4 = hn::Add(first, hn::Set(d, 1)), other_r4 = hn::Add(second, hn::Set(d, 1));
      const V both =
          hn::MulAdd(numerator(p[0], first), other_r4, hn::Mul(numerator(p[1], second), r4));
      inner = hn::Add(inner, hn::Div(both, hn::Mul(r4, other_r4)));
    }
    sum = hn::MulAdd(inner, hn::LoadU(d, pair.wj + at), sum);
  }
  hn::StoreU(sum, d, pair.out);
}

/// Means over the points of psi_a psi_b (c_i + a)(c_j + b) / (1 + e)^2, in the terms of far_pairs,
/// at out[(3 a + b) kFarPatches].
void far_moments(const FarPairs& pair) {
  const D d;
  const FarRow& row = *pair.row;
  const V s = hn::LoadU(d, row.inverse_m.data() + pair.at), s2 = hn::Mul(s, s);
  const V ci = hn::LoadU(d, row.cos_i.data() + pair.at), one = hn::Set(d, 1);
  const Vec3 twice_r = load(row.twice_x.data() + pair.at, row.twice_y.data() + pair.at,
                            row.twice_z.data() + pair.at);
  const Vec3 ni = broadcast(pair.ni[0], pair.ni[1], pair.ni[2]);
  FromPoint points[FarField::kMostPoints];
  prepare(pair, s, twice_r, points);
  V sum[9];
  for (V& m : sum) m = hn::Zero(d);
  for (std::size_t k = 0; k < pair.points_j; ++k) {
    const std::size_t at = k * pair.stride;
    const Vec3 q = load(pair.xj + at, pair.yj + at, pair.zj + at);
    const V cos_i = hn::MulAdd(s, dot(q, ni), ci), e_q = hn::MulAdd(s2, dot(q, q), dot(q, twice_r));
    const V minus_2s2 = hn::Mul(s2, hn::Set(d, -2));
    const Vec3 t{hn::Mul(minus_2s2, q.x), hn::Mul(minus_2s2, q.y), hn::Mul(minus_2s2, q.z)};
    V inner[3] = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    for (std::size_t p = 0; p < pair.points_i; ++p) {
      const FromPoint& from = points[p];
      V r2 = hn::Add(one, hn::MulAdd(t.z, hn::Set(d, from.z), hn::Add(from.e, e_q)));
      r2 = hn::MulAdd(t.x, hn::Set(d, from.x), hn::MulAdd(t.y, hn::Set(d, from.y), r2));
      const V kernel = hn::Div(from.w_cos_j, hn::Mul(r2, r2));
      const std::size_t of_i = p * pair.stride;
      inner[0] = hn::Add(inner[0], kernel);
      inner[1] = hn::MulAdd(hn::Set(d, pair.slope_i[0][of_i]), kernel, inner[1]);
      inner[2] = hn::MulAdd(hn::Set(d, pair.slope_i[1][of_i]), kernel, inner[2]);
    }
    const V w = hn::Mul(cos_i, hn::LoadU(d, pair.wj + at));
    const V psi[3] = {w, hn::Mul(w, hn::LoadU(d, pair.slope_j[0] + at)),
                      hn::Mul(w, hn::LoadU(d, pair.slope_j[1] + at))};
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = 0; b < 3; ++b) {
        sum[3 * a + b] = hn::MulAdd(inner[a], psi[b], sum[3 * a + b]);
      }
    }
  }
  for (std::size_t m = 0; m < 9; ++m) hn::StoreU(sum[m], d, pair.out + m * kFarPatches);
}

std::size_t lanes() { return hn::Lanes(hn::ScalableTag<float>()); }

}  // namespace solver::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace solver {
namespace {

HWY_EXPORT(start_row);
HWY_EXPORT(far_pairs);
HWY_EXPORT(far_moments);
HWY_EXPORT(lanes);

/// Points of a rectangle that serve as well as a product rule of `order` points an edge and are
/// fewer: degree 5 with 7 points, degree 7 with 12 [Stroud1971] (C2: 5-1, 7-1), coordinates from -1
/// to 1.
std::vector<QuadraturePoint> sparse_rule(const Facet& f, int order) {
  if (order == 2) return quadrature(f.vertices, order);
  const Eigen::Vector3d u = (f.vertices[1] - f.vertices[0]) / 2,
                        v = (f.vertices[3] - f.vertices[0]) / 2;
  std::vector<QuadraturePoint> points;
  const auto add = [&](double s, double t, double share) {
    points.push_back({f.centre + s * u + t * v, share * f.area_m2});
  };
  const auto add_corners = [&](double s, double t, double share) {
    for (const double sign : {-1.0, 1.0}) {
      add(sign * s, sign * t, share);
      add(-sign * s, sign * t, share);
    }
  };
  if (order == 3) {
    add(0, 0, 2.0 / 7);
    for (const double t : {-std::sqrt(14.0 / 15), std::sqrt(14.0 / 15)}) add(0, t, 5.0 / 63);
    add_corners(std::sqrt(3.0 / 5), std::sqrt(1.0 / 3), 5.0 / 36);
    return points;
  }
  const double root = std::sqrt(583.0);
  for (const double s : {-std::sqrt(6.0 / 7), std::sqrt(6.0 / 7)}) {
    add(s, 0, 49.0 / 810);
    add(0, s, 49.0 / 810);
  }
  for (const double sign : {-1.0, 1.0}) {
    const double s = std::sqrt((114 + sign * 3 * root) / 287);
    add_corners(s, s, (178981 - sign * 2769 * root) / (4 * 472230));
  }
  return points;
}

}  // namespace

FarField::FarField(const std::vector<Facet>& facets, const std::vector<SlopeBasis>& bases)
    : padded_((facets.size() + kFarPatches - 1) / kFarPatches * kFarPatches),
      area_m2_(padded_),
      size_m_(padded_) {
  for (auto* v : {&normal_x_, &normal_y_, &normal_z_}) v->assign(padded_, 0.0F);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    centre_m_[axis].assign(padded_, 0.0);
    normal_[axis].assign(padded_, 0.0);
  }
  for (Rule& rule : rules_) {
    rule.points.assign(padded_, 0);
    for (auto* v : {&rule.x, &rule.y, &rule.z, &rule.weight})
      v->assign(padded_ * kMostPoints, 0.0F);
    for (auto& slope : rule.slope) slope.assign(bases.empty() ? 0 : padded_ * kMostPoints, 0.0F);
  }
  for (std::size_t i = 0; i < facets.size(); ++i) {
    const Facet& f = facets[i];
    has_rule_.push_back(f.vertices.size() <= 4);
    normal_x_[i] = static_cast<float>(f.normal.x());
    normal_y_[i] = static_cast<float>(f.normal.y());
    normal_z_[i] = static_cast<float>(f.normal.z());
    area_m2_[i] = f.area_m2;
    size_m_[i] = f.size_m;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      centre_m_[axis][i] = f.centre[static_cast<Eigen::Index>(axis)];
      normal_[axis][i] = f.normal[static_cast<Eigen::Index>(axis)];
    }
    if (has_rule_[i]) add_points(f, bases.empty() ? nullptr : &bases[i], i);
  }
}

void FarField::add_points(const Facet& f, const SlopeBasis* basis, std::size_t patch) {
  for (int order = 2; order <= 4; ++order) {
    Rule& rule = rules_[static_cast<std::size_t>(order)];
    std::size_t at = patch;
    for (const QuadraturePoint& q :
         f.rectangle ? sparse_rule(f, order) : quadrature(f.vertices, order)) {
      const Eigen::Vector3f offset = (q.position - f.centre).cast<float>();
      rule.x[at] = offset.x();
      rule.y[at] = offset.y();
      rule.z[at] = offset.z();
      rule.weight[at] = static_cast<float>(q.weight_m2 / f.area_m2);
      for (std::size_t axis = 0; axis < 2 && basis != nullptr; ++axis) {
        rule.slope[axis][at] =
            static_cast<float>(basis->gradient_per_m[axis].dot(q.position - f.centre));
      }
      at += padded_;
      ++rule.points[patch];
    }
  }
}

void FarField::start(std::size_t i, std::size_t first, FarRow& row) const {
  row.i = i;
  row.first = first;
  const auto of_i = [i](const auto& v) { return std::array{v[0][i], v[1][i], v[2][i]}; };
  const auto of_j = [first](const auto& v) {
    return std::array{&v[0][first], &v[1][first], &v[2][first]};
  };
  HWY_DYNAMIC_DISPATCH(start_row)
  ({.centre_i = of_i(centre_m_),
    .normal_i = of_i(normal_),
    .area_i_m2 = area_m2_[i],
    .size_i_m = size_m_[i],
    .centre_j = of_j(centre_m_),
    .normal_j = of_j(normal_),
    .area_j_m2 = &area_m2_[first],
    .size_j_m = &size_m_[first]},
   row);
}

/// Groups of 16 share the rule of their nearest pair, whatever the vector length: equal bits
/// everywhere.
template <typename Visit>
void FarField::for_each_vector(const FarRow& row, const std::array<int, kFarPatches>& order,
                               const Visit& visit) const {
  const std::size_t i = row.i;
  constexpr std::size_t kGroup = 16;
  const std::size_t step = HWY_DYNAMIC_DISPATCH(lanes)();
  for (std::size_t k = 0; k < kFarPatches; k += step) {
    const std::size_t group = k / kGroup * kGroup;
    const int most = *std::max_element(&order[group], &order[group] + kGroup);
    if (most == 0) continue;
    const Rule& rule = rules_[static_cast<std::size_t>(most)];
    const std::size_t j = row.first + k;
    const std::size_t* points = &rule.points[row.first + group];
    FarPairs pairs{.points_i = rule.points[i],
                   .points_j = *std::max_element(points, points + kGroup),
                   .stride = padded_,
                   .xi = &rule.x[i],
                   .yi = &rule.y[i],
                   .zi = &rule.z[i],
                   .wi = &rule.weight[i],
                   .xj = &rule.x[j],
                   .yj = &rule.y[j],
                   .zj = &rule.z[j],
                   .wj = &rule.weight[j],
                   .ni = {normal_x_[i], normal_y_[i], normal_z_[i]},
                   .njx = &normal_x_[j],
                   .njy = &normal_y_[j],
                   .njz = &normal_z_[j],
                   .row = &row,
                   .at = k,
                   .out = nullptr};
    for (std::size_t axis = 0; axis < 2 && !rule.slope[axis].empty(); ++axis) {
      pairs.slope_i[axis] = &rule.slope[axis][i];
      pairs.slope_j[axis] = &rule.slope[axis][j];
    }
    visit(pairs);
  }
}

void FarField::exchange(const FarRow& row, const std::array<int, kFarPatches>& order,
                        float* exchange_area_m2) const {
  std::array<float, kFarPatches> excess;
  const std::size_t step = HWY_DYNAMIC_DISPATCH(lanes)();
  for_each_vector(row, order, [&](FarPairs& pairs) {
    pairs.out = &excess[pairs.at];
    HWY_DYNAMIC_DISPATCH(far_pairs)(pairs);
    for (std::size_t lane = pairs.at; lane < pairs.at + step; ++lane) {
      if (order[lane] == 0) continue;
      const double value =
          row.area_factor_m2[lane] * (row.cosines[lane] + static_cast<double>(excess[lane]));
      exchange_area_m2[lane] = static_cast<float>(std::max(0.0, value));  // they may hardly face
    }
  });
}

void FarField::moments(const FarRow& row, const std::array<int, kFarPatches>& order,
                       Moments& moments_m2) const {
  const std::size_t step = HWY_DYNAMIC_DISPATCH(lanes)();
  for_each_vector(row, order, [&](FarPairs& pairs) {
    pairs.out = &moments_m2[0][pairs.at];
    HWY_DYNAMIC_DISPATCH(far_moments)(pairs);
    for (FarRow::Floats& moment : moments_m2) {
      for (std::size_t lane = pairs.at; lane < pairs.at + step; ++lane) {
        moment[lane] *= static_cast<float>(row.area_factor_m2[lane]);
      }
    }
  });
}

}  // namespace solver

#endif
