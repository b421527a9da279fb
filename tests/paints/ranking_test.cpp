#include "paints/ranking.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <stdexcept>

#include "appearance/cam02_ucs.h"
#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/photometry.h"

namespace paints {
namespace {

using appearance::LightnessChromaHue;
using appearance::on_swatch;
using spectra::kTransportGrid;
using spectra::Spectrum;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Spectrum lit(const char* illuminant, double illuminance_lx) {
  return spectra::scaled_to_luminous(
      spectra::light_on(kTransportGrid, spectra::illuminant(illuminant)), illuminance_lx);
}

/// A "room" that is a swatch under `light`: field as bright as the white, background of Y = 20.
spectra::RoomResponse swatch_under(const Spectrum& light) {
  return [light](const Spectrum& reflectance) {
    return spectra::ViewedLight{.sample = {light.grid, light.values * reflectance.values},
                                .background = {light.grid, light.values * 0.2},
                                .field = light,
                                .white = light};
  };
}

Ranking rank_in(const Atlas& atlas, const Target& target, const spectra::RoomResponse& room,
                const RankingOptions& options = {}) {
  return rank(atlas, target, {{.view = room}}, options);
}

spectra::RoomResponse standard_room() { return swatch_under(lit("D65", 2000)); }

const Atlas& munsell() {
  static const Atlas kAtlas = load_atlas("munsell-nickerson");
  return kAtlas;
}

Target target_paper(std::size_t index) {
  return target_of(on_swatch(munsell().paints[index].reflectance).correlates);
}

Atlas greys(const std::vector<std::pair<std::string, double>>& named) {
  Atlas atlas{.name = "greys", .source = "test", .paints = {}};
  for (const auto& [name, reflectance] : named) {
    atlas.paints.push_back(
        {.name = name, .reflectance = spectra::constant(kTransportGrid, reflectance), .label = ""});
  }
  return atlas;
}

std::vector<std::string> names(const Ranking& ranking) {
  std::vector<std::string> all;
  for (const RankedPaint& p : ranking.paints) all.push_back(p.paint->name);
  return all;
}

TEST(Rank, StandardConditionFindsTheTargetItself) {
  for (const std::size_t index : {0U, 116U, 230U, 461U}) {
    const Ranking ranking = rank_in(munsell(), target_paper(index), standard_room());
    EXPECT_EQ(ranking.paints.size(), munsell().paints.size());
    EXPECT_EQ(ranking.paints[0].paint, &munsell().paints[index]);
    EXPECT_NEAR(ranking.paints[0].distance, 0, 1e-10);  // rounding of XYZ by another scale
    EXPECT_GT(ranking.paints[1].distance, 0.01);
  }
}

TEST(Rank, UniformSpaceFindsTheTargetItselfToo) {
  const RankingOptions options{.windows = {}, .distance = Distance::cam02_ucs, .viewing = {}};
  const Ranking ranking = rank_in(munsell(), target_paper(230), standard_room(), options);
  EXPECT_EQ(ranking.paints[0].paint, &munsell().paints[230]);
  EXPECT_NEAR(ranking.paints[0].distance, 0, 1e-10);
}

TEST(Rank, DistancesRiseAndAreThoseOfTheReportedCorrelates) {
  const Target target = target_paper(116);
  const Ranking ranking = rank_in(munsell(), target, swatch_under(lit("A", 300)));
  double last = 0;
  for (const RankedPaint& p : ranking.paints) {
    EXPECT_GE(p.distance, last);
    last = p.distance;
    const auto& seen = p.seen.front().correlates;
    EXPECT_NEAR(p.distance,
                std::sqrt(std::pow(seen.lightness - target.lightness, 2) +
                          std::pow(seen.a_c - target.a_c, 2) + std::pow(seen.b_c - target.b_c, 2)),
                1e-12);
  }
}

TEST(Rank, UniformDistanceIsThatOfCam02Ucs) {
  const auto swatch = on_swatch(munsell().paints[116].reflectance).correlates;
  const RankingOptions options{.windows = {}, .distance = Distance::cam02_ucs, .viewing = {}};
  const Ranking ranking =
      rank_in(munsell(), target_of(swatch), swatch_under(lit("A", 300)), options);
  const auto wanted =
      appearance::cam02_ucs({swatch.lightness, swatch.colourfulness, swatch.hue_deg});
  for (const RankedPaint& p : ranking.paints) {
    const auto& c = p.seen.front().correlates;
    const auto seen = appearance::cam02_ucs({c.lightness, c.colourfulness, c.hue_deg});
    EXPECT_NEAR(p.distance, appearance::ucs_distance(seen, wanted), 1e-12);
  }
}

TEST(Rank, ReportsTheLightThatTheWallSends) {
  const Ranking ranking =
      rank_in(greys({{"grey", 0.3}}), target_paper(0), swatch_under(lit("A", 300)));
  // Grey sends the light of A: x 0.4476, y 0.4074 (CIE 015), cut to 400..700 nm.
  EXPECT_NEAR(ranking.paints[0].seen[0].chromaticity.x, 0.4476, 0.001);
  EXPECT_NEAR(ranking.paints[0].seen[0].chromaticity.y, 0.4074, 0.001);
  EXPECT_NEAR(ranking.paints[0].seen[0].view.illuminance_lx, 300, 1e-9);
}

TEST(Rank, OrderOfTheAtlasDoesNotMatter) {
  Atlas shuffled = munsell();
  std::shuffle(shuffled.paints.begin(), shuffled.paints.end(), std::mt19937(3));
  const auto room = swatch_under(lit("A", 300));
  EXPECT_EQ(names(rank_in(munsell(), target_paper(7), room)),
            names(rank_in(shuffled, target_paper(7), room)));
}

TEST(Rank, TiesKeepTheOrderOfTheAtlas) {
  const Atlas atlas = greys({{"c", 0.4}, {"b", 0.2}, {"a", 0.4}, {"d", 0.4}});
  const Target target = target_of(on_swatch(spectra::constant(kTransportGrid, 0.4)).correlates);
  EXPECT_THAT(names(rank_in(atlas, target, standard_room())),
              testing::ElementsAre("c", "a", "d", "b"));
}

TEST(Rank, WindowsRejectByTheSwatchBeforeTheRoomIsAsked) {
  const Target target = target_paper(230);
  int calls = 0;
  const auto room = standard_room();
  const auto counting = [&](const Spectrum& reflectance) {
    ++calls;
    return room(reflectance);
  };
  const RankingOptions options{.windows = {.lightness = 10, .chroma = 15, .hue_deg = 30}};
  const Ranking ranking = rank_in(munsell(), target, counting, options);
  EXPECT_EQ(ranking.rejected + static_cast<int>(ranking.paints.size()), 462);
  EXPECT_EQ(calls, static_cast<int>(ranking.paints.size()));
  EXPECT_GT(ranking.rejected, 300);
  EXPECT_EQ(ranking.paints[0].paint, &munsell().paints[230]);

  const double chroma = std::hypot(target.a_c, target.b_c);
  std::set<std::string> kept;
  for (const RankedPaint& p : ranking.paints) {
    EXPECT_LE(std::abs(p.seen.front().correlates.lightness - target.lightness), 10 + 1e-9);
    EXPECT_LE(std::abs(p.seen.front().correlates.chroma - chroma), 15 + 1e-9);
    kept.insert(p.paint->name);
  }
  // And none was rejected that lies inside all three windows.
  const double hue_deg = std::atan2(target.b_c, target.a_c) * 180 / std::numbers::pi;
  for (const Paint& paint : munsell().paints) {
    const auto swatch = on_swatch(paint.reflectance).correlates;
    const bool inside = std::abs(swatch.lightness - target.lightness) <= 10 &&
                        std::abs(swatch.chroma - chroma) <= 15 &&
                        std::abs(std::remainder(swatch.hue_deg - hue_deg, 360)) <= 30;
    EXPECT_TRUE(!inside || kept.contains(paint.name)) << paint.name;
  }
}

TEST(Rank, HueWindowWrapsAndSparesGreys) {
  const Spectrum grey = spectra::constant(kTransportGrid, 0.4);
  const Atlas atlas = greys({{"grey", 0.4}});
  const RankingOptions narrow{.windows = {.hue_deg = 1}};
  // Grey has chroma below 5, so its hue is not asked.
  EXPECT_EQ(
      rank_in(atlas, target_of(LightnessChromaHue{50, 40, 0}), standard_room(), narrow).rejected,
      0);

  for (const Paint& paint : munsell().paints) {
    const auto swatch = on_swatch(paint.reflectance).correlates;
    if (swatch.chroma < 10 || swatch.hue_deg > 5) continue;
    const Atlas one{.name = "one", .source = "test", .paints = {paint}};
    const auto across = [&](double hue_deg) {
      return rank_in(one, target_of(LightnessChromaHue{50, 40, hue_deg}), standard_room(),
                     {.windows = {.hue_deg = 20}})
          .rejected;
    };
    EXPECT_EQ(across(350), 0);  // up to 15 degrees away across 360
    EXPECT_EQ(across(330), 1);
    return;
  }
  FAIL() << "no paper with a hue of 0..5 degrees";
}

// The target's own distances do not change by rejecting others.
TEST(Rank, WindowsOnlyRemove) {
  const Target target = target_paper(50);
  const auto room = swatch_under(lit("A", 500));
  const Ranking all = rank_in(munsell(), target, room);
  const Ranking some = rank_in(munsell(), target, room, {.windows = {.lightness = 20}});
  const std::vector<std::string> few = names(some);
  std::vector<std::string> remaining;
  for (const std::string& name : names(all)) {
    if (std::find(few.begin(), few.end(), name) != few.end()) remaining.push_back(name);
  }
  EXPECT_EQ(remaining, few);
}

TEST(Rank, PaintsWithoutDefinedAppearanceAreNamedNotRanked) {
  // A wall that sends only violet to an eye adapted to a bluish white.
  const Spectrum white = spectra::scaled_to_luminous(
      spectra::light_on(kTransportGrid, spectra::daylight(20000)), 1000);
  const spectra::RoomResponse room = [&](const Spectrum& reflectance) {
    spectra::ViewedLight light = swatch_under(white)(reflectance);
    if (reflectance.values[0] > 0.5) light.sample.values.tail(27).setZero();
    return light;
  };
  const Atlas atlas = greys({{"grey", 0.3}, {"violet", 0.9}});
  const Ranking ranking = rank_in(atlas, target_paper(0), room);
  EXPECT_THAT(ranking.undefined, testing::ElementsAre("violet"));
  EXPECT_THAT(names(ranking), testing::ElementsAre("grey"));
}

TEST(Rank, EmptyAtlasGivesAnEmptyRanking) {
  const Ranking ranking = rank_in(greys({}), target_paper(0), standard_room());
  EXPECT_TRUE(ranking.paints.empty());
  EXPECT_EQ(ranking.rejected, 0);
}

TEST(Rank, RefusesTargetsAndWindowsWithoutMeaning) {
  const Atlas atlas = greys({{"grey", 0.3}});
  EXPECT_THROW((void)rank_in(atlas, {kNaN, 0, 0, 0}, standard_room()), std::invalid_argument);
  for (const double bad : {0.0, -1.0, kNaN}) {
    EXPECT_THROW(
        (void)rank_in(atlas, target_paper(0), standard_room(), {.windows = {.chroma = bad}}),
        std::invalid_argument);
  }
}

TEST(Rank, RefusesADarkRoom) {
  const Spectrum none = spectra::constant(kTransportGrid, 0);
  EXPECT_THROW((void)rank_in(greys({{"grey", 0.3}}), target_paper(0), swatch_under(none)),
               std::domain_error);
}

TEST(TargetOf, CorrelatesAndTheirJchGiveTheSame) {
  const auto p = on_swatch(munsell().paints[100].reflectance).correlates;
  const Target by_correlates = target_of(p);
  const Target by_jch = target_of(LightnessChromaHue{p.lightness, p.chroma, p.hue_deg});
  EXPECT_EQ(by_jch.lightness, by_correlates.lightness);
  EXPECT_NEAR(by_jch.a_c, by_correlates.a_c, 1e-12);
  EXPECT_NEAR(by_jch.b_c, by_correlates.b_c, 1e-12);
  EXPECT_NEAR(by_jch.colourfulness, by_correlates.colourfulness, 1e-12);
}

TEST(TargetOf, RefusesWhatIsNotDefined) {
  appearance::Correlates p;
  p.status.no_chroma_denominator = true;
  EXPECT_THROW((void)target_of(p), std::domain_error);
  EXPECT_THROW((void)target_of(LightnessChromaHue{50, -1, 0}), std::domain_error);
  EXPECT_THROW((void)target_of(LightnessChromaHue{-1, 0, 0}), std::domain_error);
  EXPECT_THROW((void)target_of(LightnessChromaHue{50, 10, kNaN}), std::domain_error);
}

// By day and by lamp: the judged distance is that of the scenarios' distances, and a paint is as
// inconstant as its two looks differ.
TEST(Rank, JudgesOverLightings) {
  const std::vector<spectra::LitRoom> rooms{
      {.name = "day", .weight = 3, .view = swatch_under(lit("D65", 800))},
      {.name = "lamp", .weight = 1, .view = swatch_under(lit("A", 100))}};
  const Target target = target_paper(100);
  const Ranking mean = rank(munsell(), target, rooms);
  const Ranking worst = rank(munsell(), target, rooms, {.judgement = spectra::Judgement::worst});
  for (const RankedPaint& p : mean.paints) {
    EXPECT_NEAR(p.distance, (3 * p.seen[0].distance + p.seen[1].distance) / 4, 1e-12);
    const auto &day = p.seen[0].correlates, &lamp = p.seen[1].correlates;
    EXPECT_NEAR(p.inconstancy,
                std::hypot(day.lightness - lamp.lightness, day.a_c - lamp.a_c, day.b_c - lamp.b_c),
                1e-12);
  }
  for (const RankedPaint& p : worst.paints) {
    EXPECT_EQ(p.distance, std::max(p.seen[0].distance, p.seen[1].distance));
  }
  EXPECT_THROW((void)rank(munsell(), target, {}), std::invalid_argument);
}

}  // namespace
}  // namespace paints
