#include "solver/far_field.h"

#include <algorithm>
#include <numbers>

// Highway compiles this file once per instruction set and picks at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solver/far_field.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace solver::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// sum_ab w_a w_b (n_i . r)(-n_j . r) / (pi r^4)
void far_pairs(const FarPairs& p) {
  const hn::ScalableTag<float> d;
  const auto nix = hn::Set(d, p.ni[0]), niy = hn::Set(d, p.ni[1]), niz = hn::Set(d, p.ni[2]);
  const auto njx = hn::LoadU(d, p.njx), njy = hn::LoadU(d, p.njy), njz = hn::LoadU(d, p.njz);
  auto sum = hn::Zero(d);
  for (int b = 0; b < p.points; ++b) {
    const std::size_t at = static_cast<std::size_t>(b) * p.stride;
    const auto bx = hn::Add(hn::LoadU(d, p.rx), hn::LoadU(d, p.xj + at));
    const auto by = hn::Add(hn::LoadU(d, p.ry), hn::LoadU(d, p.yj + at));
    const auto bz = hn::Add(hn::LoadU(d, p.rz), hn::LoadU(d, p.zj + at));
    auto inner = hn::Zero(d);
    for (int a = 0; a < p.points; ++a) {
      const std::size_t from = static_cast<std::size_t>(a) * p.stride;
      const auto x = hn::Sub(bx, hn::Set(d, p.xi[from]));
      const auto y = hn::Sub(by, hn::Set(d, p.yi[from]));
      const auto z = hn::Sub(bz, hn::Set(d, p.zi[from]));
      const auto r2 = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
      const auto cos_i = hn::MulAdd(x, nix, hn::MulAdd(y, niy, hn::Mul(z, niz)));
      const auto cos_j = hn::MulAdd(x, njx, hn::MulAdd(y, njy, hn::Mul(z, njz)));
      const auto weighted = hn::Mul(hn::Mul(cos_i, cos_j), hn::Set(d, p.wi[from]));
      inner = hn::Add(inner, hn::Div(weighted, hn::Mul(r2, r2)));
    }
    sum = hn::NegMulAdd(inner, hn::LoadU(d, p.wj + at), sum);
  }
  hn::StoreU(hn::Mul(sum, hn::Set(d, std::numbers::inv_pi_v<float>)), d, p.out);
}

std::size_t lanes() { return hn::Lanes(hn::ScalableTag<float>()); }

}  // namespace solver::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace solver {
namespace {

HWY_EXPORT(far_pairs);
HWY_EXPORT(lanes);

}  // namespace

FarField::FarField(const std::vector<Facet>& facets)
    : padded_((facets.size() + kTile - 1) / kTile * kTile) {
  for (auto* v : {&normal_x_, &normal_y_, &normal_z_}) v->assign(padded_, 0.0F);
  for (auto* v : {&centre_x_, &centre_y_, &centre_z_}) v->assign(padded_, 0.0);
  for (int order = 2; order <= 4; ++order) {
    Rule& rule = rules_[static_cast<std::size_t>(order)];
    rule.points = order * order;
    for (auto* v : {&rule.x, &rule.y, &rule.z, &rule.weight}) {
      v->assign(padded_ * static_cast<std::size_t>(rule.points), 0.0F);
    }
  }
  for (std::size_t i = 0; i < facets.size(); ++i) {
    const Facet& f = facets[i];
    has_rule_.push_back(f.vertices.size() <= 4);
    normal_x_[i] = static_cast<float>(f.normal.x());
    normal_y_[i] = static_cast<float>(f.normal.y());
    normal_z_[i] = static_cast<float>(f.normal.z());
    centre_x_[i] = f.centre.x();
    centre_y_[i] = f.centre.y();
    centre_z_[i] = f.centre.z();
    if (!has_rule_[i]) continue;
    for (int order = 2; order <= 4; ++order) {
      Rule& rule = rules_[static_cast<std::size_t>(order)];
      std::size_t at = i;
      for (const QuadraturePoint& q : quadrature(f.vertices, order)) {
        const Eigen::Vector3f offset = (q.position - f.centre).cast<float>();
        rule.x[at] = offset.x();
        rule.y[at] = offset.y();
        rule.z[at] = offset.z();
        rule.weight[at] = static_cast<float>(q.weight_m2);
        at += padded_;
      }
    }
  }
}

void FarField::exchange(std::size_t i, std::size_t first, const std::array<int, kTile>& order,
                        std::array<float, kTile>& exchange_area_m2) const {
  std::array<float, kTile> rx, ry, rz, value;
  for (std::size_t k = 0; k < kTile; ++k) {
    rx[k] = static_cast<float>(centre_x_[first + k] - centre_x_[i]);
    ry[k] = static_cast<float>(centre_y_[first + k] - centre_y_[i]);
    rz[k] = static_cast<float>(centre_z_[first + k] - centre_z_[i]);
  }
  // Groups of 16 share the rule of their nearest pair, whatever the vector length: equal bits
  // everywhere.
  constexpr std::size_t kGroup = 16;
  const std::size_t step = HWY_DYNAMIC_DISPATCH(lanes)();
  for (std::size_t k = 0; k < kTile; k += step) {
    const auto group = order.begin() + k / kGroup * kGroup;
    const int most = *std::max_element(group, group + kGroup);
    if (most == 0) continue;
    const Rule& rule = rules_[static_cast<std::size_t>(most)];
    const std::size_t j = first + k;
    HWY_DYNAMIC_DISPATCH(far_pairs)
    ({.points = rule.points,
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
      .rx = &rx[k],
      .ry = &ry[k],
      .rz = &rz[k],
      .out = &value[k]});
    for (std::size_t lane = k; lane < k + step; ++lane) {
      if (order[lane] > 0) exchange_area_m2[lane] = value[lane];
    }
  }
}

}  // namespace solver

#endif
