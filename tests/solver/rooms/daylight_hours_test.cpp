#include "solver/rooms/daylight_hours.h"

#include <gtest/gtest.h>

#include "scenes/files/room_json.h"

namespace solver {
namespace {

/// An hour by its receivers' responses and by a full solve are the same light.
TEST(DaylightHours, AreFullSolves) {
  const scenes::Room day = scenes::read_room(std::string(SOURCE_DIR) + "/scenes/rooms/day.json");
  const RoomTransport transport = prepare_transport(day, {.eye = false});
  const DaylightHours hours(day, transport);
  EXPECT_TRUE(hours.converged());
  const scenes::WeatherSky& over = day.weather_skies.front();
  int seen = 0;
  for (const std::size_t hour : {4, 8, 12, 17}) {
    const scenes::SkyOfHour sky = scenes::sky_of_hour(day.grid, over, hour);
    const Bands light = hours.at(sky, true);
    const std::string name = "day " + std::to_string(hour + 1);
    for (std::size_t l = 0; l < transport.lightings.size(); ++l) {
      if (transport.lightings[l].name != name) continue;
      ++seen;
      const RoomSolution full = solve_room(day, transport, {}, {.lighting = l});
      for (std::size_t r = 0; r < day.receivers.size(); ++r) {
        const Eigen::ArrayXd& truth = full.receivers[r].irradiance;
        const Eigen::ArrayXd found = light.row(static_cast<Eigen::Index>(r)).transpose();
        EXPECT_LT((found - truth).abs().maxCoeff(), 1e-6 * truth.maxCoeff()) << name;
      }
    }
  }
  EXPECT_EQ(seen, 4);
}

TEST(DaylightHours, NightIsExactlyDark) {
  const scenes::Room day = scenes::read_room(std::string(SOURCE_DIR) + "/scenes/rooms/day.json");
  const RoomTransport transport = prepare_transport(day, {.eye = false});
  const DaylightHours hours(day, transport);
  const scenes::SkyOfHour night = scenes::sky_of_hour(day.grid, day.weather_skies.front(), 1);
  EXPECT_FALSE(night.sky);
  EXPECT_EQ(hours.at(night, true).abs().maxCoeff(), 0);
}

}  // namespace
}  // namespace solver
