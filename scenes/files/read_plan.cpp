// The geometry of a room file: plan, walls, openings, furniture.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenes/files/room_reader.h"
#include "scenes/geometry/fits.h"

namespace scenes {

using spectra::JsonNode;
using spectra::JsonObject;
using spectra::Limits;

namespace {

constexpr double kDefaultPatch_m = 0.25;
constexpr Limits kNotNegative_m{.least = 0, .most = 1e4};

Eigen::Vector3d vector3(const std::vector<double>& v) { return {v[0], v[1], v[2]}; }

}  // namespace

void RoomReader::read_plan() {
  Places corners;
  if (const auto plan = top_.need("plan_m")) {
    corners = plan->list(3);
    walls_known_ = !corners.empty();
  }
  for (const JsonNode& corner : corners) {
    const std::vector<double> xy = corner.numbers(2, kCoordinate_m);
    room_.plan_m.emplace_back(xy[0], xy[1]);
  }
  room_.height_m = top_.number("height_m", kLength_m);
  check_plan(corners);

  room_.patch_m = top_.number_or("patch_m", kDefaultPatch_m, kLength_m);
  if (!top_.has("patch_m")) {
    room_.notes.push_back(fmt::format("patch_m is not given; {} m is used", kDefaultPatch_m));
  }
}

void RoomReader::check_plan(const Places& corners) {
  const std::size_t n = corners.size();
  if (n == 0 || !std::ranges::all_of(room_.plan_m, [](const auto& p) { return p.allFinite(); })) {
    return;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double wall_m = (room_.plan_m[(i + 1) % n] - room_.plan_m[i]).norm();
    if (wall_m < kShortest_m) {
      corners[(i + 1) % n].fault("this corner repeats the one before",
                                 "leave one of them out (the last corner is joined to the first); "
                                 "walls are at least 1 mm long");
      return;
    }
  }
  if (const auto edge = first_crossing_edge(room_.plan_m)) {
    corners[*edge].fault("the wall from this corner crosses, touches or folds back on another",
                         "give the corners in their order around the room");
  } else if (area(room_.plan_m) < 0) {
    corners[0].fault("the corners run clockwise seen from above", "reverse their order");
  } else {
    plan_sound_ = std::isfinite(room_.height_m);
  }
}

void RoomReader::read_wall_names() {
  for (std::size_t i = 1; i <= room_.plan_m.size(); ++i) {
    wall_names_.push_back(fmt::format("wall_{}", i));
  }
  if (const auto names = top_.find("wall_names")) {
    const Places entries = names->list();
    if (walls_known_ && names->is(JsonNode::Kind::list) && entries.size() != wall_names_.size()) {
      names->fault(fmt::format("{} names for {} walls", entries.size(), wall_names_.size()),
                   "give one name per corner of the plan; wall i runs from corner i to the next");
    }
    walls_known_ = walls_known_ && entries.size() == wall_names_.size();
    wall_names_.clear();
    for (const JsonNode& entry : entries) {
      wall_names_.push_back(entry.name());
      claim_name(entry, wall_names_.back());
    }
    wall_names_.resize(room_.plan_m.size());  // a name too many is no wall
  } else {
    names_.insert(names_.end(), wall_names_.begin(), wall_names_.end());
  }
}

void RoomReader::claim_name(const JsonNode& place, const std::string& name) {
  if (name.empty()) return;
  if (name == "floor" || name == "ceiling" || name == "walls") {
    place.fault(fmt::format("the name \"{}\" is reserved", name), "choose another name");
  } else if (std::ranges::find(names_, name) != names_.end()) {
    place.fault(fmt::format("the name \"{}\" is taken", name),
                "walls, openings, furniture and lights need names of their own");
  }
  names_.push_back(name);
}

int RoomReader::wall_named(const JsonNode& node) const {
  const std::string name = node.name();
  const auto found = std::ranges::find(wall_names_, name);
  if (found != wall_names_.end()) return static_cast<int>(found - wall_names_.begin());
  if (!name.empty() && walls_known_) {
    node.fault(fmt::format("there is no wall \"{}\"", name),
               "give " + spectra::alternatives(wall_names_));
  }
  return -1;
}

void RoomReader::read_openings() {
  for (const JsonNode& node : top_.list_or_empty("openings")) {
    const JsonObject entry =
        node.object({"name", "wall", "offset_m", "sill_m", "width_m", "height_m", "transmittance"});
    const auto wall = entry.need("wall");
    const auto transmittance = entry.find("transmittance");
    room_.openings.push_back({.name = entry.name("name"),
                              .wall = wall ? wall_named(*wall) : -1,
                              .offset_m = entry.number("offset_m", kNotNegative_m),
                              .sill_m = entry.number("sill_m", kNotNegative_m),
                              .width_m = entry.number("width_m", kLength_m),
                              .height_m = entry.number("height_m", kLength_m),
                              .transmittance = transmittance
                                                   ? curves_.transmittance(*transmittance)
                                                   : spectra::constant(curves_.grid(), 1)});
    if (const auto name = entry.find("name")) claim_name(*name, room_.openings.back().name);
    opening_places_.push_back(node);
    check_opening(room_.openings.size() - 1);
  }
}

void RoomReader::check_opening(std::size_t opening) const {
  const Opening& o = room_.openings[opening];
  if (o.wall < 0 || !plan_sound_) return;
  const JsonNode& place = opening_places_[opening];
  const double length_m = wall_length_m(o.wall);
  if (o.offset_m + o.width_m > length_m + kTouch_m) {
    place.fault(fmt::format("it ends {} m along a wall of {} m", o.offset_m + o.width_m, length_m),
                "make offset_m or width_m smaller");
  }
  if (o.sill_m + o.height_m > room_.height_m + kTouch_m) {
    place.fault(
        fmt::format("its top is at {} m in a room of {} m", o.sill_m + o.height_m, room_.height_m),
        "make sill_m or height_m smaller");
  }
  for (std::size_t other = 0; other < opening; ++other) {
    if (room_.openings[other].wall == o.wall &&
        overlap(extent_of(o), extent_of(room_.openings[other]))) {
      place.fault(fmt::format("it overlaps the opening \"{}\"", room_.openings[other].name),
                  "move one of them");
    }
  }
}

void RoomReader::read_furniture() {
  for (const JsonNode& node : top_.list_or_empty("furniture")) {
    const JsonObject entry = node.object({"name", "box_m", "rotate_z_deg"});
    Box box{.name = entry.name("name"),
            .min_m = Eigen::Vector3d::Constant(NAN),
            .max_m = Eigen::Vector3d::Constant(NAN)};
    if (const auto extent = entry.need("box_m")) {
      const JsonObject corners = extent->object({"min", "max"});
      box.min_m = vector3(corners.numbers("min", 3, kCoordinate_m));
      box.max_m = vector3(corners.numbers("max", 3, kCoordinate_m));
      if (((box.max_m - box.min_m).array() < kShortest_m).any()) {
        extent->fault("\"max\" is not above \"min\" in x, y and z by at least 1 mm",
                      "give the lowest and the highest corner");
        box.min_m.setConstant(NAN);
      }
    }
    box.rotate_z_deg = entry.number_or("rotate_z_deg", 0, {.least = -360, .most = 360});
    if (const auto name = entry.find("name")) claim_name(*name, box.name);
    room_.furniture.push_back(box);
    box_places_.push_back(node);
    check_box(room_.furniture.size() - 1);
  }
}

void RoomReader::check_box(std::size_t index) const {
  const Box& box = room_.furniture[index];
  if (!is_sound(box) || !plan_sound_) return;
  const JsonNode& place = box_places_[index];
  const Polygon foot = footprint(box);
  if (box.min_m.z() < -kTouch_m || box.max_m.z() > room_.height_m + kTouch_m) {
    place.fault(fmt::format("it reaches from {} to {} m in a room of {} m", box.min_m.z(),
                            box.max_m.z(), room_.height_m),
                "keep it between floor and ceiling; it may touch them");
  }
  if (!fits_into(room_.plan_m, foot)) {
    place.fault("it reaches through a wall or stands outside the room",
                "keep its footprint, as rotated, within the plan; it may touch walls");
  }
  for (std::size_t i = 0; i < index; ++i) {
    const Box& other = room_.furniture[i];
    if (is_sound(other) && box.min_m.z() < other.max_m.z() - kTouch_m &&
        other.min_m.z() < box.max_m.z() - kTouch_m && overlap(foot, footprint(other))) {
      place.fault(fmt::format("it overlaps \"{}\"", other.name),
                  "move one of them; they may touch");
    }
  }
}

double RoomReader::wall_length_m(int wall) const {
  const auto i = static_cast<std::size_t>(wall);
  return (room_.plan_m[(i + 1) % room_.plan_m.size()] - room_.plan_m[i]).norm();
}

Polygon extent_of(const Opening& o) {
  return rectangle({o.offset_m, o.sill_m}, {o.offset_m + o.width_m, o.sill_m + o.height_m});
}

}  // namespace scenes
