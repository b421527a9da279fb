#include "paints/bounded_least_squares.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <vector>

namespace paints {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// -1 held at `low`, 1 held at `high`, 0 free.
using Held = std::vector<int>;

std::vector<Index> free_of(const Held& held) {
  std::vector<Index> free;
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (held[i] == 0) free.push_back(static_cast<Index>(i));
  }
  return free;
}

/// Frees the held unknown that pulls inwards most; false if none does.
bool release(Held& held, const VectorXd& pull, double tolerance) {
  std::size_t best = held.size();
  double most = tolerance;
  for (std::size_t i = 0; i < held.size(); ++i) {
    const double inwards = -held[i] * pull[static_cast<Index>(i)];
    if (inwards > most) {
      most = inwards;
      best = i;
    }
  }
  if (best == held.size()) return false;
  held[best] = 0;
  return true;
}

}  // namespace

VectorXd bounded_least_squares(const MatrixXd& a, const VectorXd& b, const VectorXd& low,
                               const VectorXd& high, VectorXd start) {
  VectorXd x = std::move(start);
  Held held(static_cast<std::size_t>(x.size()), 0);
  for (std::size_t i = 0; i < held.size(); ++i) {
    const auto k = static_cast<Index>(i);
    held[i] = x[k] <= low[k] ? -1 : (x[k] >= high[k] ? 1 : 0);
  }
  const double tolerance = 1e-13 * a.norm() * b.norm();
  for (Index step = 0; step < 10 * x.size(); ++step) {
    const std::vector<Index> free = free_of(held);
    const VectorXd residual = b - a * x;
    VectorXd move = VectorXd::Zero(x.size());
    if (!free.empty())
      move(free) = MatrixXd(a(Eigen::all, free)).colPivHouseholderQr().solve(residual);

    double length = 1;  // up to the first bound
    std::size_t blocking = held.size();
    for (const Index k : free) {
      const double room = move[k] < 0 ? low[k] - x[k] : high[k] - x[k];
      if (std::abs(move[k]) > 0 && room / move[k] < length) {
        length = room / move[k];
        blocking = static_cast<std::size_t>(k);
      }
    }
    x += length * move;
    if (blocking < held.size()) {
      const auto k = static_cast<Index>(blocking);
      held[blocking] = move[k] < 0 ? -1 : 1;
      x[k] = move[k] < 0 ? low[k] : high[k];
    } else if (!release(held, a.transpose() * (b - a * x), tolerance)) {
      break;
    }
  }
  return x.cwiseMax(low).cwiseMin(high);
}

}  // namespace paints
