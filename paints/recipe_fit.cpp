#include "paints/recipe_fit.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

namespace paints {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMostSteps = 60;
constexpr double kNoGain = 1e-12;      // of the distance
constexpr double kMostDamping = 1e10;  // where steps have become smaller than rounding
constexpr int kReach = 2;              // units

using Units = Eigen::Vector4i;

double distance(const Eigen::Vector3d& jab, const Eigen::Vector3d& wish) {
  const double d = (jab - wish).norm();
  return std::isfinite(d) ? d : kInfinity;
}

/// One damped step of the parts that are free to move, cut where parts would fall below 0.
Parts stepped(const Parts& parts, const Eigen::Matrix4d& curvature, const Parts& gradient,
              double damping) {
  Eigen::Matrix4d system = curvature;
  Parts right = -gradient;
  const double floor = 1e-12 * curvature.diagonal().maxCoeff();
  for (int i = 0; i < kMostBases; ++i) {
    system(i, i) += damping * curvature(i, i) + floor;
    if (parts[i] > 0 || gradient[i] < 0) continue;
    system.row(i).setZero();
    system.col(i).setZero();
    system(i, i) = 1;
    right[i] = 0;
  }
  const Parts next = (parts + Parts(system.ldlt().solve(right))).cwiseMax(0);
  const double sum = next.sum();
  return sum > 0 && std::isfinite(sum) ? Parts(next / sum) : parts;
}

/// Calls `visit` for all counts within kReach of `centre` whose sum is `units`.
template <typename Visit>
void visit_around(const Units& centre, int count, int units, const Visit& visit) {
  const int last = count - 1;
  Units offset = Units::Zero();
  offset.head(last).setConstant(-kReach);
  while (true) {
    Units tried = centre + offset;
    tried[last] = units - tried.head(last).sum();
    if ((tried.array() >= 0).all()) visit(tried);
    int i = 0;
    while (i < last && offset[i] == kReach) offset[i++] = -kReach;
    if (i == last) return;
    ++offset[i];
  }
}

}  // namespace

Fit fit_parts(const PartsToJabSlope& look, const Eigen::Vector3d& wish, const Parts& start,
              const Parts& strength) {
  const auto parts_of = [&](const Parts& at) { return Parts(at.cwiseQuotient(strength)); };
  Parts at = start.cwiseProduct(strength);
  at /= at.sum();
  JabOfParts seen = look(parts_of(at));
  double nearest = distance(seen.jab, wish), damping = 1e-3;
  for (int i = 0; i < kMostSteps && nearest > 0 && nearest < kInfinity && damping < kMostDamping;
       ++i) {
    const Eigen::Matrix<double, 3, kMostBases> slope =
        seen.by_parts * strength.cwiseInverse().asDiagonal();
    const Parts gradient = slope.transpose() * (seen.jab - wish);
    const Parts next = stepped(at, slope.transpose() * slope, gradient, damping);
    const JabOfParts there = look(parts_of(next));
    const double d = distance(there.jab, wish);
    if (!(d < nearest)) {
      damping *= 10;
      continue;
    }
    const double gain = nearest - d;
    at = next, seen = there, nearest = d, damping *= 0.1;
    if (gain <= kNoGain * (1 + nearest)) break;
  }
  const Parts parts = parts_of(at);
  return {.parts = parts / parts.sum(), .distance = nearest};
}

Fit fit_units(const PartsToJab& look, const Eigen::Vector3d& wish, const Parts& parts, int count,
              int units) {
  Units best = (parts * units / parts.sum()).array().round().cast<int>();
  Eigen::Index most = 0;
  parts.maxCoeff(&most);
  best[most] += units - best.sum();
  double nearest = kInfinity;
  while (true) {
    const Units centre = best;
    visit_around(centre, count, units, [&](const Units& tried) {
      const double d = distance(look(tried.cast<double>() / units), wish);
      if (d < nearest) nearest = d, best = tried;
    });
    if (best == centre) break;
  }
  return {.parts = best.cast<double>() / units, .distance = nearest};
}

}  // namespace paints
