// What a room file asks for: receivers, where the eye is, paint and scenarios.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "appearance/spectra/spectrum_library.h"
#include "scenes/files/room_reader.h"
#include "scenes/geometry/fits.h"

namespace scenes {

using spectra::JsonNode;
using spectra::JsonObject;

namespace {

constexpr double kStep_m = 1e-6;  ///< from a receiver's surface into the air before it
constexpr std::size_t kMostGroups = 3;
constexpr spectra::Limits kFieldOfView_deg{.least = 1, .most = 150};
constexpr spectra::Limits kWeight{.least = 0, .most = 1e6, .above_least = true};

}  // namespace

double RoomReader::clearance_m(const Eigen::Vector3d& point_m) const {
  double clearance_m = enclosure_.clearance_m(point_m);
  for (std::size_t b = 0; b < room_.furniture.size(); ++b) {
    if (body_read_[b] == 0) continue;
    clearance_m = std::min(clearance_m, distance_m(room_.furniture[b], point_m));
  }
  return clearance_m;
}

void RoomReader::read_receivers() {
  std::vector<std::string> taken;
  for (const JsonNode& node : top_.list_or_empty("receivers", 10'000)) {
    const JsonObject entry = node.object({"name", "at_m", "normal"});
    Receiver receiver{.name = entry.name("name"),
                      .at_m = vector3(entry.numbers("at_m", 3, kCoordinate_m)),
                      .normal = vector3(entry.numbers("normal", 3, kCoordinate_m))};
    if (const auto name = entry.find("name");
        name && !receiver.name.empty() && std::ranges::find(taken, receiver.name) != taken.end()) {
      name->fault(fmt::format("there are two receivers \"{}\"", receiver.name), "rename one");
    }
    taken.push_back(receiver.name);
    if (receiver.normal.norm() < 1e-9) {
      entry.find("normal")->fault("the normal has no direction", "give for example [0, 0, 1]");
      continue;
    }
    receiver.normal.stableNormalize();
    room_.receivers.push_back(receiver);
    if (!shell_sound_ || !receiver.at_m.allFinite() || !receiver.normal.allFinite()) continue;
    if (clearance_m(receiver.at_m) < -kTouch_m) {
      node.fault("the receiver is outside the room or in furniture", "move it into the air");
    } else if (clearance_m(receiver.at_m + kStep_m * receiver.normal) < -kTouch_m) {
      node.fault("the receiver faces into the surface that it lies on",
                 "turn its normal to the air, or move it off the surface");
    }
  }
}

void RoomReader::read_view() {
  const auto node = top_.find("view");
  if (!node) return;
  const JsonObject view =
      node->object({"eye_m", "look_at_m", "surround", "background", "white", "size_effect"});
  read_viewing_choices(view);
  if (view.has("eye_m") || view.has("look_at_m")) read_view_points(view, room_.view);
}

void RoomReader::read_named_views() {
  const auto node = top_.find("views");
  if (!node) return;
  for (const auto& [name, entry] : node->any_object().entries()) {
    const JsonObject place = entry.object({"eye_m", "look_at_m", "fov_deg"});
    std::optional<View> view;
    read_view_points(place, view);
    room_.views.push_back(
        {.name = name, .view = *view, .fov_deg = place.number_or("fov_deg", 0, kFieldOfView_deg)});
  }
}

void RoomReader::read_view_points(const JsonObject& view, std::optional<View>& into) {
  into = View{.eye_m = vector3(view.numbers("eye_m", 3, kCoordinate_m)),
              .look_at_m = vector3(view.numbers("look_at_m", 3, kCoordinate_m))};
  const auto& [eye_m, look_at_m] = *into;
  if ((look_at_m - eye_m).norm() < kShortest_m) {
    view.fault("the eye looks at itself", "move look_at_m away from eye_m");
  }
  if (shell_sound_ && eye_m.allFinite() && clearance_m(eye_m) < kShortest_m) {
    view.find("eye_m")->fault("the eye is outside the room, on a surface or in furniture",
                              "move it into the air");
  }
}

void RoomReader::read_paint() {
  const auto node = top_.find("paint");
  if (!node) return;
  if (!node->is(JsonNode::Kind::list)) return read_paint_group(*node);
  for (const JsonNode& group : node->list(1)) {
    if (room_.paint.size() == kMostGroups) {
      group.fault(fmt::format("more than {} groups are painted", kMostGroups),
                  "give surfaces that are alike the same paint");
      break;
    }
    read_paint_group(group);
  }
}

void RoomReader::read_paint_group(const JsonNode& node) {
  const JsonObject paint =
      node.object({"name", "surfaces", "atlas", "target", "view", "weight", "top"});
  PaintTask task{.atlas = "munsell-nickerson"};
  if (const auto view = paint.find("view")) {
    read_view_points(view->object({"eye_m", "look_at_m"}), task.view);
  }
  if (const auto surfaces = paint.need("surfaces")) read_painted(*surfaces, task);
  task.name = task.surfaces.empty()
                  ? ""
                  : room_.surfaces[static_cast<std::size_t>(task.surfaces.front())].name;
  if (paint.has("name")) task.name = paint.name("name");
  if (const auto atlas = paint.find("atlas")) read_atlas(*atlas, task);
  if (const auto target = paint.find("target")) read_target(*target, task);
  if (const auto top = paint.find("top")) task.top = top->whole_number(1, 1'000'000);
  if (paint.has("weight")) task.weight = paint.number("weight", kWeight);
  if (std::ranges::find(room_.paint, task.name, &PaintTask::name) != room_.paint.end()) {
    node.fault(fmt::format("there are two groups \"{}\"", task.name), "rename one");
  }
  room_.paint.push_back(std::move(task));
}

void RoomReader::read_painted(const JsonNode& node, PaintTask& task) {
  std::vector<std::string> known{"walls"};
  for (const Surface& s : room_.surfaces) {
    const bool paintable = s.kind != SurfaceKind::panel && s.kind != SurfaceKind::opening;
    if (paintable && !s.name.empty()) known.push_back(s.name);
  }
  std::vector<int>& painted = task.surfaces;
  for (const JsonNode& entry : node.list(1)) {
    if (!walls_known_) continue;
    const int choice = entry.choice(known);
    if (choice < 0) continue;
    for (int i = 0; i < static_cast<int>(room_.surfaces.size()); ++i) {
      const Surface& s = room_.surfaces[static_cast<std::size_t>(i)];
      const bool meant = choice == 0 ? s.kind == SurfaceKind::wall
                                     : s.name == known[static_cast<std::size_t>(choice)];
      if (!meant || std::ranges::find(painted, i) != painted.end()) continue;
      if (paint_group(room_, i) >= 0) {
        entry.fault(fmt::format("\"{}\" is painted by an earlier group", s.name),
                    "paint each surface once");
      }
      painted.push_back(i);
    }
  }
  std::ranges::sort(painted);
  const bool wall = std::ranges::any_of(painted, [&](int i) {
    return room_.surfaces[static_cast<std::size_t>(i)].kind == SurfaceKind::wall;
  });
  const bool looked_at = task.view || (room_.paint.empty() && top_.has("view"));
  if (!painted.empty() && !wall && !looked_at) {
    node.fault("no wall is painted, so it is not known where the eye looks",
               "add \"view\" with eye_m and look_at_m");
  }
}

void RoomReader::read_atlas(const JsonNode& node, PaintTask& task) {
  const std::string name = node.name();
  const std::vector<std::string>& known = spectra::atlas_names();
  if (name.empty() || std::ranges::find(known, name) != known.end()) {
    if (!name.empty()) task.atlas = name;
    return;
  }
  task.atlas = curves_.resolve(name);
  curves_.check_atlas(node, task.atlas);
}

void RoomReader::read_scenarios() {
  if (const auto judge = top_.find("judge")) {
    static const std::array<std::string, 2> judgements{"mean", "worst"};  // as the enumeration
    room_.judgement = static_cast<spectra::Judgement>(judge->choice(judgements));
  }
  for (const JsonNode& node : top_.list_or_empty("scenarios", 100)) read_scenario(node);
  if (hour_lights_.empty()) return;
  if (const auto node = top_.find("scenarios")) {
    node->fault("the hours of a weather file make the scenarios", "leave them out");
    return;
  }
  for (const std::string& name : hour_lights_) {
    Scenario scenario{.name = name};
    for (const Light& light : room_.lights) {
      scenario.scale.push_back(light.name == name || light.name == name + ".sun" ? 1 : 0);
    }
    room_.scenarios.push_back(std::move(scenario));
  }
}

void RoomReader::read_scenario(const JsonNode& node) {
  const JsonObject entry = node.object({"name", "lights", "weight"});
  Scenario scenario{.name = entry.name("name"), .scale = std::vector(room_.lights.size(), 0.0)};
  if (std::ranges::find(room_.scenarios, scenario.name, &Scenario::name) != room_.scenarios.end()) {
    node.fault(fmt::format("there are two scenarios \"{}\"", scenario.name), "rename one");
  }
  if (entry.has("weight")) scenario.weight = entry.number("weight", kWeight);
  std::vector<std::string> names;
  for (const Light& light : room_.lights) {
    if (!light.name.empty()) names.push_back(light.name);
  }
  if (const auto lights = entry.need("lights"); lights && lights_known_) {
    const JsonObject scales = lights->object(names);
    bool lit = false, named = lights->empty();  // an unknown name is a fault already
    for (std::size_t k = 0; k < room_.lights.size(); ++k) {
      if (!scales.has(room_.lights[k].name)) continue;
      scenario.scale[k] = scales.number(room_.lights[k].name, {.least = 0, .most = 1e6});
      named = true;
      lit = lit || scenario.scale[k] != 0;
    }
    if (named && !lit)
      lights->fault("the scenario has no light", "name a light and its scale, e.g. 1");
  }
  room_.scenarios.push_back(std::move(scenario));
}

}  // namespace scenes
