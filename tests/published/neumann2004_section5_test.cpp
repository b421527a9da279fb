// [Neumann2004] section 5: salmon, beige and yellowish green walls by daylight and by tungsten
// light. The paper's paints and room are not published, so what can be tested is direction and
// kind; the sizes are printed beside its statements.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "appearance/spectra/spectrum_library.h"
#include "appearance/viewing_conditions.h"
#include "scenes/files/room_json.h"
#include "solver/rooms/room_light.h"

namespace {

using spectra::Spectrum;

/// Measured papers of these colours; on the swatch yellowish green has H = 105 as in the paper (95Y
/// 5G).
const std::map<std::string, std::string> kPaints{{"salmon", "munsell-nickerson:061"},
                                                 {"beige", "munsell-nickerson:098"},
                                                 {"yellowish green", "munsell-nickerson:447"}};

struct Change {
  double xy = 0;  ///< distance in the chromaticity diagram from swatch to room
  double swatch_chroma = 0, chroma = 0;
  double swatch_lightness = 0, lightness = 0;
  double swatch_hue = 0, hue = 0;  ///< H
};

Change change_of(const std::string& room_name, const std::string& paint) {
  const scenes::Room room =
      scenes::read_room(std::string(SOURCE_DIR) + "/scenes/rooms/" + room_name + ".json");
  const solver::RoomTransport transport = solver::prepare_transport(room, {.patch_m = 0.5});
  const Spectrum reflectance =
      spectra::reflectance_on(room.grid, spectra::find_paint(paint).spectrum->samples);
  const solver::RoomSolution solution =
      solver::solve_room(room, transport, {}, {.paints = {reflectance}});
  const spectra::ViewedLight light = solver::viewed_light(room, transport, solution);
  const appearance::RoomView view = appearance::view_of_room(light, room.viewing);
  const appearance::Correlates in_room =
      appearance::ciecam02_forward(view.sample, appearance::adapt(view.conditions));
  const appearance::SwatchAppearance swatch = appearance::on_swatch(reflectance);
  const spectra::Chromaticity from = spectra::chromaticity(swatch.xyz);
  const spectra::Chromaticity to = spectra::chromaticity(spectra::absolute_xyz(light.sample));
  return {.xy = std::hypot(to.x - from.x, to.y - from.y),
          .swatch_chroma = swatch.correlates.chroma,
          .chroma = in_room.chroma,
          .swatch_lightness = swatch.correlates.lightness,
          .lightness = in_room.lightness,
          .swatch_hue = swatch.correlates.hue_quadrature,
          .hue = in_room.hue_quadrature};
}

class Section5 : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    for (const char* room : {"daylight", "tungsten"}) {
      for (const auto& [name, paint] : kPaints) {
        const Change c = change_of(room, paint);
        fmt::print(
            "{:9} {:16} J {:5.1f} -> {:5.1f}  C {:5.1f} -> {:5.1f} (x {:.2f})  H {:>8} -> {:>8}  "
            "xy shift {:.3f}\n",
            room, name, c.swatch_lightness, c.lightness, c.swatch_chroma, c.chroma,
            c.chroma / c.swatch_chroma, appearance::hue_composition(c.swatch_hue),
            appearance::hue_composition(c.hue), c.xy);
        changes_[room][name] = c;
      }
    }
  }

  static std::map<std::string, std::map<std::string, Change>> changes_;
};

std::map<std::string, std::map<std::string, Change>> Section5::changes_;

// "The red lines illustrate the bigger change using tungsten lighting, and the shorter blue lines
// ... daylight" (Fig. 6).
TEST_F(Section5, ChromaticityChangesMoreByTungstenThanByDaylight) {
  for (const auto& [name, daylight] : changes_["daylight"]) {
    EXPECT_GT(changes_["tungsten"][name].xy, daylight.xy) << name;
    EXPECT_GT(daylight.xy, 0.01)
        << name;  // a shift one sees: about ten just noticeable differences
  }
}

// "The color appearance models reduce the extreme shifting": what the eye leaves of the change
// between the two lights is far smaller than the change of the light itself.
TEST_F(Section5, AdaptationTakesBackMostOfTheDifferenceBetweenTheLights) {
  for (const auto& [name, daylight] : changes_["daylight"]) {
    const Change& tungsten = changes_["tungsten"][name];
    EXPECT_LT(std::abs(tungsten.chroma - daylight.chroma), 15) << name;
    EXPECT_LT(std::abs(tungsten.lightness - daylight.lightness), 10) << name;
  }
}

}  // namespace
