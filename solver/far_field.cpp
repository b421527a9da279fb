#include "solver/far_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

// Highway compiles this file once per instruction set and picks at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solver/far_field.cpp"
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
  for (std::size_t k = 0; k < kTile; k += hn::Lanes(d)) {
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

/// By how much the mean of cos cos / r^2 over the points exceeds its value at the centres, r being
/// 1 there. With p and q the points' offsets over r and rho the direction from i to j, it is the
/// mean of
///   (c_i + n_i . q)(c_j + b) / (1 + e)^2 - c_i c_j
///     = [(n_i . q)(c_j + b) + c_i b - c_i c_j (2 e + e^2)] / (1 + e)^2,
///   b = n_j . p, e = 2 rho . (q - p) + (q - p)^2:
/// small numbers, in which rounding is small too. Two points p share a division.
void far_pairs(const FarPairs& pair) {
  const hn::ScalableTag<float> d;
  using V = hn::Vec<decltype(d)>;
  const auto dot = [](V x, V y, V z, V u, V v, V w)
                       HWY_ATTR { return hn::MulAdd(x, u, hn::MulAdd(y, v, hn::Mul(z, w))); };
  const auto row = [&](const FarRow::Floats& values)
                       HWY_ATTR { return hn::LoadU(d, values.data() + pair.at); };
  const V s = row(pair.row->inverse_m), s2 = hn::Mul(s, s);
  const V rx = row(pair.row->twice_x), ry = row(pair.row->twice_y), rz = row(pair.row->twice_z);
  const V ci = row(pair.row->cos_i), cj = row(pair.row->cos_j), product = hn::Mul(ci, cj);
  const V njx = hn::LoadU(d, pair.njx), njy = hn::LoadU(d, pair.njy), njz = hn::LoadU(d, pair.njz);
  const V nix = hn::Set(d, pair.ni[0]), niy = hn::Set(d, pair.ni[1]), niz = hn::Set(d, pair.ni[2]);

  /// What belongs to a point p alone, times its weight where a `w` says so.
  struct Point {
    float x = 0, y = 0, z = 0;
    V e, w_cos_j, w_ci_b, w_product;
  };

  Point points[FarField::kMostPoints];
  const std::size_t even = pair.points_i + pair.points_i % 2;
  for (std::size_t k = 0; k < even; ++k) {
    Point& p = points[k];
    const std::size_t from = k * pair.stride;
    const bool real = k < pair.points_i;  // else one of weight 0, at the centre
    if (real) p.x = pair.xi[from], p.y = pair.yi[from], p.z = pair.zi[from];
    const V x = hn::Set(d, p.x), y = hn::Set(d, p.y), z = hn::Set(d, p.z);
    const V w = hn::Set(d, real ? pair.wi[from] : 0), b = hn::Mul(s, dot(x, y, z, njx, njy, njz));
    p.e = hn::MulSub(s2, dot(x, y, z, x, y, z), dot(x, y, z, rx, ry, rz));
    p.w_cos_j = hn::Mul(w, hn::Add(cj, b));
    p.w_ci_b = hn::Mul(w, hn::Mul(ci, b));
    p.w_product = hn::Mul(w, product);
  }
  V sum = hn::Zero(d);
  for (std::size_t k = 0; k < pair.points_j; ++k) {
    const std::size_t at = k * pair.stride;
    const V x = hn::LoadU(d, pair.xj + at), y = hn::LoadU(d, pair.yj + at),
            z = hn::LoadU(d, pair.zj + at);
    const V n_i_q = hn::Mul(s, dot(x, y, z, nix, niy, niz));
    const V e_q = hn::MulAdd(s2, dot(x, y, z, x, y, z), dot(x, y, z, rx, ry, rz));
    const V minus_2s2 = hn::Mul(s2, hn::Set(d, -2));
    const V tx = hn::Mul(minus_2s2, x), ty = hn::Mul(minus_2s2, y), tz = hn::Mul(minus_2s2, z);
    /// (1 + e)^2 - 1
    const auto excess = [&](const Point& p) HWY_ATTR {
      const V e = hn::MulAdd(
          tx, hn::Set(d, p.x),
          hn::MulAdd(ty, hn::Set(d, p.y), hn::MulAdd(tz, hn::Set(d, p.z), hn::Add(p.e, e_q))));
      return hn::MulAdd(e, e, hn::Add(e, e));
    };
    const auto numerator = [&](const Point& p, V excess_p) HWY_ATTR {
      return hn::NegMulAdd(p.w_product, excess_p, hn::MulAdd(n_i_q, p.w_cos_j, p.w_ci_b));
    };
    V inner = hn::Zero(d);
    for (std::size_t a = 0; a < even; a += 2) {
      const Point &p = points[a], &next = points[a + 1];
      const V of_p = excess(p), of_next = excess(next);
      const V r4 = hn::Add(of_p, hn::Set(d, 1)), next_r4 = hn::Add(of_next, hn::Set(d, 1));
      const V both = hn::MulAdd(numerator(p, of_p), next_r4, hn::Mul(numerator(next, of_next), r4));
      inner = hn::Add(inner, hn::Div(both, hn::Mul(r4, next_r4)));
    }
    sum = hn::MulAdd(inner, hn::LoadU(d, pair.wj + at), sum);
  }
  hn::StoreU(sum, d, pair.out);
}

std::size_t lanes() { return hn::Lanes(hn::ScalableTag<float>()); }

}  // namespace solver::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace solver {
namespace {

HWY_EXPORT(start_row);
HWY_EXPORT(far_pairs);
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

FarField::FarField(const std::vector<Facet>& facets)
    : padded_((facets.size() + kTile - 1) / kTile * kTile), area_m2_(padded_), size_m_(padded_) {
  for (auto* v : {&normal_x_, &normal_y_, &normal_z_}) v->assign(padded_, 0.0F);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    centre_m_[axis].assign(padded_, 0.0);
    normal_[axis].assign(padded_, 0.0);
  }
  for (Rule& rule : rules_) {
    rule.points.assign(padded_, 0);
    for (auto* v : {&rule.x, &rule.y, &rule.z, &rule.weight})
      v->assign(padded_ * kMostPoints, 0.0F);
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
    if (has_rule_[i]) add_points(f, i);
  }
}

void FarField::add_points(const Facet& f, std::size_t patch) {
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

void FarField::exchange(const FarRow& row, const std::array<int, kTile>& order,
                        float* exchange_area_m2) const {
  std::array<float, kTile> excess;
  const std::size_t i = row.i;
  // Groups of 16 share the rule of their nearest pair, whatever the vector length: equal bits
  // everywhere.
  constexpr std::size_t kGroup = 16;
  const std::size_t step = HWY_DYNAMIC_DISPATCH(lanes)();
  for (std::size_t k = 0; k < kTile; k += step) {
    const std::size_t group = k / kGroup * kGroup;
    const int most = *std::max_element(&order[group], &order[group] + kGroup);
    if (most == 0) continue;
    const Rule& rule = rules_[static_cast<std::size_t>(most)];
    const std::size_t j = row.first + k;
    const std::size_t* points = &rule.points[row.first + group];
    HWY_DYNAMIC_DISPATCH(far_pairs)
    ({.points_i = rule.points[i],
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
      .out = &excess[k]});
    for (std::size_t lane = k; lane < k + step; ++lane) {
      if (order[lane] == 0) continue;
      const double value =
          row.area_factor_m2[lane] * (row.cosines[lane] + static_cast<double>(excess[lane]));
      exchange_area_m2[lane] = static_cast<float>(std::max(0.0, value));  // they may hardly face
    }
  }
}

}  // namespace solver

#endif
