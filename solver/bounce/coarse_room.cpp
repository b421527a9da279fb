#include "solver/bounce/coarse_room.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;

/// Where a bounce leaves less of the light, plain iterations are as fast in total.
constexpr double kLongLived = 0.95;

/// Sums of the patches' means over each cluster.
Bands summed(const std::vector<int>& cluster, Index clusters, const Bands& rows) {
  Bands sum = Bands::Zero(clusters, rows.cols());
  for (std::size_t i = 0; i < cluster.size(); ++i) {
    sum.row(cluster[i]) += rows.row(static_cast<Index>(i));
  }
  return sum;
}

}  // namespace

CoarseRoom::CoarseRoom(const RadiositySystem& system) : exchange_(system.exchange) {
  if (cluster().empty() || system.contraction.maxCoeff() < kLongLived) return;
  const Bands& reflectance = system.reflector.numbers();
  area_m2_ = summed(cluster(), clusters(), exchange_.area_m2).col(0);
  const Bands reflecting_m2 =
      summed(cluster(), clusters(), reflectance.colwise() * exchange_.area_m2);
  q_ = reflecting_m2.sqrt().colwise() / area_m2_;
  const Bands scale = (reflecting_m2 > 0).select(reflecting_m2.rsqrt(), 0.0);
  weights_ = (reflectance.colwise() * exchange_.area_m2).sqrt().topRows(exchange_.patches());
  for (Index i = 0; i < weights_.rows(); ++i) {
    weights_.row(i) *= scale.row(cluster()[static_cast<std::size_t>(i)]);
  }
  const MatrixXd identity = MatrixXd::Identity(clusters(), clusters());
  for (Index k = 0; k < q_.cols(); ++k) {
    const auto q = q_.col(k).matrix().asDiagonal();
    const Eigen::LLT<MatrixXd> factor(identity - q * exchange_.cluster_exchange_m2 * q);
    // Where rho is 1 to within rounding there may be no factor; then there is no correction.
    inverse_.push_back(factor.info() == Eigen::Success ? MatrixXd(factor.solve(identity))
                                                       : identity);
  }
}

/// With t the mean of what a cluster has sent, its irradiance w obeys A w = X_c (t + mean rho w); u
/// = sqrt(mean rho A) w solves M_c u = q X_c t.
Bands CoarseRoom::irradiance(const Bands& sent) const {
  const Bands t =
      summed(cluster(), clusters(), sent.colwise() * exchange_.area_m2).colwise() / area_m2_;
  const MatrixXd arriving = exchange_.cluster_exchange_m2 * t.matrix();
  Bands w(clusters(), t.cols());
  for (Index k = 0; k < t.cols(); ++k) {
    const ArrayXd q = q_.col(k);
    const Eigen::VectorXd u = inverse(k) * (q * arriving.col(k).array()).matrix();
    w.col(k) = (q > 0).select(u.array() / (q * area_m2_), 0.0);
  }
  Bands all = Bands::Zero(sent.rows(), sent.cols());
  all.topRows(exchange_.patches()) = w(cluster(), Eigen::all);
  return all;
}

}  // namespace solver
