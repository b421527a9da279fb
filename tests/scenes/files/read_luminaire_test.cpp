// Luminaires of a room file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "appearance/spectra/photometry.h"
#include "tests/scenes/luminaires/luminaire_files.h"
#include "tests/scenes/room_files.h"

namespace scenes {
namespace {

using testing::HasSubstr;

json room_with_luminaire(const json& place = json::object(), const json& light = json::object()) {
  (void)write_file("lamp.ies", IesText{}.text());
  json room = sample_room();
  json luminaire{{"file", "lamp.ies"}, {"at_m", {3, 3, 2.2}}};
  luminaire.update(place);
  json entry{{"name", "lamp"}, {"luminaire", luminaire}, {"spectrum", {{"illuminant", "A"}}}};
  entry.update(light);
  room["lights"].push_back(entry);
  return room;
}

double flux_lm(const json& room) {
  return spectra::luminous(read(room).luminaires.at(0).spectral_flux);
}

std::string faults_in(const json& room) {
  std::string all;
  for (const auto& fault : faults_of([&] { (void)read(room); })) all += to_string(fault) + "\n";
  return all;
}

TEST(ReadLuminaire, TheFileKnowsTheFluxUnlessTheRoomGivesIt) {
  const double whole = flux_lm(room_with_luminaire());
  EXPECT_NEAR(whole / read(IesText{}).flux_lm, 1, 1e-12);
  EXPECT_NEAR(flux_lm(room_with_luminaire(json::object(), {{"dim", 0.3}})) / whole, 0.3, 1e-12);
  EXPECT_NEAR(flux_lm(room_with_luminaire(json::object(), {{"flux_lm", 555}})), 555, 1e-9);
}

TEST(ReadLuminaire, ScenariosDimIt) {
  json room = room_with_luminaire();
  room["scenarios"] = {{{"name", "half"}, {"lights", {{"lamp", 0.5}}}}};
  const Room all = read(room);
  const Room half = relit(all, all.scenarios.at(0));
  EXPECT_NEAR(spectra::luminous(half.luminaires.at(0).spectral_flux), 0.5 * flux_lm(room), 1e-9);
}

TEST(ReadLuminaire, FaultsOfTheFileAndOfTheRoomAreToldTogether) {
  IesText bad;
  bad.candela = {300, -2, 0};
  (void)write_file("bad.ies", bad.text());
  const std::string faults = faults_in(room_with_luminaire({{"file", "bad.ies"}}));
  EXPECT_THAT(faults, HasSubstr("bad.ies:8:5: negative intensity -2"));
  EXPECT_THAT(faults, HasSubstr("/lights/2/luminaire/file"));
  EXPECT_THAT(faults_in(room_with_luminaire({{"file", "none.ies"}})), HasSubstr("no such file"));
}

TEST(ReadLuminaire, WhatCannotBeMeantIsRefused) {
  EXPECT_THAT(faults_in(room_with_luminaire({{"at_m", {3, 3, 3}}})), HasSubstr("outside the room"));
  EXPECT_THAT(faults_in(room_with_luminaire({{"at_m", {3, 3, 2.6995}}})), HasSubstr("1 mm"));
  EXPECT_THAT(faults_in(room_with_luminaire({{"aim", {0, 0, 0}}})), HasSubstr("no direction"));
  EXPECT_THAT(faults_in(room_with_luminaire(json::object(), {{"power_W", 20}})),
              HasSubstr("no meaning"));
  EXPECT_THAT(faults_in(room_with_luminaire(json::object(), {{"dim", 1}, {"flux_lm", 100}})),
              HasSubstr("two amounts"));
  json room = sample_room();
  room["lights"][0]["dim"] = 0.5;
  EXPECT_THAT(faults_in(room), HasSubstr("\"dim\" has no meaning"));
  IesText large;
  large.size = "0.6 1.2 0";
  room = room_with_luminaire({{"at_m", {0.5, 3, 2.2}}});
  (void)write_file("lamp.ies", large.text());
  EXPECT_THAT(faults_in(room), HasSubstr("reaches beyond the room"));
}

TEST(ReadLuminaire, FlushWithTheCeilingItsUpperLightIsLost) {
  EXPECT_EQ(faults_in(room_with_luminaire({{"at_m", {3, 3, 2.7}}})), "");
  const Room room = read(room_with_luminaire({{"at_m", {3, 3, 2.7}}, {"aim", {0, 0, 1}}}));
  EXPECT_THAT(joined(room.notes), HasSubstr("takes 100 % of its light"));
}

TEST(ReadLuminaire, WithoutLampFluxTheRoomMustGiveIt) {
  LdtText file;
  file.lamps = "1\n1\nLED\n0\n840\n80\n29";
  file.luminous = "0\n0\n0\n0\n0\n0";
  (void)write_file("relative.ldt", file.text());
  const json place{{"file", "relative.ldt"}};
  EXPECT_THAT(faults_in(room_with_luminaire(place)), HasSubstr("gives no lamp flux"));
  EXPECT_NEAR(flux_lm(room_with_luminaire(place, {{"flux_lm", 555}})), 555, 1e-9);
}

}  // namespace
}  // namespace scenes
