#include "tests/support/stability_rooms.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "scenes/files/room_json.h"

namespace stability {

using Eigen::ArrayXd;

std::string box_members(const BoxSize& size, double patch_m, double reflectance) {
  return fmt::format(
      R"("plan_m": [[0, 0], [{0}, 0], [{0}, {1}], [0, {1}]], "height_m": {2}, "patch_m": {3},
         "surfaces": {{ "floor": {4}, "ceiling": {4}, "walls": {4} }})",
      size.x_m, size.y_m, size.z_m, patch_m, reflectance);
}

std::string panel_member(const std::string& where) {
  return R"("lights": [ { "name": "lamp", "panel": )" + where +
         R"(, "exitance_W_m2_nm": { "nm": [400, 700], "values": [1, 1] } } ])";
}

scenes::Room room_of(const std::string& members) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / fmt::format("roomhue_stability_{}.json", getpid());
  std::ofstream(path) << R"({ "roomhue": 1, )" << members << " }";
  scenes::Room room = scenes::read_room(path);
  std::filesystem::remove(path);
  return room;
}

scenes::Room box() {
  return room_of(box_members({}, 0.5, 0.5) + ", " +
                 panel_member(R"({"on": "ceiling", "center_m": [2.5, 2], "size_m": [1, 1]})"));
}

scenes::Room two_rooms() {
  return room_of(
      R"("plan_m": [[0, 0], [4, 0], [4, 1.5], [4.2, 1.5], [4.2, 0], [8, 0], [8, 4], [4.2, 4],
                    [4.2, 2.4], [4, 2.4], [4, 4], [0, 4]], "height_m": 2.6, "patch_m": 0.6,
         "surfaces": { "floor": 0.5, "ceiling": 0.5, "walls": 0.5 }, )" +
      panel_member(R"({"on": "ceiling", "center_m": [2, 2], "size_m": [1.2, 0.6]})"));
}

scenes::Room corridor() {
  return room_of(box_members({.x_m = 30, .y_m = 1.5, .z_m = 2.5}, 0.7, 0.5) + ", " +
                 panel_member(R"({"on": "ceiling", "center_m": [3, 0.75], "size_m": [1, 0.5]})"));
}

scenes::Room slab() {
  return room_of(box_members({.x_m = 8, .y_m = 8, .z_m = 0.2}, 0.5, 0.5) + ", " +
                 panel_member(R"({"on": "ceiling", "center_m": [1, 1], "size_m": [1, 1]})"));
}

scenes::Room uniform(scenes::Room room, double reflectance) {
  for (scenes::Surface& s : room.surfaces) s.reflectance.values.setConstant(reflectance);
  return room;
}

Solved solve(const scenes::Room& room, double relative_error, solver::Light light) {
  Solved solved{.transport = solver::prepare_transport(room, {.light = light}), .solution = {}};
  solved.solution = solver::solve_room(room, solved.transport, {.relative_error = relative_error});
  return solved;
}

double furnace_error(scenes::Room room) {
  room.point_lights.clear();
  double step = 0;
  for (scenes::Surface& s : room.surfaces) {
    // Golden-ratio steps give each surface and band a reflectance of its own.
    for (double& rho : s.reflectance.values) {
      step = std::fmod(step + 0.6180339887498949, 1);
      rho = 0.9999 * std::sqrt(step);
    }
    s.exitance.values = 1 - s.reflectance.values;
  }
  room.surfaces[0].reflectance.values.setConstant(0.9999);
  room.surfaces[0].exitance.values.setConstant(1 - 0.9999);
  const Solved furnace = solve(room);
  double worst = (furnace.means(furnace.solution.radiosity.radiosity) - 1).abs().maxCoeff();
  for (const solver::ReceiverLight& r : furnace.solution.receivers) {
    worst = std::max(worst, (r.irradiance - 1).abs().maxCoeff());
  }
  return worst;
}

double mean_light_error(const Solved& solved, double reflectance) {
  const ArrayXd area = solved.transport.exchange.area_m2.head(solved.transport.mesh.size());
  const solver::Lighting& light = solved.transport.lightings.front();
  const double flux = (area * solved.means(light.emission + light.direct).col(0)).sum();
  const double mean = (area * solved.irradiance()).sum() / area.sum();
  return std::abs(mean / (flux / (area.sum() * (1 - reflectance))) - 1);
}

}  // namespace stability
