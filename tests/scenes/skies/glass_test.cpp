#include "scenes/skies/glass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace scenes {
namespace {

Glass clear(int panes, double at_normal) { return {panes, Eigen::ArrayXd::Constant(1, at_normal)}; }

double at(const Glass& glass, double angle_deg) {
  return glass.transmittance(std::cos(angle_deg * std::numbers::pi / 180))[0];
}

/// By an independent evaluation of Fresnel's equations, to four digits.
TEST(Glass, TransmittanceByAngle) {
  const double single[][2] = {{0, .8800},  {30, .8755}, {50, .8479},
                              {60, .7999}, {70, .6839}, {80, .4235}};
  const double twofold[][2] = {{0, .7792},  {30, .7729}, {50, .7403},
                               {60, .6820}, {70, .5368}, {80, .2613}};
  // A double window of the same panes, which let 0.88 through.
  const double both = at(clear(2, 0.77924), 0);
  EXPECT_NEAR(both, 0.77924, 1e-12);
  for (const auto& [angle, expected] : single)
    EXPECT_NEAR(at(clear(1, 0.88), angle), expected, 6e-5);
  for (const auto& [angle, expected] : twofold) {
    EXPECT_NEAR(at(clear(2, 0.77924), angle), expected, 1e-4);
  }
  EXPECT_NEAR(clear(1, 0.88).diffuse_transmittance()[0] / 0.88, 0.9154, 5e-5);
  EXPECT_NEAR(clear(2, 0.77924).diffuse_transmittance()[0] / 0.77924, 0.8876, 5e-5);
  EXPECT_NEAR(at(clear(1, 0.88), 90), 0, 1e-9);
}

TEST(Glass, WhatIsNotAbsorbedIsReflectedOrTransmitted) {
  for (const int panes : {1, 2}) {
    const Glass glass = clear(panes, Glass::most_at_normal(panes));
    EXPECT_NEAR(glass.diffuse_transmittance()[0] + glass.diffuse_reflectance()[0], 1, 1e-9);
    const Glass dark = clear(panes, 0);
    EXPECT_NEAR(dark.diffuse_transmittance()[0], 0, 1e-12);
    EXPECT_GT(dark.diffuse_reflectance()[0], 0.04);
  }
  EXPECT_NEAR(Glass::most_at_normal(1), 2 * 1.52 / (1 + 1.52 * 1.52), 1e-12);
}

TEST(Glass, BandsByThemselves) {
  const Glass tinted(1, Eigen::Array3d(0.5, 0.7, 0.5));
  EXPECT_EQ(tinted.distinct_transmittance(1).size(), 2);
  const Eigen::ArrayXd slanting = tinted.transmittance(0.4);
  EXPECT_EQ(slanting[0], slanting[2]);
  EXPECT_EQ(slanting[0], clear(1, 0.5).transmittance(0.4)[0]);
  EXPECT_EQ(slanting[1], clear(1, 0.7).transmittance(0.4)[0]);
}

}  // namespace
}  // namespace scenes
