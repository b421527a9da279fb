#include "appearance/ciede2000.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace appearance {
namespace {

constexpr double kPi = std::numbers::pi, kDegree = kPi / 180;

/// Cube root, continued by its tangent at (6/29)^3.
double compressed(double ratio) {
  constexpr double kKnee = 6. / 29;
  return ratio > kKnee * kKnee * kKnee ? std::cbrt(ratio) : ratio / (3 * kKnee * kKnee) + 4. / 29;
}

double seventh_power_share(double c) {
  const double c7 = std::pow(c, 7);
  return std::sqrt(c7 / (c7 + std::pow(25., 7)));
}

/// Within 0..2 pi, from at most one turn outside.
double full_circle(double angle) {
  return angle < 0 ? angle + 2 * kPi : angle >= 2 * kPi ? angle - 2 * kPi : angle;
}

}  // namespace

Lab cielab(const spectra::RelativeXyz& sample, const spectra::RelativeXyz& white) {
  if (!(white.x > 0 && white.y > 0 && white.z > 0)) {
    throw std::domain_error("CIELAB needs a white with X, Y and Z above 0");
  }
  const double x = compressed(sample.x / white.x), y = compressed(sample.y / white.y),
               z = compressed(sample.z / white.z);
  return {.l = 116 * y - 16, .a = 500 * (x - y), .b = 200 * (y - z)};
}

double ciede2000(const Lab& p, const Lab& q) {
  const double mean_c = (std::hypot(p.a, p.b) + std::hypot(q.a, q.b)) / 2;
  const double stretch = 1 + (1 - seventh_power_share(mean_c)) / 2;  // of a*, for greys
  const double ap = stretch * p.a, aq = stretch * q.a;
  const double cp = std::hypot(ap, p.b), cq = std::hypot(aq, q.b), c = (cp + cq) / 2;
  const double hp = full_circle(std::atan2(p.b, ap)), hq = full_circle(std::atan2(q.b, aq));

  // The mean hue lies on the shorter arc; a colour without chroma has no say in it.
  const bool hues = cp > 0 && cq > 0;
  const double turn = hues ? std::remainder(hq - hp, 2 * kPi) : 0;
  const double h = hues ? full_circle(hp + turn / 2) : hp + hq;

  const double t = 1 - 0.17 * std::cos(h - 30 * kDegree) + 0.24 * std::cos(2 * h) +
                   0.32 * std::cos(3 * h + 6 * kDegree) - 0.20 * std::cos(4 * h - 63 * kDegree);
  const double from_50 = std::pow((p.l + q.l) / 2 - 50, 2);
  const double s_l = 1 + 0.015 * from_50 / std::sqrt(20 + from_50);
  const double s_c = 1 + 0.045 * c, s_h = 1 + 0.015 * c * t;
  const double blue = 30 * kDegree * std::exp(-std::pow((h / kDegree - 275) / 25, 2));
  const double rotation = -2 * seventh_power_share(c) * std::sin(2 * blue);

  const double dl = (q.l - p.l) / s_l, dc = (cq - cp) / s_c,
               dh = 2 * std::sqrt(cp * cq) * std::sin(turn / 2) / s_h;
  return std::sqrt(dl * dl + dc * dc + dh * dh + rotation * dc * dh);
}

}  // namespace appearance
