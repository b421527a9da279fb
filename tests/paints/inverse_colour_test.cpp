#include "paints/inverse_colour.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "appearance/spectra/cie_tables.h"
#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/photometry.h"
#include "appearance/viewing_conditions.h"
#include "paints/atlas_file.h"

namespace paints {
namespace {

using Eigen::ArrayXd;
using spectra::kTransportGrid;
using spectra::Spectrum;
using spectra::ViewedLightSlope;

constexpr Eigen::Index kBands = kTransportGrid.count;

Spectrum on_grid(const ArrayXd& values) { return {kTransportGrid, values}; }

ArrayXd lamp(const char* name) {
  const Spectrum shape = spectra::light_on(kTransportGrid, spectra::illuminant(name));
  return spectra::scaled_to_luminous(shape, 500).values;
}

/// An integrating sphere; the share `painted` of it is paint, the rest reflects 0.5. The wall lies
/// in a ring of half paint, half grey, and the field sees the sphere and a little of the lamp.
struct Sphere {
  ArrayXd light;
  double painted = 0.6;

  ViewedLightSlope operator()(const Spectrum& paint) const {
    const ArrayXd& rho = paint.values;
    const ArrayXd mean = painted * rho + (1 - painted) * 0.5;
    const ArrayXd h = light / (1 - mean), dh = painted * h / (1 - mean);
    return {.light = {.sample = on_grid(rho * h),
                      .background = on_grid((0.5 * rho + 0.1) * h),
                      .field = on_grid(mean * h + 0.1 * light),
                      .white = on_grid(h)},
            .by_reflectance = {.sample = on_grid(h + rho * dh),
                               .background = on_grid(0.5 * h + (0.5 * rho + 0.1) * dh),
                               .field = on_grid(painted * h + mean * dh),
                               .white = on_grid(dh)}};
  }
};

/// A chip on a grey table: nothing but the chip depends on the paint, and that linearly.
ViewedLightSlope chip(const ArrayXd& light, const Spectrum& paint) {
  const Spectrum none = spectra::constant(kTransportGrid, 0);
  return {.light = {.sample = on_grid(light * paint.values),
                    .background = on_grid(0.2 * light),
                    .field = on_grid(0.2 * light),
                    .white = on_grid(light)},
          .by_reflectance = {on_grid(light), none, none, none}};
}

Target seen(const spectra::RoomResponseSlope& room, const ArrayXd& rho) {
  const auto view = appearance::view_of_room(room(on_grid(rho)).light);
  return target_of(appearance::ciecam02_forward(view.sample, appearance::adapt(view.conditions)));
}

const ArrayXd& paper(std::size_t index) {
  static const Atlas kAtlas = load_atlas("munsell-nickerson");
  return kAtlas.paints[index].reflectance.values;
}

double roughness(const ArrayXd& rho) {
  return (rho.tail(kBands - 1) - rho.head(kBands - 1)).square().sum();
}

std::vector<WishInLight> same_wish(const Target& target, std::initializer_list<const char*> lamps) {
  std::vector<WishInLight> wishes;
  for (const char* name : lamps) wishes.push_back({Sphere{lamp(name)}, target});
  return wishes;
}

void expect_exact(const InverseColour& found, const std::vector<WishInLight>& wishes) {
  EXPECT_TRUE(found.exact);
  EXPECT_FALSE(found.limit);
  EXPECT_GE(found.reflectance.values.minCoeff(), 0);
  EXPECT_LE(found.reflectance.values.maxCoeff(), 0.999);
  for (const WishInLight& wish : wishes) {
    const Target is = seen(wish.room, found.reflectance.values);
    EXPECT_NEAR(is.lightness, wish.target.lightness, 1e-9);
    EXPECT_NEAR(is.a_c, wish.target.a_c, 1e-9);
    EXPECT_NEAR(is.b_c, wish.target.b_c, 1e-9);
  }
}

// On the chip the wish is XYZ, linear in the reflectance: within the bounds the smoothest one
// solves [D'D W; W' 0] [rho; multipliers] = [0; W' paper].
TEST(InverseColour, OfAChipIsTheDirectSolve) {
  const ArrayXd light = lamp("D65");
  const spectra::RoomResponseSlope room = [&](const Spectrum& rho) { return chip(light, rho); };
  for (const std::size_t index : {60U, 230U, 400U}) {
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(kBands + 3, kBands + 3);
    for (Eigen::Index k = 0; k + 1 < kBands; ++k) {
      system.block<2, 2>(k, k) += Eigen::Matrix2d{{1, -1}, {-1, 1}};
    }
    const Eigen::MatrixXd weights =
        spectra::colour_matching(kTransportGrid).array().colwise() * (light / light.sum());
    system.topRightCorner(kBands, 3) = weights;
    system.bottomLeftCorner(3, kBands) = weights.transpose();
    Eigen::VectorXd right = Eigen::VectorXd::Zero(kBands + 3);
    right.tail<3>() = weights.transpose() * paper(index).matrix();
    const Eigen::VectorXd direct = system.fullPivLu().solve(right).head(kBands);
    ASSERT_GT(direct.minCoeff(), 0);
    ASSERT_LT(direct.maxCoeff(), 0.999);

    const std::vector<WishInLight> wishes{{room, seen(room, paper(index))}};
    const InverseColour found = inverse_colour(wishes);
    expect_exact(found, wishes);
    EXPECT_LT((found.reflectance.values.matrix() - direct).cwiseAbs().maxCoeff(), 1e-7) << index;
  }
}

// Flat is as smooth as can be, and no other flat one is as light.
TEST(InverseColour, OfAGreyIsTheGrey) {
  const Sphere room{lamp("A")};
  const std::vector<WishInLight> wishes{{room, seen(room, ArrayXd::Constant(kBands, 0.37))}};
  const InverseColour found = inverse_colour(wishes);
  EXPECT_TRUE(found.exact);
  EXPECT_LT((found.reflectance.values - 0.37).abs().maxCoeff(), 1e-9);
}

TEST(InverseColour, LooksLikeThePaperAndIsSmoother) {
  for (const double painted : {0.6, 0.95}) {
    const Sphere room{lamp("A"), painted};
    for (const std::size_t index : {5U, 120U, 345U}) {
      const std::vector<WishInLight> wishes{{room, seen(room, paper(index))}};
      const InverseColour found = inverse_colour(wishes);
      expect_exact(found, wishes);
      EXPECT_LT(found.roughness, roughness(paper(index))) << index;
      EXPECT_NEAR(found.roughness, roughness(found.reflectance.values), 1e-15);
    }
  }
}

// What a paper does under three lights, a smoother metamer does as well.
TEST(InverseColour, HoldsUnderThreeLights) {
  std::vector<WishInLight> wishes;
  for (const char* name : {"D65", "A", "D50"}) {
    const Sphere room{lamp(name)};
    wishes.push_back({room, seen(room, paper(230))});
  }
  const InverseColour found = inverse_colour(wishes);
  expect_exact(found, wishes);
  EXPECT_LT(found.roughness, roughness(paper(230)));
}

// gradient + slope' multipliers, by central differences, against what is reported.
TEST(InverseColour, MultipliersMakeTheLagrangianStationary) {
  const Sphere room{lamp("A")};
  const std::vector<WishInLight> wishes{{room, seen(room, paper(345))}};
  const InverseColour found = inverse_colour(wishes);
  EXPECT_LT(found.stationarity, 1e-6);
  const auto lagrangian = [&](const ArrayXd& rho) {
    const Target t = seen(room, rho);
    return roughness(rho) / 2 +
           found.multipliers.col(0).dot(Eigen::Vector3d(t.lightness, t.a_c, t.b_c));
  };
  for (Eigen::Index k = 0; k < kBands; ++k) {
    ArrayXd up = found.reflectance.values, down = up;
    up[k] += 1e-5, down[k] -= 1e-5;
    EXPECT_NEAR((lagrangian(up) - lagrangian(down)) / 2e-5, found.bound_multipliers[k], 1e-6) << k;
  }
}

// A wall of step functions is as saturated as its lightness allows [MacAdam1935].
TEST(InverseColour, BoundsHoldAndPushOutwards) {
  const Sphere room{lamp("D65")};
  ArrayXd steps = ArrayXd::Zero(kBands);
  steps.segment(12, 12) = 0.999;
  const std::vector<WishInLight> wishes{{room, seen(room, steps)}};
  const InverseColour found = inverse_colour(wishes);
  EXPECT_LT(found.distance, 1e-3);
  int at_bounds = 0;
  for (Eigen::Index k = 0; k < kBands; ++k) {
    const double rho = found.reflectance.values[k], push = found.bound_multipliers[k];
    if (push > 1e-3) {
      EXPECT_EQ(rho, 0) << k;
    }
    if (push < -1e-3) {
      EXPECT_EQ(rho, 0.999) << k;
    }
    at_bounds += rho == 0 || rho == 0.999 ? 1 : 0;
  }
  EXPECT_GT(at_bounds, 10);
}

class OutOfReach : public testing::Test {
 protected:
  /// Random step functions, which look like the most that paints can do.
  ArrayXd random_steps() {
    std::uniform_int_distribution<Eigen::Index> band(0, kBands);
    Eigen::Index from = band(random_), to = band(random_);
    if (from > to) std::swap(from, to);
    const bool inside = random_() % 2 == 0;
    ArrayXd rho = ArrayXd::Constant(kBands, inside ? 0 : 0.999);
    rho.segment(from, to - from) = inside ? 0.999 : 0;
    return rho;
  }

  static double distance(const std::vector<WishInLight>& wishes, const ArrayXd& rho) {
    double squares = 0;
    for (const WishInLight& wish : wishes) {
      const auto view = appearance::view_of_room(wish.room(on_grid(rho)).light);
      const auto k = appearance::ciecam02_forward(view.sample, appearance::adapt(view.conditions));
      if (!k.status.all_defined()) return std::numeric_limits<double>::infinity();
      const Target t = target_of(k);
      squares += std::pow(t.lightness - wish.target.lightness, 2) +
                 std::pow(t.a_c - wish.target.a_c, 2) + std::pow(t.b_c - wish.target.b_c, 2);
    }
    return std::sqrt(squares / static_cast<double>(wishes.size()));
  }

  std::mt19937 random_{5};
};

TEST_F(OutOfReach, NearestIsNoFartherThanAnyOtherPaint) {
  const auto one = same_wish({.lightness = 75, .a_c = 60, .b_c = 100}, {"D65"});
  const auto two = same_wish({.lightness = 60, .a_c = 45, .b_c = 20}, {"D65", "A"});
  for (const auto& wishes : {one, two}) {
    const InverseColour found = inverse_colour(wishes);
    EXPECT_FALSE(found.exact);
    EXPECT_LT(found.stationarity, 1e-5);
    EXPECT_NEAR(found.distance, distance(wishes, found.reflectance.values), 1e-9);
    for (int i = 0; i < 300; ++i) EXPECT_GE(distance(wishes, random_steps()), found.distance);
    for (std::size_t i = 0; i < 462; i += 20) {
      EXPECT_GE(distance(wishes, paper(i)), found.distance);
    }
  }
}

TEST_F(OutOfReach, IsProvenByAPlaneThatNoPaintPasses) {
  const auto wishes = same_wish({.lightness = 60, .a_c = 45, .b_c = 20}, {"D65", "A"});
  const InverseColour found = inverse_colour(wishes);
  ASSERT_TRUE(found.limit);
  const ColourLimit& limit = *found.limit;
  EXPECT_TRUE(limit.proves());
  EXPECT_FALSE(limit.no_stimulus);
  EXPECT_GT(limit.wished - limit.bound, 0.01);
  EXPECT_NEAR(limit.normal.norm(), 1, 1e-12);
  const auto along = [&](const ArrayXd& rho) {
    double sum = 0;
    for (std::size_t l = 0; l < wishes.size(); ++l) {
      const auto white = spectra::absolute_xyz(wishes[l].room(found.reflectance).light.white);
      const auto [x, y, z] = spectra::relative_xyz(
          spectra::absolute_xyz(wishes[l].room(on_grid(rho)).light.sample), white.y);
      sum += limit.normal.col(static_cast<Eigen::Index>(l)).dot(Eigen::Vector3d(x, y, z));
    }
    return sum;
  };
  double farthest = 0;
  for (int i = 0; i < 1000; ++i) farthest = std::max(farthest, along(random_steps()));
  EXPECT_LE(farthest, limit.bound);
  std::uniform_real_distribution<double> uniform(0, 0.999);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_LE(along(ArrayXd::NullaryExpr(kBands, [&] { return uniform(random_); })), limit.bound);
  }
}

// An attainable wish has no such plane, whatever the state of the eye that brings it about.
TEST_F(OutOfReach, IsNotProvenOfWhatAPaintDoes) {
  std::vector<WishInLight> wishes;
  for (const char* name : {"D65", "A"}) {
    const Sphere room{lamp(name)};
    wishes.push_back({room, seen(room, paper(120))});
  }
  const ColourLimit limit = colour_limit(wishes, on_grid(paper(120)), {});
  EXPECT_FALSE(limit.proves());
}

TEST_F(OutOfReach, WishThatNoStimulusGivesSaysSo) {
  const auto wishes = same_wish({.lightness = 0, .a_c = 40, .b_c = 0}, {"D65"});
  EXPECT_TRUE(colour_limit(wishes, on_grid(paper(120)), {}).no_stimulus);
}

TEST(InverseColour, RefusesWhatHasNoMeaning) {
  const Target grey{.lightness = 50};
  EXPECT_THROW((void)inverse_colour({}), std::invalid_argument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)inverse_colour(same_wish({.lightness = nan}, {"D65"})), std::invalid_argument);
  for (const double most : {0.0, 1.0, nan}) {
    EXPECT_THROW((void)inverse_colour(same_wish(grey, {"D65"}), {.viewing = {}, .most = most}),
                 std::invalid_argument);
  }
  const std::vector<WishInLight> dark{{Sphere{ArrayXd::Zero(kBands)}, grey}};
  EXPECT_THROW((void)inverse_colour(dark), std::domain_error);
}

}  // namespace
}  // namespace paints
