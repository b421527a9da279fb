// Skies, suns by place and time, and glass of a room file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "appearance/spectra/photometry.h"
#include "scenes/skies/sun_position.h"
#include "tests/scenes/room_files.h"

namespace scenes {
namespace {

using testing::HasSubstr;

const json kNoon{{"azimuth_deg", 200}, {"altitude_deg", 50}, {"day", 80}};

json sky_light(const json& sky, const json& more = json::object()) {
  json light{{"name", "day"}, {"at", kNoon}, {"sky", {{"type", "cie:12"}}}};
  if (sky.is_object()) light["sky"].update(sky);
  light.update(more);
  return light;
}

json room_with(const json& light) {
  json room = sample_room();
  room["lights"] = json::array();
  room["lights"].push_back(light);
  room["surfaces"]["window"] = 0.1;
  return room;
}

double plain_lx(const Room& room) {
  return spectra::luminous(
      {room.grid, irradiance_outside(room.skies.at(0), Eigen::Vector3d::UnitZ())});
}

TEST(ReadDaylight, AmountsAreThoseOfAnOpenPlain) {
  EXPECT_NEAR(plain_lx(read(room_with(sky_light({}, {{"illuminance_lx", 12345}})))), 12345, 1e-6);
  const Room even = read(room_with(sky_light({{"type", "cie:5"}, {"zenith_cd_m2", 1000}})));
  EXPECT_NEAR(plain_lx(even), 1000 * 3.14159265358979, 1e-6);
  const Room overcast = read(room_with(sky_light({{"type", "cie:16"}})));
  EXPECT_NEAR(plain_lx(overcast), (123 + 8600 * direction_of(0, 50).z()) * 7 * 3.14159265358979 / 9,
              1e-4);
  EXPECT_THAT(overcast.notes, testing::Contains(HasSubstr("no amount")));
}

TEST(ReadDaylight, WeatherGivesSkyAndSun) {
  const Room room = read(
      room_with(sky_light({{"type", "perez"},
                           {"direct_normal_W_m2", 600},
                           {"diffuse_horizontal_W_m2", 120},
                           {"dew_point_C", 10},
                           {"sun", json::object()}},
                          {{"at", {{"azimuth_deg", 180}, {"altitude_deg", 35}, {"day", 80}}}})));
  ASSERT_EQ(room.suns.size(), 1);
  EXPECT_EQ(room.lights.front().name, "day");
  EXPECT_EQ(room.lights.back().name, "day.sun");
  EXPECT_NEAR(spectra::luminous(room.suns[0].normal_irradiance), 600 * 98.316, 1);
  const double beam_lx = 600 * 98.316 * direction_of(0, 35).z();
  EXPECT_NEAR(plain_lx(room), 120 * 147.259 + beam_lx, 1);
  // The ground reflects both.
  EXPECT_NEAR(spectra::luminous({room.grid, room.skies[0].ground}),
              0.2 * plain_lx(room) / 3.14159265358979, 1e-6);
}

TEST(ReadDaylight, NorthTurnsWhatIsGivenByPlaceAndTime) {
  json light = sky_light(
      {},
      {{"illuminance_lx", 1000},
       {"at", {{"lat", 39.742476}, {"lon", -105.1786}, {"time", "2003-10-17T12:30:30-07:00"}}}});
  json room = room_with(light);
  const Eigen::Vector3d before = read(room).skies[0].pattern.to_sun;
  EXPECT_LT((before - direction_of(194.3402, 39.8721)).norm(), 2e-4);
  room["north_deg"] = 30;
  EXPECT_LT((read(room).skies[0].pattern.to_sun - direction_of(224.3402, 39.8721)).norm(), 2e-4);
  light.erase("sky");
  light["sun"] = json::object();
  light["spectrum"] = {{"daylight_K", 5500}};
  room["lights"][0] = light;
  EXPECT_NEAR(read(room).suns[0].azimuth_deg, 224.3402, 0.01);
}

TEST(ReadDaylight, NightIsNoFault) {
  const json night{{"at", {{"azimuth_deg", 0}, {"altitude_deg", -5}}}};
  json light = sky_light({{"type", "perez"},
                          {"direct_normal_W_m2", 0},
                          {"diffuse_horizontal_W_m2", 0},
                          {"sun", json::object()}},
                         night);
  const Room room = read(room_with(light));
  EXPECT_EQ(plain_lx(room), 0);
  EXPECT_EQ(spectra::luminous(room.suns.at(0).normal_irradiance), 0);
  EXPECT_THAT(room.notes, testing::Contains(HasSubstr("below the horizon")));
}

TEST(ReadDaylight, ScenariosDimIt) {
  json room = room_with(sky_light({}, {{"illuminance_lx", 1000}}));
  room["scenarios"] = {{{"name", "half"}, {"lights", {{"day", 0.5}}}}};
  const Room all = read(room);
  EXPECT_EQ(relit(all, all.scenarios.at(0)).skies[0].scale, 0.5);
}

TEST(ReadDaylight, GlassReflectsWhereNothingElseIsSaid) {
  json room = room_with(sky_light({}, {{"illuminance_lx", 1000}}));
  room["surfaces"].erase("window");
  Room bare = read(room);
  const auto pane = [](const Room& r) {
    return r.surfaces[static_cast<std::size_t>(find_surface(r, "window"))].reflectance.values[0];
  };
  EXPECT_EQ(pane(bare), 0);
  room["openings"][0]["glass"] = {{"panes", 2}};
  const Room glazed = read(room);
  EXPECT_NEAR(glazed.openings[0].glass->at_normal()[0], 0.7792, 5e-5);
  EXPECT_NEAR(pane(glazed), glazed.openings[0].glass->diffuse_reflectance()[0], 1e-15);
  room["surfaces"]["window"] = 0.3;
  EXPECT_EQ(pane(read(room)), 0.3);
}

struct Bad {
  json light, opening;
  const char *pointer, *words;
};

TEST(ReadDaylight, WhatCannotBeMeantIsRefused) {
  const auto at = [](const json& place) {
    return sky_light({}, {{"illuminance_lx", 1000}, {"at", place}});
  };
  const json time{{"lat", 50}, {"lon", 10}, {"time", "2024-06-01T10:00Z"}};
  const auto when = [&](const char* key, const json& value) {
    json place = time;
    place[key] = value;
    return at(place);
  };
  const auto sky = [](const json& keys) { return sky_light(keys, {{"illuminance_lx", 1000}}); };
  const auto perez = [](const json& keys, const json& more = json::object()) {
    json all{{"type", "perez"}, {"direct_normal_W_m2", 300}, {"diffuse_horizontal_W_m2", 90}};
    if (keys.is_object()) all.update(keys);
    return sky_light(all, more);
  };
  const std::vector<Bad> cases{
      {sky({{"type", "cie:17"}}), {}, "/lights/0/sky/type", "no type of sky"},
      {sky({{"type", "cie:0"}}), {}, "/lights/0/sky/type", "no type of sky"},
      {sky({{"type", "cie:012"}}), {}, "/lights/0/sky/type", "no type of sky"},
      {sky({{"type", "clear"}}), {}, "/lights/0/sky/type", "no type of sky"},
      {sky({{"type", 12}}), {}, "/lights/0/sky/type", "number"},
      {sky_light({}), {}, "/lights/0", "no amount"},
      {sky({{"zenith_cd_m2", 100}}), {}, "/lights/0/sky/zenith_cd_m2", "two amounts"},
      {sky({{"direct_normal_W_m2", 100}}), {}, "/lights/0/sky/direct_normal_W_m2", "perez"},
      {sky({{"dew_point_C", 5}}), {}, "/lights/0/sky/dew_point_C", "perez"},
      {sky({{"ground_reflectance", 1}}), {}, "/lights/0/sky/ground_reflectance", "1"},
      {sky({{"ground_reflectance", -0.1}}), {}, "/lights/0/sky/ground_reflectance", "-0.1"},
      {sky({{"obstruction", {{"angle_deg", 90}}}}),
       {},
       "/lights/0/sky/obstruction/angle_deg",
       "90"},
      {sky({{"obstruction", {{"angle_deg", 20}, {"top_m", 3}}}}),
       {},
       "/lights/0/sky/obstruction/top_m",
       "does not go with"},
      {sky({{"obstruction", {{"distance_m", 5}}}}), {}, "/lights/0/sky/obstruction", "top_m"},
      {sky({{"obstruction", json::object()}}), {}, "/lights/0/sky/obstruction", "distance_m"},
      {sky({{"sun", json::object()}}), {}, "/lights/0/sky/sun", "illuminance_lx"},
      {sky({{"colour", 1}}), {}, "/lights/0/sky/colour", "colour"},
      {perez({{"diffuse_horizontal_W_m2", 0}}), {}, "/lights/0/sky", "no sky for such weather"},
      {perez({{"diffuse_horizontal_W_m2", -1}}), {}, "/lights/0/sky/diffuse_horizontal_W_m2", "-1"},
      {perez({}, {{"illuminance_lx", 9}}), {}, "/lights/0/illuminance_lx", "irradiances say"},
      {perez({{"sun", {{"illuminance_lx", 9}}}}),
       {},
       "/lights/0/sky/sun/illuminance_lx",
       "irradiances say"},
      {sky_light({{"type", "perez"}, {"direct_normal_W_m2", 3}}),
       {},
       "/lights/0/sky",
       "diffuse_horizontal_W_m2"},
      {sky_light({}, {{"flux_lm", 100}}), {}, "/lights/0/flux_lm", "no meaning for a sky"},
      {sky_light({}, {{"illuminance_lx", 100}, {"spectrum", "blue"}}),
       {},
       "/lights/0/spectrum",
       "by direction"},
      {sky_light({}, {{"illuminance_lx", -1}}), {}, "/lights/0/illuminance_lx", "-1"},
      {when("lat", 91), {}, "/lights/0/at/lat", "91"},
      {when("lon", 181), {}, "/lights/0/at/lon", "181"},
      {when("time", "2024-06-01T10:00"), {}, "/lights/0/at/time", "no time with its zone"},
      {when("time", "2024-02-30T10:00Z"), {}, "/lights/0/at/time", "no time with its zone"},
      {when("time", 12), {}, "/lights/0/at/time", "number"},
      {when("zone", 1), {}, "/lights/0/at/zone", "zone"},
      {at({{"azimuth_deg", 10}}), {}, "/lights/0/at", "altitude_deg"},
      {at({{"azimuth_deg", 10}, {"altitude_deg", 91}}), {}, "/lights/0/at/altitude_deg", "91"},
      {at(json::object()), {}, "/lights/0/at", "lat"},
      {at(3), {}, "/lights/0/at", "number"},
      {sky({}), {{"glass", {{"panes", 3}}}}, "/openings/0/glass/panes", "3"},
      {sky({}), {{"glass", json::object()}}, "/openings/0/glass", "panes"},
      {sky({}),
       {{"glass", {{"panes", 1}, {"transmittance", 0.95}}}},
       "/openings/0/glass/transmittance",
       "no more than"},
      {sky({}),
       {{"glass", {{"panes", 1}}}, {"transmittance", 0.5}},
       "/openings/0/transmittance",
       "and glass"},
      {sky({}), {{"glass", "double"}}, "/openings/0/glass", "text"}};
  for (const Bad& bad : cases) {
    json room = room_with(bad.light);
    if (bad.opening.is_object()) room["openings"][0].update(bad.opening);
    const auto faults = faults_of([&] { (void)read(room); });
    ASSERT_FALSE(faults.empty()) << bad.pointer << ' ' << bad.words;
    std::string told;
    for (const auto& fault : faults) told += to_string(fault) + "\n";
    EXPECT_THAT(told, HasSubstr(bad.pointer));
    EXPECT_THAT(told, HasSubstr(bad.words));
    EXPECT_LE(faults.size(), 3) << told;
    EXPECT_GT(faults[0].line, 0) << told;
  }
}

TEST(ReadDaylight, SkiesNeedOpeningsAndAPlaceOfTheSun) {
  json room = room_with(sky_light({}, {{"illuminance_lx", 1000}}));
  room["openings"] = json::array();
  room["surfaces"].erase("window");
  EXPECT_THAT(to_string(faults_of([&] { (void)read(room); }).at(0)), HasSubstr("no opening"));
  json placeless = room_with(sky_light({}, {{"illuminance_lx", 1000}}));
  placeless["lights"][0].erase("at");
  EXPECT_THAT(to_string(faults_of([&] { (void)read(placeless); }).at(0)), HasSubstr("\"at\""));
  json lamp = sample_room();
  lamp["lights"][0]["at"] = kNoon;
  EXPECT_THAT(to_string(faults_of([&] { (void)read(lamp); }).at(0)), HasSubstr("no meaning"));
}

}  // namespace
}  // namespace scenes
