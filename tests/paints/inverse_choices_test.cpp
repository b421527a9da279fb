// A reflectance made for a look, by every choice of the model, looks so.
#include <gtest/gtest.h>

#include "paints/inverse_colour.h"
#include "tests/paints/sphere_room.h"

namespace paints {
namespace {

using spectra::ViewingChoices;

spectra::ViewedLightSlope lit_sphere(const spectra::Spectrum& paint) {
  spectra::ViewedLightSlope slope = test::sphere_room(paint);
  slope.light.lamps = spectra::light_on(paint.grid, spectra::illuminant("A"));
  slope.light.angle_deg = 45;
  return slope;
}

Target look_of(const spectra::Spectrum& paint, const ViewingChoices& choices) {
  return target_of(appearance::seen(appearance::view_of_room(lit_sphere(paint).light, choices)));
}

TEST(InverseColour, MeetsTheWishByEveryChoiceOfTheModel) {
  const spectra::Spectrum paint = load_atlas("munsell-nickerson").paints[230].reflectance;
  for (const ViewingChoices& choices :
       {ViewingChoices{.white_share = 0}, ViewingChoices{.white_share = 0.5},
        ViewingChoices{.background = spectra::Background::fixed, .background_y = 20},
        ViewingChoices{.size_effect = true},
        ViewingChoices{.background = spectra::Background::fixed,
        .white_share = 0.5,
        .background_y = 20,
        .size_effect = true}}) {
    const Target wish = look_of(paint, choices);
    const WishInLight in_sphere{.room = lit_sphere, .target = wish};
    const InverseColour found = inverse_colour(std::span(&in_sphere, 1), {.viewing = choices});
    EXPECT_TRUE(found.exact);
    const Target is = look_of(found.reflectance, choices);
    EXPECT_NEAR(is.lightness, wish.lightness, 1e-9);
    EXPECT_NEAR(is.a_c, wish.a_c, 1e-9);
    EXPECT_NEAR(is.b_c, wish.b_c, 1e-9);
  }
}

}  // namespace
}  // namespace paints
