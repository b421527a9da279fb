#include "apps/studies/look_errors.h"

#include <gmock/gmock.h>

#include "tests/apps/program.h"

namespace apps {
namespace {

using test::TemporaryFolder;

/// A room that sends its light, a flat spectrum, times a factor from the wall's paint to the eye.
std::vector<spectra::LitRoom> grey_room(double factor) {
  return {{.view = [factor](const spectra::Spectrum& paint) {
    const spectra::Spectrum light = spectra::constant(paint.grid, factor);
    return spectra::ViewedLight{.sample = {paint.grid, paint.values * factor},
                                .background = light,
                                .field = light,
                                .white = spectra::constant(paint.grid, 1),
                                .lamps = light};
  }}};
}

paints::Atlas two_greys(double a, double b) {
  paints::Atlas atlas;
  for (const double r : {a, b}) {
    atlas.paints.push_back(
        {.name = std::to_string(r), .reflectance = spectra::constant(spectra::kTransportGrid, r)});
  }
  return atlas;
}

// Light that is 1 % and 4 % off on longer patches moves looks by what they are off.
TEST(RankingErrors, AreTheLargerStepBetweenMeshes) {
  const paints::Atlas atlas = two_greys(0.4, 0.2);
  const paints::Target wish{.lightness = 50};
  const paints::Ranking ranking = paints::rank(atlas, wish, grey_room(0.5));
  const auto looks = [&](double factor) {
    return paints::look(ranking.paints[0].paint->reflectance, wish, grey_room(factor).front(),
                        paints::Distance::jab, {});
  };
  const RankingErrors errors =
      ranking_errors(ranking, wish, {grey_room(0.505), grey_room(0.52)}, {});
  const double h = looks(0.5).correlates.lightness, h2 = looks(0.505).correlates.lightness,
               h4 = looks(0.52).correlates.lightness;
  ASSERT_EQ(errors.of_paint.size(), 2U);
  EXPECT_NEAR(errors.of_paint[0].lightness, std::max(std::abs(h - h2), std::abs(h2 - h4) / 2),
              1e-12);
  EXPECT_GT(errors.of_paint[0].adapting_luminance_cd_m2, 0);
  EXPECT_EQ(errors.of_paint[0].white, 0);
  EXPECT_THAT(errors.ties_with, testing::ElementsAre(0, 0));
}

TEST(RankingErrors, PaintsThatMeshesOrderDifferentlyTie) {
  // The wish lies between the two: nearly as near to one as to the other.
  const paints::Atlas atlas = two_greys(0.400, 0.404);
  const double a = paints::look(atlas.paints[0].reflectance, {}, grey_room(0.5).front(),
                                paints::Distance::jab, {})
                       .correlates.lightness,
               b = paints::look(atlas.paints[1].reflectance, {}, grey_room(0.5).front(),
                                paints::Distance::jab, {})
                       .correlates.lightness;
  const paints::Target wish{.lightness = (a + b) / 2 + 0.01};
  const paints::Ranking ranking = paints::rank(atlas, wish, grey_room(0.5));
  const RankingErrors errors =
      ranking_errors(ranking, wish, {grey_room(0.505), grey_room(0.52)}, {});
  EXPECT_THAT(errors.ties_with, testing::ElementsAre(0, 1));
}

TEST(RankingErrors, NothingIsToldWithoutLongerPatches) {
  const paints::Ranking ranking = paints::rank(two_greys(0.4, 0.2), {}, grey_room(0.5));
  EXPECT_TRUE(ranking_errors(ranking, {}, {}, {}).of_paint.empty());
}

// What is told of the rankings of rooms covers what patches a third as long change.
TEST(RankingErrors, CoverWhatFinerPatchesChange) {
  for (const auto& sample : {std::pair{"tungsten", "0.13"}, std::pair{"lean_to", "0.12"}}) {
    const std::string room = sample.first, patch = sample.second;
    const TemporaryFolder folder;
    const auto rank = [&](const std::string& out, const std::string& options) {
      const test::ProgramRun run = test::roomhue(std::string("rank " SOURCE_DIR "/scenes/rooms/") +
                                                 room + ".json --resolve-top 0 --top 10 " +
                                                 options + " --out " + (folder / out).string());
      EXPECT_EQ(run.exit_code, 0) << run.err;
      return test::read_cells(folder / (out + "/ranking.csv"));
    };
    const auto coarse = rank("coarse", ""), fine = rank("fine", "--patch-m " + patch);
    const auto column = [&](const char* name) {
      return static_cast<std::size_t>(std::ranges::find(coarse[0], name) - coarse[0].begin());
    };
    for (std::size_t i = 1; i < coarse.size(); ++i) {
      ASSERT_EQ(coarse[i][1], fine[i][1]);  // the same paint
      for (const char* name : {"distance", "J", "a_C", "b_C"}) {
        const double change = std::stod(coarse[i][column(name)]) - std::stod(fine[i][column(name)]);
        const std::string told = coarse[i][column((std::string(name) + "_mesh_error").c_str())];
        EXPECT_LT(std::abs(change), std::stod(told)) << room << " " << i << " " << name;
      }
    }
  }
}

}  // namespace
}  // namespace apps
