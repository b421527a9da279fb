#include "paints/scheme.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/photometry.h"

namespace paints {
namespace {

using spectra::kTransportGrid;
using spectra::Spectrum;

Spectrum daylight() {
  static const Spectrum light = spectra::scaled_to_luminous(
      spectra::light_on(kTransportGrid, spectra::illuminant("D65")), 500);
  return light;
}

/// The n-th part of the papers, every so many.
Atlas papers(std::size_t first, std::size_t step) {
  const Atlas all = load_atlas("munsell-nickerson");
  Atlas some{.name = "some", .source = "test"};
  for (std::size_t i = first; i < all.paints.size(); i += step)
    some.paints.push_back(all.paints[i]);
  return some;
}

/// Walls that tint each other's light: what arrives at wall g is E / (1 - mean rho / 2), and a
/// third of it comes by way of each paint.
spectra::ViewedLight wall_in(const std::vector<Spectrum>& paints, std::size_t viewed) {
  Eigen::ArrayXd mean = Eigen::ArrayXd::Zero(kTransportGrid.count);
  for (const Spectrum& p : paints) mean += p.values / static_cast<double>(paints.size());
  const Eigen::ArrayXd white = daylight().values / (1 - mean / 2);
  return {.sample = {kTransportGrid, white * paints[viewed].values},
          .background = {kTransportGrid, white * mean},
          .field = {kTransportGrid, white * mean},
          .white = {kTransportGrid, white}};
}

SchemeRoom tinted_room(std::size_t groups) {
  return [groups](int varying, const std::vector<Spectrum>& paints) {
    std::vector<std::vector<spectra::LitRoom>> views;
    for (std::size_t viewed = 0; viewed < groups; ++viewed) {
      views.push_back({{.view = [=](const Spectrum& paint) {
        std::vector<Spectrum> all = paints;
        all[static_cast<std::size_t>(varying)] = paint;
        return wall_in(all, viewed);
      }}});
    }
    return views;
  };
}

Target swatch(std::size_t paper) {
  return target_of(
      appearance::on_swatch(load_atlas("munsell-nickerson").paints[paper].reflectance).correlates);
}

double distance_of(const std::vector<SchemeGroup>& groups, const std::vector<Spectrum>& paints) {
  double sum = 0, weights = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const auto seen =
        look(paints[g], groups[g].target,
             {{.view = [&](const Spectrum&) { return wall_in(paints, g); }}}, Distance::jab, {});
    sum += groups[g].weight * seen.front().distance;
    weights += groups[g].weight;
  }
  return sum / weights;
}

TEST(RankSchemes, ExhaustiveSearchFindsWhatTryingEachOneFinds) {
  const Atlas first = papers(0, 40), second = papers(7, 30);
  const std::vector<SchemeGroup> groups{{&first, swatch(61), 1}, {&second, swatch(230), 0.3}};
  std::vector<double> all;
  for (const Paint& p : first.paints) {
    for (const Paint& q : second.paints) {
      all.push_back(distance_of(groups, {p.reflectance, q.reflectance}));
    }
  }
  std::ranges::sort(all);
  const SchemeRanking ranking = rank_schemes(groups, tinted_room(2), {.top = 7});
  EXPECT_TRUE(ranking.exhaustive);
  EXPECT_EQ(ranking.combinations, static_cast<std::int64_t>(all.size()));
  ASSERT_EQ(ranking.schemes.size(), 7U);
  for (std::size_t i = 0; i < 7; ++i) {
    const Scheme& s = ranking.schemes[i];
    EXPECT_NEAR(s.distance, all[i], 1e-9);
    EXPECT_NEAR(s.distance,
                distance_of(groups, {s.paints[0]->reflectance, s.paints[1]->reflectance}), 1e-9);
  }
}

TEST(RankSchemes, DescentEndsWhereNoExchangeOfTwoPaintsIsNearer) {
  const Atlas atlas = papers(3, 50);
  const std::vector<SchemeGroup> groups{
      {&atlas, swatch(61), 1}, {&atlas, swatch(230), 1}, {&atlas, swatch(120), 1}};
  const SchemeRanking ranking =
      rank_schemes(groups, tinted_room(3), {.top = 3, .most_combinations = 200});
  EXPECT_FALSE(ranking.exhaustive);
  ASSERT_EQ(ranking.differing, 2);
  const Scheme& best = ranking.schemes.front();
  for (const Paint& p : atlas.paints) {
    for (const Paint& q : atlas.paints) {
      for (std::size_t kept = 0; kept < 3; ++kept) {
        std::vector<Spectrum> paints(3, p.reflectance);
        paints[(kept + 2) % 3] = q.reflectance;
        paints[kept] = best.paints[kept]->reflectance;
        EXPECT_GE(distance_of(groups, paints), best.distance - 1e-9);
      }
    }
  }
}

TEST(RankSchemes, OneGroupIsRankedAsByRank) {
  const Atlas atlas = papers(0, 20);
  const SchemeRanking schemes = rank_schemes({{&atlas, swatch(61), 2}}, tinted_room(1));
  const Ranking ranking =
      rank(atlas, swatch(61), tinted_room(1)(0, {atlas.paints[0].reflectance})[0]);
  ASSERT_GE(ranking.paints.size(), schemes.schemes.size());
  for (std::size_t i = 0; i < schemes.schemes.size(); ++i) {
    EXPECT_EQ(schemes.schemes[i].paints[0], ranking.paints[i].paint);
    EXPECT_NEAR(schemes.schemes[i].distance, ranking.paints[i].distance, 1e-12);
  }
}

TEST(RankSchemes, RefusesEmptyAtlasesAndWeights) {
  const Atlas none{.name = "none"}, some = papers(0, 100);
  EXPECT_THROW((void)rank_schemes({}, tinted_room(0)), std::invalid_argument);
  EXPECT_THROW((void)rank_schemes({{&none, swatch(0), 1}}, tinted_room(1)), std::invalid_argument);
  EXPECT_THROW((void)rank_schemes({{&some, swatch(0), 0}}, tinted_room(1)), std::invalid_argument);
}

}  // namespace
}  // namespace paints
