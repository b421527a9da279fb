#include "paints/mixing.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace paints {
namespace {

void require_sound(const Saunderson& surface) {
  const auto& [k1, k2] = surface;
  if (!(k1 >= 0 && k1 < 1 && k2 >= 0 && k2 < 1)) {
    throw std::invalid_argument(
        fmt::format("Saunderson k1 {} and k2 {}; want both from 0 to below 1", k1, k2));
  }
}

void require_sound(const BaseSet& set, const std::vector<int>& bases,
                   const Eigen::VectorXd& parts) {
  const auto known = [&](int base) {
    return base >= 0 && static_cast<std::size_t>(base) < set.bases.size();
  };
  bool sound = !bases.empty() && static_cast<std::size_t>(parts.size()) == bases.size();
  for (const int base : bases) sound = sound && known(base);
  if (!(sound && (parts.array() >= 0).all() && parts.sum() > 0 && parts.allFinite())) {
    throw std::invalid_argument("a mixture wants parts from 0 up, some above 0, of known bases");
  }
}

}  // namespace

double body_reflectance(double k_over_s) {
  return 1 / (1 + k_over_s + std::sqrt(k_over_s * (k_over_s + 2)));
}

double k_over_s(double body_reflectance) {
  const double absorbed = 1 - body_reflectance;
  return absorbed * absorbed / (2 * body_reflectance);
}

double measured_reflectance(double body, const Saunderson& surface) {
  const auto& [k1, k2] = surface;
  return k1 + (1 - k1) * (1 - k2) * body / (1 - k2 * body);
}

double body_behind(double measured, const Saunderson& surface) {
  const auto& [k1, k2] = surface;
  return (measured - k1) / ((1 - k1) * (1 - k2) + k2 * (measured - k1));
}

BaseSet bases_of(const Atlas& atlas, const Saunderson& surface) {
  require_sound(surface);
  BaseSet set{.surface = surface};
  for (const Paint& paint : atlas.paints) {
    set.grid = paint.reflectance.grid;
    if (!(paint.reflectance.values > surface.k1).all()) {
      set.left_out.push_back(paint.name);
      continue;
    }
    set.bases.push_back({.name = paint.name,
                         .label = paint.label,
                         .absorption = paint.reflectance.values.unaryExpr([&](double measured) {
                           return k_over_s(body_behind(measured, surface));
                         }),
                         .scattering = Eigen::ArrayXd::Ones(paint.reflectance.values.size())});
  }
  return set;
}

Mixture mixture(const BaseSet& set, const std::vector<int>& bases, const Eigen::VectorXd& parts) {
  require_sound(set, bases, parts);
  const auto base = [&](std::size_t i) -> const Base& {
    return set.bases[static_cast<std::size_t>(bases[i])];
  };
  Eigen::ArrayXd k = Eigen::ArrayXd::Zero(set.grid.count), s = k;
  for (std::size_t i = 0; i < bases.size(); ++i) {
    k += parts[static_cast<Eigen::Index>(i)] * base(i).absorption;
    s += parts[static_cast<Eigen::Index>(i)] * base(i).scattering;
  }

  const auto& [k1, k2] = set.surface;
  const Eigen::ArrayXd ratio = k / s, root = (ratio * (ratio + 2)).sqrt();
  const Eigen::ArrayXd body = 1 / (1 + ratio + root);
  const Eigen::ArrayXd behind = 1 - k2 * body;
  Mixture mixed{.reflectance = {set.grid, k1 + (1 - k1) * (1 - k2) * body / behind},
                .by_parts = Eigen::MatrixXd(set.grid.count, parts.size())};
  // d body / d(K/S) = -body / root, infinite only for a film that absorbs nothing.
  const Eigen::ArrayXd by_ratio = -(1 - k1) * (1 - k2) / behind.square() * body / root;
  for (std::size_t i = 0; i < bases.size(); ++i) {
    mixed.by_parts.col(static_cast<Eigen::Index>(i)) =
        by_ratio * (base(i).absorption - ratio * base(i).scattering) / s;
  }
  return mixed;
}

}  // namespace paints
