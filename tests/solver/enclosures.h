#pragma once
#include <random>

#include "solver/bounce/radiosity.h"
#include "solver/exchange/exchange.h"

namespace solver {

inline constexpr int kPatches = 150;  ///< two whole tiles and a part of a third

/// A closed enclosure without geometry: any symmetric positive matrix closes by scaling.
inline ExchangeAreas random_enclosure(int patches, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  const Eigen::ArrayXd area =
      Eigen::ArrayXd::NullaryExpr(patches, [&] { return 0.1 + uniform(random); });
  Eigen::MatrixXd x =
      Eigen::MatrixXd::NullaryExpr(patches, patches, [&] { return uniform(random); });
  x = area.matrix().asDiagonal() * x * area.matrix().asDiagonal();
  x = (x + x.transpose()).eval();
  x.diagonal().setZero();
  return close_exchange(x / (kPatches * 0.6), area);
}

inline Bands random_bands(int rows, int columns, double most, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, most);
  return Bands::NullaryExpr(rows, columns, [&] { return uniform(random); });
}

inline Eigen::MatrixXd dense(const ExchangeAreas& exchange) {
  return Eigen::MatrixXd::NullaryExpr(exchange.patches(), exchange.patches(), [&](auto i, auto j) {
    return exchange.form_factor(static_cast<int>(i), static_cast<int>(j));
  });
}

}  // namespace solver
