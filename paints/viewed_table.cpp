#include "paints/viewed_table.h"

#include <algorithm>
#include <stdexcept>

#include "appearance/spectra/cie_tables.h"
#include "appearance/viewing_conditions.h"

namespace paints {
namespace {

constexpr int kIntervals = 64;
constexpr int kMostBands = 32;

/// Largest reflectance that any mixture can have: that of the base with the least K/S.
double largest_reflectance(const BaseSet& set) {
  double least = 1e300;
  for (const Base& base : set.bases) {
    least = std::min(least, (base.absorption / base.scattering).minCoeff());
  }
  return measured_reflectance(body_reflectance(least), set.surface);
}

}  // namespace

/// An opaque mixture, band by band.
struct ViewedTable::Film {
  Bands ratio, scattering;  // K/S, and S of the sum
  Bands reflectance;        // as measured
  Bands by_ratio;           // its derivative by K/S
};

ViewedTable::ViewedTable(const BaseSet& set, const spectra::RoomResponseSlope& room,
                         const spectra::ViewingChoices& viewing)
    : bands_(set.grid.count),
      surface_(set.surface),
      adopted_{.choices = viewing, .white = {}, .size = {}} {
  if (set.bases.empty() || bands_ > kMostBands) {
    throw std::invalid_argument("mixing wants at least one base, and at most 32 bands");
  }
  for (const Base& base : set.bases) {
    absorption_.emplace_back(base.absorption.cast<float>());
    scattering_.emplace_back(base.scattering.cast<float>());
  }
  largest_ = largest_reflectance(set);
  weights_ = (spectra::kMaxLuminousEfficacy_lm_W * set.grid.step_nm *
              spectra::colour_matching(set.grid).array())
                 .cast<float>();
  fit(room, set.grid);
}

void ViewedTable::fit(const spectra::RoomResponseSlope& room, const spectra::Grid& grid) {
  const double step = largest_ / kIntervals;
  std::vector<spectra::ViewedLightSlope> nodes;
  for (int n = 0; n <= kIntervals; ++n) {
    nodes.push_back(room(spectra::constant(grid, n * step)));
  }
  const spectra::ViewedLight& middle = nodes[kIntervals / 2].light;
  (void)appearance::view_of_room(middle, adopted_.choices);  // is there light?
  adopted_ = appearance::adopted(middle, adopted_.choices);

  const auto at = [](const spectra::ViewedLight& light, int band) {
    return Eigen::Array4d(light.sample.values[band], light.white.values[band],
                          light.field.values[band], light.background.values[band]);
  };
  cubics_.reserve(static_cast<std::size_t>(bands_ * kIntervals));
  for (int band = 0; band < bands_; ++band) {
    for (std::size_t n = 0; n < kIntervals; ++n) {
      const Eigen::Array4d from = at(nodes[n].light, band);
      const Eigen::Array4d rise = at(nodes[n + 1].light, band) - from;
      const Eigen::Array4d before = step * at(nodes[n].by_reflectance, band);
      const Eigen::Array4d after = step * at(nodes[n + 1].by_reflectance, band);
      cubics_.push_back({.c0 = from.cast<float>(),
                         .c1 = before.cast<float>(),
                         .c2 = (3 * rise - 2 * before - after).cast<float>(),
                         .c3 = (before + after - 2 * rise).cast<float>()});
    }
  }
}

ViewedTable::Film ViewedTable::mix(const BaseNumbers& bases, const Parts& parts) const {
  Bands k = Bands::Zero(bands_), s = Bands::Zero(bands_);
  for (int i = 0; i < bases.count; ++i) {
    const auto base = static_cast<std::size_t>(bases.at[static_cast<std::size_t>(i)]);
    const auto share = static_cast<float>(parts[i]);
    k += share * absorption_[base];
    s += share * scattering_[base];
  }
  const auto k1 = static_cast<float>(surface_.k1), k2 = static_cast<float>(surface_.k2);
  const float through = (1 - k1) * (1 - k2);
  Film film;
  film.ratio = k / s;
  film.scattering = s;
  const Bands root = (film.ratio * (film.ratio + 2.0F)).sqrt();
  const Bands body = 1 / (1 + film.ratio + root), behind = 1 - k2 * body;
  film.reflectance = k1 + through * body / behind;
  film.by_ratio = -through * body / (behind.square() * root);
  return film;
}

ViewedTable::Piece ViewedTable::piece(int band, float place) const {
  const int interval = std::min(static_cast<int>(place), kIntervals - 1);
  return {.cubic = cubics_[static_cast<std::size_t>(band * kIntervals + interval)],
          .t = place - static_cast<float>(interval)};
}

Eigen::Vector3d ViewedTable::jab(const BaseNumbers& bases, const Parts& parts) const {
  const Film film = mix(bases, parts);
  const auto per_interval = static_cast<float>(kIntervals / largest_);
  Light x = Light::Zero(), y = x, z = x;
  for (int band = 0; band < bands_; ++band) {
    const auto [c, t] = piece(band, film.reflectance[band] * per_interval);
    const Light light = c.c0 + t * (c.c1 + t * (c.c2 + t * c.c3));
    x += weights_(band, 0) * light;
    y += weights_(band, 1) * light;
    z += weights_(band, 2) * light;
  }
  appearance::ViewedSums sums;
  sums << x[0], y[0], z[0], x[1], y[1], z[1], y[2], y[3];
  return appearance::jab_of(sums, adopted_);
}

JabOfParts ViewedTable::slope(const BaseNumbers& bases, const Parts& parts) const {
  const Film film = mix(bases, parts);
  const auto per_interval = static_cast<float>(kIntervals / largest_);
  using Sums = Eigen::Matrix<float, appearance::kViewedSums, 1>;
  Sums sums = Sums::Zero();
  Eigen::Matrix<float, appearance::kViewedSums, kMostBases> by_parts;
  by_parts.setZero();
  for (int band = 0; band < bands_; ++band) {
    const auto [c, t] = piece(band, film.reflectance[band] * per_interval);
    const Light light = c.c0 + t * (c.c1 + t * (c.c2 + t * c.c3));
    const Light rise = (c.c1 + t * (2 * c.c2 + t * (3 * c.c3))) * per_interval;
    const float wx = weights_(band, 0), wy = weights_(band, 1), wz = weights_(band, 2);
    const auto summed = [&](const Light& v) {
      Sums terms;
      terms << wx * v[0], wy * v[0], wz * v[0], wx * v[1], wy * v[1], wz * v[1], wy * v[2],
          wy * v[3];
      return terms;
    };
    sums += summed(light);
    const Sums by_ratio = summed(rise) * (film.by_ratio[band] / film.scattering[band]);
    for (int i = 0; i < bases.count; ++i) {
      const auto base = static_cast<std::size_t>(bases.at[static_cast<std::size_t>(i)]);
      by_parts.col(i) +=
          by_ratio * (absorption_[base][band] - film.ratio[band] * scattering_[base][band]);
    }
  }
  const appearance::JabOfSums of_sums = appearance::jab_slope(sums.cast<double>(), adopted_);
  return {.jab = of_sums.jab, .by_parts = of_sums.by_sum * by_parts.cast<double>()};
}

}  // namespace paints
