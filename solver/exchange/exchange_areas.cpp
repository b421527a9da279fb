#include "solver/exchange/exchange_areas.h"

#include <algorithm>

namespace solver {

using Eigen::Index;

double ExchangeAreas::form_factor(int i, int j) const {
  const double stored = scaling[i] * unscaled.at(i, j) * scaling[j] / area_m2[i];
  const int n = patches(), slope = std::max(i, j);
  const bool own = std::min(i, j) < n && slope >= n && slope % n == std::min(i, j);
  return own ? stored + slope_self_m2[slope - n] / area_m2[i] : stored;
}

Bands gather(const ExchangeAreas& exchange, const Bands& v) {
  const Index n = v.rows(), pad = static_cast<Index>(kColumnPad);
  const Index columns = (v.cols() + pad - 1) / pad * pad;
  const Index rows = Index{exchange.unscaled.blocks} * kTile;
  Bands in = Bands::Zero(rows, columns), out(rows, columns);
  in.topLeftCorner(n, v.cols()) = v.colwise() * exchange.scaling;
  multiply(exchange.unscaled, in.data(), out.data(), static_cast<std::size_t>(columns));
  Bands gathered = out.topLeftCorner(n, v.cols()).colwise() * (exchange.scaling / exchange.area_m2);
  const Index patches = exchange.patches();
  for (Index k = 0; k < exchange.slope_self_m2.size(); ++k) {
    const Index slope = patches + k, mean = k % patches;
    const double factor = exchange.slope_self_m2[k] / exchange.area_m2[mean];
    gathered.row(slope) += factor * v.row(mean);
    gathered.row(mean) += factor * v.row(slope);
  }
  return gathered;
}

}  // namespace solver
