#include "solver/factors/rectangle_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace solver {
namespace {

using Real = long double;

/// sum over the corners of both rectangles of (-1)^(i+j+k+l) G
template <typename Function>
Real corner_sum(const RectanglePair& p, Function g) {
  const auto along = [&](Real x, Real xi) {
    const Real from = p.y.from, to = p.y.to, eta_from = p.eta.from, eta_to = p.eta.to;
    return g(x, xi, from - eta_from) - g(x, xi, from - eta_to) - g(x, xi, to - eta_from) +
           g(x, xi, to - eta_to);
  };
  return along(p.x.from, p.xi.from) - along(p.x.from, p.xi.to) - along(p.x.to, p.xi.from) +
         along(p.x.to, p.xi.to);
}

/// The textbook's 16 terms in more digits.
Real textbook(const RectanglePair& p) {
  constexpr Real kTwoPi = 2 * std::numbers::pi_v<Real>;
  if (p.planes == Planes::parallel) {
    const Real z2 = static_cast<Real>(p.gap_m) * p.gap_m;
    return corner_sum(p,
                      [z2](Real x, Real xi, Real v) {
                        const Real u = x - xi, a = std::sqrt(u * u + z2), b = std::sqrt(v * v + z2);
                        return v * a * std::atan(v / a) + u * b * std::atan(u / b) -
                               z2 / 2 * std::log(u * u + v * v + z2);
                      }) /
           kTwoPi;
  }
  return corner_sum(p,
                    [](Real x, Real xi, Real d) -> Real {
                      const Real c2 = x * x + xi * xi, c = std::sqrt(c2), d2 = d * d;
                      if (c2 + d2 == 0) return 0;
                      return (c > 0 ? d * c * std::atan(d / c) : 0) -
                             (c2 - d2) / 4 * std::log(c2 + d2);
                    }) /
         kTwoPi;
}

/// Squared distance of the farthest corners.
double reach_m2(const RectanglePair& p) {
  const auto farthest = [](Span a, Span b) { return std::max(a.to - b.from, b.to - a.from); };
  const double v = farthest(p.y, p.eta);
  if (p.planes == Planes::perpendicular) return p.x.to * p.x.to + p.xi.to * p.xi.to + v * v;
  const double u = farthest(p.x, p.xi);
  return u * u + v * v + p.gap_m * p.gap_m;
}

/// Sides of 0.1 to 1.1 m up to `reach_m` apart; every third pair touches or lies face to face.
RectanglePair random_pair(Planes planes, double reach_m, int n, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const auto span = [&](double from_m) { return Span{from_m, from_m + 0.1 + unit(random)}; };
  const double apart = n % 3 == 0 ? 0 : reach_m;
  RectanglePair p{.planes = planes,
                  .x = span(0),
                  .y = span(0),
                  .xi = span(apart * unit(random)),
                  .eta = span(reach_m * unit(random))};
  if (n % 3 == 0) p.eta = p.y;
  if (planes == Planes::parallel) p.gap_m = 0.01 + reach_m * unit(random);
  return p;
}

class RectanglePairs : public testing::TestWithParam<Planes> {};

TEST_P(RectanglePairs, AgreeWithTheTextbookToRounding) {
  std::mt19937 random(11);
  for (const double reach : {0.1, 1.0, 10.0}) {
    for (int n = 0; n < 1000; ++n) {
      const RectanglePair pair = random_pair(GetParam(), reach, n, random);
      EXPECT_NEAR(exchange_area(pair), static_cast<double>(textbook(pair)),
                  kClosedFormRounding * reach_m2(pair))
          << reach << " " << n;
    }
  }
}

// Any number of pairs, in vectors of any length: each gives the bits that it gives alone.
TEST_P(RectanglePairs, BatchGivesTheBitsOfSinglePairs) {
  std::mt19937 random(12);
  RectangleBatch batch(GetParam());
  for (const std::size_t size : {std::size_t{1}, std::size_t{13}, RectangleBatch::kCapacity}) {
    std::vector<double> alone;
    for (std::size_t k = 0; k < size; ++k) {
      const RectanglePair pair = random_pair(GetParam(), 1, static_cast<int>(k), random);
      batch.add(pair);
      alone.push_back(exchange_area(pair));
    }
    EXPECT_EQ(batch.size(), size);
    const RectangleBatch::Values& values = batch.evaluate();
    for (std::size_t k = 0; k < size; ++k) EXPECT_EQ(values[k], alone[k]) << size << " " << k;
    EXPECT_EQ(batch.size(), 0U);
  }
}

INSTANTIATE_TEST_SUITE_P(Planes, RectanglePairs,
                         testing::Values(Planes::parallel, Planes::perpendicular),
                         [](const auto& test) {
                           return test.param == Planes::parallel ? "parallel" : "perpendicular";
                         });

}  // namespace
}  // namespace solver
