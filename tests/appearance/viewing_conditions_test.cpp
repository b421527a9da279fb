#include "appearance/viewing_conditions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/photometry.h"
#include "appearance/spectra/spectrum_library.h"

namespace appearance {
namespace {

using spectra::kTransportGrid;
using spectra::Spectrum;
using spectra::Surround;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Spectrum daylight_lx(double illuminance_lx) {
  const Spectrum shape = spectra::light_on(kTransportGrid, spectra::illuminant("D65"));
  return spectra::scaled_to_luminous(shape, illuminance_lx);
}

Spectrum times(const Spectrum& light, double factor) { return {light.grid, light.values * factor}; }

spectra::ViewedLight grey_room(double illuminance_lx) {
  const Spectrum white = daylight_lx(illuminance_lx);
  return {.sample = times(white, 0.3),
          .background = times(white, 0.2),
          .field = times(white, 0.25),
          .white = white};
}

void expect_factors(const SurroundFactors& s, const SurroundFactors& wanted) {
  EXPECT_NEAR(s.f, wanted.f, 1e-15);
  EXPECT_NEAR(s.c, wanted.c, 1e-15);
  EXPECT_NEAR(s.n_c, wanted.n_c, 1e-15);
}

// [CIE159] Table 1: N_c of dim is 0.9, where [Neumann2004] Table 5 prints 0.95.
TEST(SurroundFactors, MeetTheTableAtDarkDimAndAverage) {
  expect_factors(surround_factors(0), {0.8, 0.525, 0.8});
  expect_factors(surround_factors(0.2), {0.9, 0.59, 0.9});
  expect_factors(surround_factors(1), {1.0, 0.69, 1.0});
}

TEST(SurroundFactors, AreLinearInBetweenAndClampedBeyond) {
  expect_factors(surround_factors(0.1), {0.85, 0.5575, 0.85});
  expect_factors(surround_factors(0.6), {0.95, 0.64, 0.95});
  expect_factors(surround_factors(-1), surround_factors(0));
  expect_factors(surround_factors(7), surround_factors(1));
}

TEST(SurroundFactors, RefuseWhatIsNoNumber) {
  EXPECT_THROW((void)surround_factors(kNaN), std::domain_error);
  EXPECT_THROW((void)surround_factors(std::numeric_limits<double>::infinity()), std::domain_error);
}

double ratio(Surround choice, double adapting, double white, double illuminance_lx = 100) {
  return surround_of(choice, {adapting, white, illuminance_lx}).ratio;
}

SurroundFactors factors(Surround choice, double adapting, double white,
                        double illuminance_lx = 100) {
  return surround_of(choice, {adapting, white, illuminance_lx}).factors;
}

// [Neumann2004] eq. 17: L_A = 0.2 L_Aw is exactly dim.
TEST(SurroundOf, NeumannDividesAdaptingByWhiteLuminance) {
  EXPECT_EQ(ratio(Surround::neumann, 20, 100), 0.2);
  expect_factors(factors(Surround::neumann, 20, 100), {0.9, 0.59, 0.9});
  EXPECT_EQ(ratio(Surround::neumann, 300, 100), 1);
  EXPECT_EQ(ratio(Surround::neumann, 0, 100), 0);
}

// [CIE159]: S_R from 0.2 up is average; the surround's white is 5 L_A.
TEST(SurroundOf, CieIsAverageFromAFifthUp) {
  EXPECT_NEAR(ratio(Surround::cie, 20, 100), 1, 1e-15);
  expect_factors(factors(Surround::cie, 4, 100), {1.0, 0.69, 1.0});
  expect_factors(factors(Surround::cie, 3.99, 100), {0.9, 0.59, 0.9});
  expect_factors(factors(Surround::cie, 0, 100), {0.8, 0.525, 0.8});
}

TEST(SurroundOf, IlluminanceIsAverageFrom40LuxUpAndDarkAtNone) {
  EXPECT_EQ(ratio(Surround::illuminance, 1, 1, 40), 1);
  EXPECT_EQ(ratio(Surround::illuminance, 1, 1, 39.9), 0.2);
  EXPECT_EQ(ratio(Surround::illuminance, 1, 1, 0), 0);
}

TEST(SurroundOf, FixedChoicesIgnoreTheLight) {
  EXPECT_EQ(ratio(Surround::average, 0.001, 100), 1);
  EXPECT_EQ(ratio(Surround::dim, 50, 100), 0.2);
  EXPECT_EQ(ratio(Surround::dark, 50, 100), 0);
  expect_factors(factors(Surround::dark, 50, 100), {0.8, 0.525, 0.8});
}

TEST(SurroundOf, RefusesLightThatIsNone) {
  EXPECT_THROW((void)surround_of(Surround::dim, {1, 0, 1}), std::domain_error);
  EXPECT_THROW((void)surround_of(Surround::dim, {-1, 1, 1}), std::domain_error);
  EXPECT_THROW((void)surround_of(Surround::dim, {1, kNaN, 1}), std::domain_error);
}

TEST(ViewingChoices, HaveTheNamesOfTheRoomFormat) {
  EXPECT_EQ(to_string(Surround::neumann), "neumann");
  EXPECT_EQ(to_string(Surround::cie), "cie");
  EXPECT_EQ(to_string(Surround::illuminance), "illuminance");
  EXPECT_EQ(to_string(Surround::average), "average");
  EXPECT_EQ(to_string(Surround::dim), "dim");
  EXPECT_EQ(to_string(Surround::dark), "dark");
  EXPECT_EQ(to_string(spectra::Background::sample), "sample");
  EXPECT_EQ(to_string(spectra::ReferenceWhite::surfaces), "surfaces");
}

// Everything grey: luminances are radiosities over pi, relative values are reflectances.
TEST(ViewOfRoom, GreyRoomGivesItsReflectances) {
  const RoomView view = view_of_room(grey_room(500));
  const double rounding = 1e-11;
  EXPECT_NEAR(view.illuminance_lx, 500, rounding);
  EXPECT_NEAR(view.white_luminance_cd_m2, 500 / std::numbers::pi, rounding);
  EXPECT_NEAR(view.conditions.adapting_luminance_cd_m2, 125 / std::numbers::pi, rounding);
  EXPECT_NEAR(view.conditions.background_y, 20, rounding);
  EXPECT_NEAR(view.conditions.white.y, 100, rounding);
  EXPECT_NEAR(view.sample.y, 30, rounding);
  EXPECT_NEAR(view.sample.x, 0.3 * view.conditions.white.x, rounding);
  EXPECT_NEAR(view.surround_ratio, 0.25, rounding);
  EXPECT_EQ(view.surround, Surround::neumann);
}

TEST(ViewOfRoom, ShortcutTakesTheWallForItsBackground) {
  const RoomView view = view_of_room(grey_room(500), {.background = spectra::Background::sample});
  EXPECT_NEAR(view.conditions.background_y, 30, 1e-11);
}

TEST(ViewOfRoom, NamesTheSurroundThatWasChosen) {
  const RoomView view = view_of_room(grey_room(30), {.surround = Surround::illuminance});
  EXPECT_EQ(view.surround, Surround::illuminance);
  EXPECT_EQ(view.surround_ratio, 0.2);
  expect_factors(view.conditions.surround, {0.9, 0.59, 0.9});
}

// A room twice as bright looks the same relative to its white.
TEST(ViewOfRoom, RelativeValuesDoNotDependOnTheAmountOfLight) {
  const RoomView dim = view_of_room(grey_room(10)), bright = view_of_room(grey_room(10000));
  EXPECT_NEAR(dim.sample.x, bright.sample.x, 1e-11);
  EXPECT_NEAR(dim.conditions.background_y, bright.conditions.background_y, 1e-11);
}

TEST(ViewOfRoom, RefusesDarkness) {
  const Spectrum none = spectra::constant(kTransportGrid, 0);
  spectra::ViewedLight light = grey_room(500);
  light.white = none;
  EXPECT_THROW((void)view_of_room(light), std::domain_error);
  light = grey_room(500);
  light.field = none;
  EXPECT_THROW((void)view_of_room(light), std::domain_error);
  light = grey_room(500);
  light.background = none;
  EXPECT_THROW((void)view_of_room(light), std::domain_error);
}

// [Neumann2004] 4.4, L_A = 2000 lx / pi = 636.62 cd/m^2 (printed 636.32).
TEST(StandardConditions, Are2000LuxOfD65) {
  const ViewingConditions& view = standard_conditions();
  EXPECT_NEAR(view.adapting_luminance_cd_m2, 636.62, 0.005);
  EXPECT_EQ(view.background_y, 20);
  EXPECT_NEAR(view.white.y, 100, 1e-12);
  // 95.05 and 108.88 at 1 nm; 400..700 nm cuts 0.36 off Z and 0.1 off X.
  EXPECT_NEAR(view.white.x, 95.05, 0.2);
  EXPECT_NEAR(view.white.z, 108.88, 0.5);
  expect_factors(view.surround, {1.0, 0.69, 1.0});
}

TEST(OnSwatch, PerfectDiffuserIsTheWhite) {
  const SwatchAppearance white = on_swatch(spectra::constant(kTransportGrid, 1));
  EXPECT_NEAR(white.correlates.lightness, 100, 1e-12);
  EXPECT_NEAR(white.xyz.x, standard_conditions().white.x, 1e-12);
  EXPECT_LT(white.correlates.chroma, 1);  // incomplete adaptation leaves a trace of blue
}

TEST(OnSwatch, EveryAtlasPaperIsDefinedAndReturnsFromTheInverse) {
  for (const spectra::NamedSpectrum& paper : spectra::atlas("munsell-nickerson").entries) {
    const auto [xyz, p] = on_swatch(spectra::reflectance_on(kTransportGrid, paper.samples));
    ASSERT_TRUE(p.status.all_defined()) << paper.name;
    const auto back = ciecam02_inverse({p.lightness, p.chroma, p.hue_deg}, standard_adaptation());
    EXPECT_NEAR(back.x, xyz.x, 1e-11) << paper.name;
    EXPECT_NEAR(back.y, xyz.y, 1e-11) << paper.name;
    EXPECT_NEAR(back.z, xyz.z, 1e-11) << paper.name;
  }
}

TEST(OnSwatch, RefusesAnotherGrid) {
  EXPECT_THROW((void)on_swatch(spectra::constant(spectra::kClosedFormGrid, 0.5)),
               std::invalid_argument);
}

}  // namespace
}  // namespace appearance
