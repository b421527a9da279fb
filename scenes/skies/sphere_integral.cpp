#include "scenes/skies/sphere_integral.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace scenes {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

struct Span {
  double from = 0, to = pi;
};

/// Polar angles chi of one azimuth for which n . d > 0: R cos(chi - phase) > 0.
Span in_front(double along_axis, double across, Span span) {
  const double phase = std::atan2(across, along_axis);
  for (const double turn : {-2 * pi, 0.0, 2 * pi}) {
    const double from = phase + turn - pi / 2, to = phase + turn + pi / 2;
    if (to <= 0 || from >= pi) continue;
    return {std::max(span.from, from), std::min(span.to, to)};
  }
  return {0, 0};
}

}  // namespace

/// Newton's method on the Legendre polynomial.
GaussLegendre::GaussLegendre(int points) {
  for (int i = 0; i < points; ++i) {
    double x = -std::cos(pi * (i + 0.75) / (points + 0.5)), slope = 1;
    for (int step = 0; step < 100; ++step) {
      double before = 1, value = x;
      for (int k = 2; k <= points; ++k) {
        const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
        before = value;
        value = next;
      }
      if (points == 1) before = 1;
      slope = points * (x * value - before) / (x * x - 1);
      const double move = value / slope;
      x -= move;
      if (std::abs(move) < 1e-15) break;
    }
    node.push_back((1 + x) / 2);
    weight.push_back(1 / ((1 - x * x) * slope * slope));
  }
}

void for_directions(const Vector3d& axis, const std::vector<Vector3d>& planes,
                    const std::function<void(const Vector3d&, double)>& add) {
  static const GaussLegendre azimuths(12), angles(24);
  const Vector3d u = axis.unitOrthogonal(), v = axis.cross(u);
  std::vector<double> cuts;
  for (int k = 0; k <= 8; ++k) cuts.push_back(-pi + k * pi / 4);
  const auto cut_at = [&](const Vector3d& meeting) {
    if (meeting.norm() < 1e-12) return;
    for (const double sign : {1.0, -1.0}) {
      cuts.push_back(std::atan2(sign * meeting.dot(v), sign * meeting.dot(u)));
    }
  };
  for (std::size_t i = 0; i < planes.size(); ++i) {
    cut_at(axis.cross(planes[i]));
    for (std::size_t j = 0; j < i; ++j) cut_at(planes[i].cross(planes[j]));
  }
  std::ranges::sort(cuts);
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    const double width = cuts[k + 1] - cuts[k];
    if (width < 1e-14) continue;
    for (std::size_t p = 0; p < azimuths.node.size(); ++p) {
      const double psi = cuts[k] + width * azimuths.node[p];
      const Vector3d across = std::cos(psi) * u + std::sin(psi) * v;
      Span span;
      for (const Vector3d& n : planes) span = in_front(n.dot(axis), n.dot(across), span);
      if (span.to <= span.from) continue;
      const double length = span.to - span.from;
      for (std::size_t q = 0; q < angles.node.size(); ++q) {
        const double chi = span.from + length * angles.node[q], sine = std::sin(chi);
        add(std::cos(chi) * axis + sine * across,
            width * azimuths.weight[p] * length * angles.weight[q] * sine);
      }
    }
  }
}

}  // namespace scenes
