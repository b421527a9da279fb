#include "scenes/skies/glass.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scenes/skies/sphere_integral.h"

namespace scenes {
namespace {

using Eigen::ArrayXd;

constexpr double kIndex = 1.52;

/// What one surface reflects, s and p polarised, and the cosine inside.
struct Surface {
  std::array<double, 2> reflected;
  double cosine_inside;
};

Surface surface_at(double cosine) {
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine)) / kIndex;
  const double inside = std::sqrt(1 - sine * sine);
  const double s = (cosine - kIndex * inside) / (cosine + kIndex * inside);
  const double p = (kIndex * cosine - inside) / (kIndex * cosine + inside);
  return {.reflected = {s * s, p * p}, .cosine_inside = inside};
}

}  // namespace

Glass::Share Glass::of_panes(int panes, double inside, double cosine) {
  const Surface surface = surface_at(cosine);
  const double a = std::pow(inside, 1 / surface.cosine_inside);
  Share mean;
  for (const double r : surface.reflected) {
    const double once = 1 - r * r * a * a;
    Share pane{.transmitted = once > 0 ? a * (1 - r) * (1 - r) / once : 0};
    pane.reflected = r * (1 + a * pane.transmitted);
    Share all = pane;
    if (panes == 2) {
      const double between = 1 - pane.reflected * pane.reflected;
      const double t = pane.transmitted;
      all.transmitted = between > 0 ? t * t / between : 0;
      all.reflected = pane.reflected + (between > 0 ? t * t * pane.reflected / between : 0);
    }
    mean.transmitted += all.transmitted / 2;
    mean.reflected += all.reflected / 2;
  }
  return mean;
}

double Glass::clear_at_normal(int panes) {
  constexpr double kInside = 0.958418;
  return of_panes(panes, kInside, 1).transmitted;
}

double Glass::most_at_normal(int panes) { return of_panes(panes, 1, 1).transmitted; }

Glass::Glass(int panes, const ArrayXd& at_normal) : panes_(panes), at_normal_(at_normal) {
  std::vector<double> known;
  for (const double wanted : at_normal) {
    const auto same = std::ranges::find(known, wanted);
    of_band_.push_back(static_cast<int>(same - known.begin()));
    if (same != known.end()) continue;
    double low = 0, high = 1;  // transmittance rises with that of the inside
    for (int step = 0; step < 60; ++step) {
      const double middle = (low + high) / 2;
      (of_panes(panes, middle, 1).transmitted < wanted ? low : high) = middle;
    }
    known.push_back(wanted);
    inside_.push_back((low + high) / 2);
  }
}

ArrayXd Glass::in_bands(const ArrayXd& distinct) const {
  ArrayXd bands(static_cast<Eigen::Index>(of_band_.size()));
  for (Eigen::Index b = 0; b < bands.size(); ++b) {
    bands[b] = distinct[of_band_[static_cast<std::size_t>(b)]];
  }
  return bands;
}

ArrayXd Glass::distinct_transmittance(double cosine) const {
  ArrayXd distinct(static_cast<Eigen::Index>(inside_.size()));
  for (Eigen::Index k = 0; k < distinct.size(); ++k) {
    distinct[k] = of_panes(panes_, inside_[static_cast<std::size_t>(k)], cosine).transmitted;
  }
  return distinct;
}

ArrayXd Glass::transmittance(double cosine) const {
  return in_bands(distinct_transmittance(cosine));
}

template <typename Of>
ArrayXd Glass::from_all_sides(const Of& of_share) const {
  static const GaussLegendre rule(48);
  ArrayXd distinct = ArrayXd::Zero(static_cast<Eigen::Index>(inside_.size()));
  for (Eigen::Index i = 0; i < distinct.size(); ++i) {
    for (std::size_t k = 0; k < rule.node.size(); ++k) {
      const Share share = of_panes(panes_, inside_[static_cast<std::size_t>(i)], rule.node[k]);
      distinct[i] += 2 * rule.node[k] * rule.weight[k] * of_share(share);
    }
  }
  return in_bands(distinct);
}

ArrayXd Glass::diffuse_transmittance() const {
  return from_all_sides([](const Share& share) { return share.transmitted; });
}

ArrayXd Glass::diffuse_reflectance() const {
  return from_all_sides([](const Share& share) { return share.reflected; });
}

}  // namespace scenes
