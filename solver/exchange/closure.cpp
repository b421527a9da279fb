#include "solver/exchange/closure.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace solver {
namespace {

using Eigen::ArrayXd;

constexpr double kClosed = 2e-15;     ///< defect at which rounding takes over
constexpr double kSettled = 1e-10;    ///< defect above which scaling has failed
constexpr int kMostNewtonSteps = 30;  ///< 4 are usual
constexpr int kMostInnerSteps = 200;
constexpr double kMostReduction = 1e-5;  ///< of the residual within a Newton step

/// The rows of X that belong to means, times values of means.
ArrayXd means_times(const SymmetricTiles& tiles, const ArrayXd& v) {
  ArrayXd in = ArrayXd::Zero(Eigen::Index{tiles.blocks} * kTile), out(in.size());
  in.head(v.size()) = v;
  multiply(tiles, in.data(), out.data());
  return out.head(v.size());
}

/// M e = b with M = diag(m) + D X D, positive semi-definite because the entries of X are
/// non-negative and m = D X d are its row sums.
ArrayXd solve_newton_system(const SymmetricTiles& tiles, const ArrayXd& d, const ArrayXd& m,
                            const ArrayXd& b, double reduction) {
  ArrayXd e = ArrayXd::Zero(b.size()), r = b, p = b / m;
  double rz = (r * p).sum();
  const double enough = reduction * reduction * rz;
  for (int k = 0; k < kMostInnerSteps && rz > enough; ++k) {
    const ArrayXd mp = m * p + d * means_times(tiles, d * p);
    const double alpha = rz / (p * mp).sum();
    e += alpha * p;
    r -= alpha * mp;
    const ArrayXd z = r / m;
    const double next = (r * z).sum();
    p = z + next / rz * p;
    rz = next;
  }
  return e;
}

/// Rows of F squared over A_j, summed: the gather norms.
ArrayXd gather_norms(const ExchangeAreas& x) {
  const SymmetricTiles& tiles = x.unscaled;
  const int n = x.rows();
  const ArrayXd weight = x.scaling.square() / x.area_m2;
  ArrayXd norm(n);
  tbb::parallel_for(0, tiles.blocks, [&](int row) {
    std::array<double, kTile> sum{};
    for (int column = 0; column < tiles.blocks; ++column) {
      const std::int64_t at =
          tiles.offset[tiles.index(std::min(row, column), std::max(row, column))];
      if (at == SymmetricTiles::kAbsent) continue;
      const float* tile = &tiles.values[static_cast<std::size_t>(at)];
      const int last = std::min(kTile, n - column * kTile);
      for (int k = 0; k < last; ++k) {
        const double w = weight[column * kTile + k];
        for (int r = 0; r < kTile; ++r) {
          const double v = column < row ? tile[k * kTile + r] : tile[r * kTile + k];
          sum[static_cast<std::size_t>(r)] += w * v * v;
        }
      }
    }
    for (int r = 0; r < std::min(kTile, n - row * kTile); ++r) {
      const int i = row * kTile + r;
      norm[i] = x.scaling[i] / x.area_m2[i] * std::sqrt(sum[static_cast<std::size_t>(r)]);
    }
  });
  for (Eigen::Index k = 0; k < x.slope_self_m2.size(); ++k) {  // one entry more on either side
    const Eigen::Index slope = x.patches() + k, mean = slope % x.patches();
    const double entry = x.slope_self_m2[k] / std::pow(x.area_m2[mean], 1.5);
    for (const Eigen::Index row : {slope, mean}) norm[row] = std::hypot(norm[row], entry);
  }
  return norm;
}

/// Only the diagonal tiles hold an entry twice; everything else is symmetric by storage.
double stored_asymmetry(const ExchangeAreas& x) {
  double worst = 0;
  for (int b = 0; b < x.unscaled.blocks; ++b) {
    const std::int64_t at = x.unscaled.offset[x.unscaled.index(b, b)];
    if (at == SymmetricTiles::kAbsent) continue;
    const Eigen::Map<const Eigen::Matrix<float, kTile, kTile, Eigen::RowMajor>> tile(
        &x.unscaled.values[static_cast<std::size_t>(at)]);
    const int size = std::min(kTile, x.rows() - b * kTile);
    for (int r = 0; r < size; ++r) {
      for (int c = 0; c < size; ++c) {
        const int i = b * kTile + r, j = b * kTile + c;
        const double difference = static_cast<double>(tile(r, c)) - tile(c, r);
        worst = std::max(worst, std::abs(x.scaling[i] * difference * x.scaling[j]) / x.area_m2[i]);
      }
    }
  }
  return worst;
}

/// Newton's method for d with d_i sum_j X_ij d_j = A_i. @return the relative defect that is left,
/// per patch
ArrayXd scale_to_close(ExchangeAreas& x, const ArrayXd& sees) {
  const ArrayXd area = x.area_m2.head(x.patches());
  ArrayXd d = sees;
  // A patch that sees nothing has an empty row: 1 in place of its row sum keeps the systems
  // regular.
  ArrayXd m = d * means_times(x.unscaled, d) + (1 - sees);
  ArrayXd defect = sees * (area - m);
  const auto worst = [&] { return (defect / area).abs().maxCoeff(); };
  double last = 1e300;
  for (int step = 0; step < kMostNewtonSteps && worst() > kClosed && worst() < last; ++step) {
    last = worst();
    const double reduction = std::max(kMostReduction, 0.3 * kClosed / last);
    const ArrayXd e = solve_newton_system(x.unscaled, d, m, defect, reduction);
    d *= (1 + e).max(0.5).min(2.0);
    m = d * means_times(x.unscaled, d) + (1 - sees);
    defect = sees * (area - m);
  }
  x.scaling = d.replicate(x.modes, 1);
  return (defect / area).abs();
}

/// A_i F_ii, m^2; makes room for it where a tile was not stored.
void set_self_exchange(SymmetricTiles& tiles, int patch, double exchange_area_m2) {
  const int block = patch / kTile, line = patch % kTile;
  std::int64_t& at = tiles.offset[tiles.index(block, block)];
  if (at == SymmetricTiles::kAbsent) {
    at = static_cast<std::int64_t>(tiles.values.size());
    tiles.values.resize(tiles.values.size() + std::size_t{kTile} * kTile);
  }
  tiles.values[static_cast<std::size_t>(at + std::int64_t{line} * kTile + line)] =
      static_cast<float>(exchange_area_m2);
}

/// X d, the slopes of d being 0: what all rows get of light that is even everywhere.
ArrayXd rows_times_means(const ExchangeAreas& x) {
  ArrayXd in = ArrayXd::Zero(Eigen::Index{x.unscaled.blocks} * kTile), out(in.size());
  in.head(x.patches()) = x.scaling.head(x.patches());
  multiply(x.unscaled, in.data(), out.data());
  return out.head(x.rows());
}

/// What the slopes' rows make of light that is constant becomes, with the sign turned, an exchange
/// with the patch's own mean: in X as far as float goes, the rest beside it.
void close_slopes(ExchangeAreas& x) {
  const int n = x.patches(), slopes = x.rows() - n;
  const ArrayXd& d = x.scaling;
  const auto defect_m2 = [&] { return ArrayXd(d.tail(slopes) * rows_times_means(x).tail(slopes)); };
  const ArrayXd before = defect_m2();
  x.largest_slope_defect = (before / x.area_m2.tail(slopes)).abs().maxCoeff();
  for (int k = 0; k < slopes; ++k) {
    const int mean = k % n;
    if (d[mean] > 0) {
      x.unscaled.set(n + k, mean, static_cast<float>(-before[k] / (d[mean] * d[mean])));
    }
  }
  x.slope_self_m2 = -defect_m2();
}

}  // namespace

/// In a narrow gap two patches see little but each other. If one of the two sees a trace of the
/// room, by the luck of its rays, and the other does not, no scaling closes both rows. Such patches
/// are let see themselves a little, which takes up the difference.
void close(ExchangeAreas& x) {
  constexpr double kWorst = 0.1, kStrained = 0.1, kLeastShare = 1e-4, kMostShare = 0.2;
  const ArrayXd ones = ArrayXd::Ones(x.patches());
  const ArrayXd sees = (means_times(x.unscaled, ones) > 0).cast<double>();
  for (int i = 0; i < x.patches(); ++i) {
    if (sees[i] == 0) x.isolated.push_back(i);
  }
  ArrayXd defect = scale_to_close(x, sees);
  for (double share = kLeastShare; defect.maxCoeff() > kSettled && share < kMostShare; share *= 4) {
    const double most = kWorst * defect.maxCoeff();
    const auto strained =
        (defect > most || (sees * (x.scaling.head(x.patches()) - 1)).abs() > kStrained).eval();
    for (int i = 0; i < x.patches(); ++i) {
      if (strained[i]) set_self_exchange(x.unscaled, i, share * x.area_m2[i]);
    }
    defect = scale_to_close(x, sees);
    x.largest_self_view = share;
  }
  x.closure_defect = defect.maxCoeff();
  x.largest_scaling = (sees * (x.scaling.head(x.patches()) - 1)).abs().maxCoeff();
  if (x.modes > 1) close_slopes(x);
  x.gather_norm = gather_norms(x);
  x.reciprocity_defect = stored_asymmetry(x);
}

}  // namespace solver
