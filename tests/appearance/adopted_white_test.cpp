// The choices of white, background and size: what they must do whatever their numbers are.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "appearance/jab_slope.h"
#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/photometry.h"
#include "appearance/spectra/spectrum_library.h"

namespace appearance {
namespace {

using Eigen::ArrayXd;
using spectra::kTransportGrid;
using spectra::Spectrum;
using spectra::ViewingChoices;

Spectrum on_grid(const ArrayXd& values) { return {kTransportGrid, values}; }

Spectrum lamp() {
  return spectra::scaled_to_luminous(spectra::light_on(kTransportGrid, spectra::illuminant("A")),
                                     500);
}

ArrayXd paper(std::size_t index) {
  return spectra::reflectance_on(kTransportGrid,
                                 spectra::atlas("munsell-nickerson").entries[index].samples)
      .values;
}

/// An integrating sphere painted all over: irradiance E / (1 - rho), and its slope.
spectra::ViewedLightSlope sphere(const ArrayXd& rho) {
  const ArrayXd h = lamp().values / (1 - rho), dh = h / (1 - rho);
  const auto seen = [&](const ArrayXd& share, const ArrayXd& dshare) {
    return std::pair(on_grid(share * h), on_grid(share * dh + dshare * h));
  };
  const ArrayXd one = ArrayXd::Ones(rho.size());
  const auto [sample, dsample] = seen(rho, one);
  const auto [ring, dring] = seen(0.8 * rho + 0.1, 0.8 * one);
  const auto [field, dfield] = seen(0.9 * rho + 0.2, 0.9 * one);
  return {.light = {.sample = sample,
                    .background = ring,
                    .field = field,
                    .white = on_grid(h),
                    .lamps = on_grid(1e-3 * lamp().values),
                    .angle_deg = 40},
          .by_reflectance = {
              .sample = dsample, .background = dring, .field = dfield, .white = on_grid(dh)}};
}

ViewingChoices with_share(double share) { return {.white_share = share}; }

spectra::RelativeXyz white_of(const spectra::ViewedLight& light, double share) {
  return view_of_room(light, with_share(share)).conditions.white;
}

TEST(AdoptedWhite, OfLampsHasTheirColourAndTheYOfTheRoomsWhite) {
  const spectra::ViewedLight light = sphere(paper(117)).light;
  const RoomView lamps = view_of_room(light, with_share(0)), ideal = view_of_room(light);
  const spectra::Xyz a = spectra::absolute_xyz(lamp());
  EXPECT_DOUBLE_EQ(lamps.conditions.white.y, 100);
  EXPECT_NEAR(lamps.conditions.white.x, 100 * a.x / a.y, 1e-11);
  EXPECT_NEAR(lamps.conditions.white.z, 100 * a.z / a.y, 1e-11);
  EXPECT_EQ(lamps.white_luminance_cd_m2, ideal.white_luminance_cd_m2);
  EXPECT_EQ(lamps.conditions.background_y, ideal.conditions.background_y);
}

TEST(AdoptedWhite, ShareOneIsTheRoomsWhiteBitForBit) {
  const spectra::ViewedLight light = sphere(paper(117)).light;
  const Correlates p = seen(view_of_room(light)), q = seen(view_of_room(light, with_share(1)));
  EXPECT_EQ(p.lightness, q.lightness);
  EXPECT_EQ(p.a_c, q.a_c);
  EXPECT_EQ(p.b_c, q.b_c);
}

TEST(AdoptedWhite, MovesSteadilyFromOneWhiteToTheOther) {
  const spectra::ViewedLight light = sphere(paper(117)).light;
  const spectra::RelativeXyz from = white_of(light, 0), to = white_of(light, 1);
  for (int i = 0; i <= 10; ++i) {
    const double share = 0.1 * i;
    const spectra::RelativeXyz white = white_of(light, share);
    EXPECT_NEAR(white.x, from.x + share * (to.x - from.x), 1e-11);
    EXPECT_NEAR(white.z, from.z + share * (to.z - from.z), 1e-11);
  }
  const auto x_of = [&](double share) { return spectra::chromaticity(white_of(light, share)).x; };
  const double sign = x_of(1) - x_of(0);
  for (int i = 0; i < 10; ++i) EXPECT_GT(sign * (x_of(0.1 * i + 0.1) - x_of(0.1 * i)), 0);
}

TEST(AdoptedWhite, OfAGreyRoomIsTheSameForEveryShare) {
  const spectra::ViewedLight light = sphere(ArrayXd::Constant(31, 0.6)).light;
  const Correlates one = seen(view_of_room(light));
  for (const double share : {0.0, 0.3, 0.5, 0.9}) {
    const Correlates p = seen(view_of_room(light, with_share(share)));
    EXPECT_NEAR(p.lightness, one.lightness, 1e-9);
    EXPECT_NEAR(p.a_c, one.a_c, 1e-9);
    EXPECT_NEAR(p.b_c, one.b_c, 1e-9);
  }
}

TEST(AdoptedWhite, WantsLampsWhereTheyCount) {
  spectra::ViewedLight light = sphere(paper(117)).light;
  light.lamps = {};
  EXPECT_NO_THROW((void)view_of_room(light));
  EXPECT_THROW((void)view_of_room(light, with_share(0.5)), std::domain_error);
  light.lamps = spectra::constant(kTransportGrid, 0);
  EXPECT_THROW((void)view_of_room(light, with_share(0)), std::domain_error);
}

TEST(Background, CanBeANumber) {
  const spectra::ViewedLight light = sphere(paper(117)).light;
  const ViewingChoices fixed{.background = spectra::Background::fixed, .background_y = 20};
  EXPECT_EQ(view_of_room(light, fixed).conditions.background_y, 20);
}

TEST(SizeEffect, OfTwoDegreesIsNone) {
  EXPECT_TRUE(size_effect(2).none());
  EXPECT_TRUE(size_effect(0.5).none());
}

TEST(SizeEffect, LargeFieldsAreLighterAndMoreChromatic) {
  for (const double angle : {5.0, 20.0, 50.0}) {
    const LightnessChromaHue large = size_effect(angle).forward({50, 30, 120});
    EXPECT_GT(large.lightness, 50);
    EXPECT_LT(large.lightness, 100);
    EXPECT_GT(large.chroma, 30);
    EXPECT_EQ(large.hue_deg, 120);
  }
  const SizeEffect at_50 = size_effect(50);
  EXPECT_NEAR(at_50.chroma, 1.34 / 0.956, 1e-15);
  EXPECT_NEAR(at_50.lightness, 0.7514 / 1.0874, 1e-15);
  EXPECT_EQ(at_50.chroma, size_effect(120).chroma);  // none was observed that large
}

TEST(SizeEffect, ThereAndBackIsTheSameColour) {
  for (const double angle : {2.0, 7.0, 33.0, 50.0}) {
    for (const double lightness : {0.0, 12.0, 50.0, 99.0, 104.0}) {
      const SizeEffect size = size_effect(angle);
      const LightnessChromaHue back = size.inverse(size.forward({lightness, 41, 200}));
      EXPECT_NEAR(back.lightness, lightness, 1e-12);
      EXPECT_NEAR(back.chroma, 41, 1e-12);
    }
  }
}

TEST(SizeEffect, WantsAnAngle) {
  for (const double angle : {0.0, -1.0, 180.5, std::nan("")}) {
    EXPECT_THROW((void)size_effect(angle), std::domain_error);
  }
}

TEST(SizeEffect, KeepsTheCorrelatesConsistent) {
  const spectra::ViewedLight light = sphere(paper(117)).light;
  const RoomView view = view_of_room(light, {.size_effect = true});
  EXPECT_EQ(view.angle_deg, 40);
  const Correlates small = seen(view_of_room(light)), p = seen(view);
  const Adaptation a = adapt(view.conditions);
  EXPECT_NEAR(p.chroma, view.size.chroma * small.chroma, 1e-12);
  EXPECT_NEAR(p.colourfulness, p.chroma * a.f_l_4th, 1e-12);
  EXPECT_NEAR(p.brightness, a.brightness_scale * std::sqrt(p.lightness / 100), 1e-10);
  EXPECT_NEAR(p.saturation, 100 * std::sqrt(p.colourfulness / p.brightness), 1e-10);
  EXPECT_NEAR(std::hypot(p.a_c, p.b_c), p.chroma, 1e-12);
  EXPECT_NEAR(std::hypot(p.a_m, p.b_m), p.colourfulness, 1e-12);
  EXPECT_NEAR(std::hypot(p.a_s, p.b_s), p.saturation, 1e-12);
  EXPECT_NEAR(p.hue_deg, small.hue_deg, 0);
}

TEST(SizeEffect, TheAngleInTheFileWins) {
  const spectra::ViewedLight light = sphere(paper(117)).light;
  EXPECT_EQ(view_of_room(light, {.size_effect = true, .angle_deg = 10}).angle_deg, 10);
}

TEST(ChoicesOfSeeing, SlopesAreThoseOfTheAppearance) {
  const ArrayXd rho = paper(117);
  for (const ViewingChoices& choices :
       {ViewingChoices{.white_share = 0}, ViewingChoices{.white_share = 0.5},
        ViewingChoices{.background = spectra::Background::fixed, .background_y = 20},
        ViewingChoices{.white_share = 0.3, .size_effect = true}}) {
    const auto jab = [&](const ArrayXd& r) {
      const Correlates p = seen(view_of_room(sphere(r).light, choices));
      return Eigen::Vector3d(p.lightness, p.a_c, p.b_c);
    };
    const JabSlope slope = jab_slope(sphere(rho), choices);
    EXPECT_LT((slope.jab - jab(rho)).norm(), 1e-11);
    EXPECT_LT(
        (jab_of(viewed_sums(sphere(rho).light), adopted(sphere(rho).light, choices)) - jab(rho))
            .norm(),
        1e-11);
    for (const Eigen::Index band : {3, 15, 28}) {
      ArrayXd up = rho, down = rho;
      up[band] += 1e-5, down[band] -= 1e-5;
      const Eigen::Vector3d difference = (jab(up) - jab(down)) / 2e-5;
      EXPECT_LT((slope.by_reflectance.col(band) - difference).norm(), 1e-6);
    }
  }
}

TEST(ChoicesOfSeeing, TheStimulusComesBackFromTheLook) {
  for (const ViewingChoices& choices :
       {ViewingChoices{}, ViewingChoices{.white_share = 0}, ViewingChoices{.white_share = 0.5},
        ViewingChoices{.background = spectra::Background::fixed, .background_y = 20},
        ViewingChoices{.size_effect = true},
        ViewingChoices{.white_share = 0.2, .size_effect = true, .angle_deg = 10}}) {
    for (const std::size_t k : {3U, 117U, 300U, 420U}) {
      const RoomView view = view_of_room(sphere(paper(k)).light, choices);
      const Correlates p = seen(view);
      const spectra::RelativeXyz back = ciecam02_inverse(
          view.size.inverse({p.lightness, p.chroma, p.hue_deg}), adapt(view.conditions));
      EXPECT_NEAR(back.x, view.sample.x, 1e-9);
      EXPECT_NEAR(back.y, view.sample.y, 1e-9);
      EXPECT_NEAR(back.z, view.sample.z, 1e-9);
    }
  }
}

TEST(Swatch, InTheStandardLightIsTheStandardCondition) {
  const Spectrum d65 = spectra::scaled_to_luminous(
      spectra::light_on(kTransportGrid, spectra::illuminant("D65")), 2000);
  const SwatchCondition own = swatch_in(d65, 20, spectra::Surround::average);
  for (const std::size_t k : {3U, 117U, 300U}) {
    const Correlates p = on_swatch(on_grid(paper(k)), own).correlates;
    const Correlates q = on_swatch(on_grid(paper(k))).correlates;
    EXPECT_NEAR(p.lightness, q.lightness, 1e-11);
    EXPECT_NEAR(p.a_c, q.a_c, 1e-11);
    EXPECT_NEAR(p.b_c, q.b_c, 1e-11);
  }
}

}  // namespace
}  // namespace appearance
