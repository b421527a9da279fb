#include "scenes/skies/epw_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "appearance/spectra/text/input_error.h"
#include "tests/scenes/room_files.h"

namespace scenes {
namespace {

using testing::HasSubstr;

/// A line an hour from `first`, of June 20th; of 35 cells those that count.
std::string hour_line(int hour, const std::string& direct, const std::string& diffuse,
                      const std::string& dew = "9.5") {
  return "2005,6,20," + std::to_string(hour) + ",0,?9?9,18.0," + dew +
         ",55,101000,900,1300,330,500," + direct + "," + diffuse + ",0,0,0,0,180,2\n";
}

std::string header(
    const std::string& place = "LOCATION,Someplace,-,DEU,TMY,103840,52.47,13.40,1.0,49.0") {
  return place + "\nDESIGN\nTYPICAL\nGROUND\nHOLIDAYS\nCOMMENTS 1\nCOMMENTS 2\nDATA PERIODS\n";
}

WeatherFile read_text(const std::string& text) { return read_epw(write_file("w.epw", text)); }

TEST(EpwReader, ReadsPlaceTimeAndWeather) {
  const WeatherFile file = read_text(header() + hour_line(12, "512", "210") +
                                     hour_line(13, "0", "80.5", "99.9") + "\r\n");
  EXPECT_EQ(file.place, "Someplace");
  EXPECT_EQ(file.latitude_deg, 52.47);
  ASSERT_EQ(file.hours.size(), 2);
  EXPECT_EQ(file.hours[0].weather.direct_normal_W_m2, 512);
  EXPECT_EQ(file.hours[0].weather.diffuse_horizontal_W_m2, 210);
  EXPECT_NEAR(file.hours[0].weather.precipitable_water_cm, precipitable_water_cm(9.5), 1e-12);
  EXPECT_EQ(file.hours[1].weather.precipitable_water_cm, 2);
  EXPECT_EQ(file.hours[0].moment.day_of_year, 171);
  // The middle of the hour that ends at 12:00 in a zone one hour east of Greenwich.
  EXPECT_NEAR(file.hours[0].moment.julian_day, read_moment("2005-06-20T10:30:00Z")->julian_day,
              1e-9);
}

TEST(EpwReader, FaultsStandAtTheirPlaces) {
  struct Bad {
    std::string text, words;
  };

  const std::vector<Bad> cases{
      {"", "empty"},
      {"hello", "no EnergyPlus weather file"},
      {"LOCATION,a,b\n", "no EnergyPlus weather file"},
      {header("LOCATION,S,-,D,T,1,91,13.4,1,49") + hour_line(1, "0", "0"), ":1:20: the latitude"},
      {header("LOCATION,S,-,D,T,1,x,13.4,1,49") + hour_line(1, "0", "0"), "\"x\" is no number"},
      {header("LOCATION,S,-,D,T,1,9,13.4,99,49") + hour_line(1, "0", "0"), "the time zone"},
      {header(), "no hours"},
      {header() + "2005,6,20,1\n", ":9:1: the line has 4 cells"},
      {header() + hour_line(25, "0", "0"), "the hour of 25"},
      {header() + hour_line(0, "0", "0"), "the hour of 0"},
      {header() + hour_line(1, "9999", "0"), "direct normal irradiance of 9999"},
      {header() + hour_line(1, "0", "-1"), "diffuse horizontal irradiance of -1"},
      {header() + hour_line(1, "0", "nan"), "\"nan\" is no number"},
      {header() + hour_line(1, "", "0"), "\"\" is no number"},
      {header() + "2005,2,30" + hour_line(1, "0", "0").substr(9), "no such day"}};
  for (const Bad& bad : cases) {
    const auto faults = faults_of([&] { (void)read_text(bad.text); });
    ASSERT_EQ(faults.size(), 1) << bad.words;
    EXPECT_THAT(to_string(faults[0]), HasSubstr(bad.words));
    EXPECT_FALSE(faults[0].remedy.empty());
  }
  std::string many = header();
  for (int k = 0; k < 300; ++k) many += hour_line(1, "bad", "bad");
  EXPECT_EQ(faults_of([&] { (void)read_text(many); }).size(), 100);
}

TEST(EpwReader, RoomsTakeAnHourOfIt) {
  (void)write_file("w.epw", header() + hour_line(12, "512", "210") + hour_line(24, "0", "0"));
  json room = sample_room();
  room["lights"] = json::array();
  room["lights"].push_back({{"name", "day"},
                            {"sky", {{"type", "perez"}, {"sun", json::object()}}},
                            {"at", {{"epw", "w.epw"}, {"hour", 1}}}});
  room["surfaces"]["window"] = 0.1;
  const Room noon = read(room);
  EXPECT_GT(noon.skies.at(0).cd_m2, 0);
  EXPECT_NEAR(noon.suns.at(0).altitude_deg, 60.1, 0.1);
  room["lights"][0]["at"]["hour"] = 2;
  EXPECT_EQ(read(room).skies.at(0).cd_m2, 0);
  room["lights"][0]["at"] = {{"epw", "w.epw"}, {"hours", {1, 2}}};
  const Room both = read(room);
  ASSERT_EQ(both.scenarios.size(), 1);  // the other is dark
  EXPECT_EQ(both.scenarios[0].name, "day 1");
  EXPECT_EQ(both.scenarios[0].scale, (std::vector<double>{1, 1, 0, 0}));
  EXPECT_EQ(both.lights[3].name, "day 2.sun");
  EXPECT_EQ(both.skies[0].cd_m2, noon.skies[0].cd_m2);
  room["lights"][0]["at"]["hours"] = {2, 1};
  EXPECT_THAT(to_string(faults_of([&] { (void)read(room); }).at(0)), HasSubstr("hours 2 to 1"));
  room["lights"][0]["at"] = {{"epw", "w.epw"}};
  room["lights"][0]["at"]["hour"] = 3;
  EXPECT_THAT(to_string(faults_of([&] { (void)read(room); }).at(0)), HasSubstr("has 2 hours"));
  room["lights"][0]["at"] = {{"epw", "none.epw"}, {"hour", 1}};
  EXPECT_THAT(to_string(faults_of([&] { (void)read(room); }).at(0)), HasSubstr("no such file"));
  room["lights"][0]["at"] = {{"epw", "w.epw"}, {"hour", 1}};
  room["lights"][0]["sky"]["dew_point_C"] = 3;
  EXPECT_THAT(to_string(faults_of([&] { (void)read(room); }).at(0)), HasSubstr("weather file"));
  room["lights"][0]["sky"].erase("dew_point_C");
  room["lights"][0]["sky"]["type"] = "cie:3";
  EXPECT_THAT(to_string(faults_of([&] { (void)read(room); }).at(0)), HasSubstr("\"perez\""));
}

}  // namespace
}  // namespace scenes
