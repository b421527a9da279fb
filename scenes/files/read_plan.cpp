// The shell of a room file: plan, names of walls, ceiling.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenes/files/room_reader.h"
#include "scenes/geometry/fits.h"
#include "scenes/shapes/roof.h"

namespace scenes {

using spectra::JsonNode;
using spectra::JsonObject;
using spectra::Limits;

namespace {

constexpr double kDefaultPatch_m = 0.25;
constexpr Limits kPitch_deg{.least = -85, .most = 85};
constexpr std::size_t kMostPlanes = 50;
constexpr double kFlat_m = 1e-6;  ///< how far heights may lie off their plane

}  // namespace

void RoomReader::read_patch_size() {
  room_.patch_m = top_.number_or("patch_m", kDefaultPatch_m, kLength_m);
  if (!top_.has("patch_m")) {
    room_.notes.push_back(fmt::format("patch_m is not given; {} m is used", kDefaultPatch_m));
  }
}

void RoomReader::read_plan() {
  Places corners;
  if (const auto plan = top_.need("plan_m")) {
    corners = plan->list(3);
    walls_known_ = !corners.empty();
  }
  for (const JsonNode& corner : corners) {
    const std::vector<double> xy = corner.numbers(2, kCoordinate_m);
    plan_m_.emplace_back(xy[0], xy[1]);
  }
  check_plan(corners);
}

void RoomReader::check_plan(const Places& corners) {
  const std::size_t n = corners.size();
  if (n == 0 || !std::ranges::all_of(plan_m_, [](const auto& p) { return p.allFinite(); })) {
    return;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double wall_m = (plan_m_[(i + 1) % n] - plan_m_[i]).norm();
    if (wall_m < kShortest_m) {
      corners[(i + 1) % n].fault("this corner repeats the one before",
                                 "leave one of them out (the last corner is joined to the first); "
                                 "walls are at least 1 mm long");
      return;
    }
  }
  if (const auto edge = first_crossing_edge(plan_m_)) {
    corners[*edge].fault("the wall from this corner crosses, touches or folds back on another",
                         "give the corners in their order around the room");
  } else if (area(plan_m_) < 0) {
    corners[0].fault("the corners run clockwise seen from above", "reverse their order");
  } else {
    plan_sound_ = true;
  }
}

void RoomReader::read_wall_names() {
  for (std::size_t i = 1; i <= plan_m_.size(); ++i) {
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
    wall_names_.resize(plan_m_.size());  // a name too many is no wall
  } else {
    names_.insert(names_.end(), wall_names_.begin(), wall_names_.end());
  }
  add_shell_surface("floor", SurfaceKind::floor);
  add_shell_surface("ceiling", SurfaceKind::ceiling);
  for (const std::string& wall : wall_names_) add_shell_surface(wall, SurfaceKind::wall);
}

void RoomReader::add_shell_surface(const std::string& name, SurfaceKind kind) {
  shell_surfaces_.emplace_back(name, kind);
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

void RoomReader::read_shell() {
  const auto ceiling = top_.find("ceiling");
  const bool level = top_.has("height_m") || !ceiling;
  const double height_m = level ? top_.number("height_m", kLength_m) : NAN;
  std::vector<RoofPlane> planes;
  if (level) planes.push_back({.height_m = height_m});
  if (ceiling) read_ceiling(*ceiling, planes);
  const bool sound =
      plan_sound_ && !planes.empty() && std::ranges::all_of(planes, [](const RoofPlane& plane) {
        return std::isfinite(plane.height_m) && plane.slope.allFinite();
      });
  if (!sound) return;
  for (std::size_t i = 0; i < plan_m_.size(); ++i) {
    const double wall_m = height_below(planes, plan_m_[i]);
    if (wall_m >= kShortest_m) continue;
    ceiling->fault(fmt::format("it is {:.4g} m high over corner {} of the plan, [{}, {}]", wall_m,
                               i + 1, plan_m_[i].x(), plan_m_[i].y()),
                   "raise it; walls are at least 1 mm high");
    return;
  }
  set_shell(roofed_shell(plan_m_, planes));
}

void RoomReader::set_shell(std::vector<ShellFace> shell) {
  room_.shell = std::move(shell);
  enclosure_ = Enclosure(room_.shell);
  shell_sound_ = true;
}

void RoomReader::read_ceiling(const JsonNode& node, std::vector<RoofPlane>& planes) {
  const JsonObject ceiling = node.object({"heights_m", "planes"});
  const auto heights = ceiling.find("heights_m"), list = ceiling.find("planes");
  if (heights.has_value() == list.has_value()) {
    ceiling.fault(heights ? "the ceiling has both heights and planes" : "the ceiling has no shape",
                  "give exactly one of heights_m or planes");
  }
  if (heights) read_heights(*heights, planes);
  if (!list) return;
  for (const JsonNode& entry : list->list(1, kMostPlanes)) {
    planes.push_back(read_roof_plane(entry));
  }
}

/// One height per corner of the plan, all in one plane.
void RoomReader::read_heights(const JsonNode& node, std::vector<RoofPlane>& planes) {
  if (const auto level = top_.find("height_m")) {
    level->fault("the room has both height_m and the heights of its corners", "keep one of them");
  }
  const Places entries = node.list();
  if (walls_known_ && node.is(JsonNode::Kind::list) && entries.size() != plan_m_.size()) {
    node.fault(fmt::format("{} heights for {} corners", entries.size(), plan_m_.size()),
               "give one height per corner of the plan");
    return;
  }
  Outline top;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const double height_m = entries[i].number(kLength_m);
    if (i < plan_m_.size()) top.emplace_back(plan_m_[i].x(), plan_m_[i].y(), height_m);
  }
  const auto finite = [](const Eigen::Vector3d& p) { return p.allFinite(); };
  if (!plan_sound_ || top.size() < 3 || !std::ranges::all_of(top, finite)) return;
  planes.push_back(roof_plane_of(top));
  for (std::size_t i = 0; i < top.size(); ++i) {
    const double off_m = top[i].z() - planes.back().over(plan_m_[i]);
    if (std::abs(off_m) <= kFlat_m) continue;
    entries[i].fault(fmt::format("the corners of the ceiling lie in no plane: this one is {:.4g} m "
                                 "off that of the others",
                                 off_m),
                     "change a height, or give \"planes\", of which the lowest counts");
    return;
  }
}

RoofPlane RoomReader::read_roof_plane(const JsonNode& node) {
  const JsonObject plane = node.object({"wall", "height_m", "pitch_deg", "points_m"});
  if (const auto points = plane.find("points_m")) return read_points_of_plane(plane, *points);
  RoofPlane roof{.height_m = plane.number("height_m", {.least = -1e4, .most = 1e4})};
  if (plane.has("pitch_deg") != plane.has("wall")) {
    plane.fault("\"wall\" and \"pitch_deg\" go together",
                "give both: the plane rises from the wall; or neither: it is level");
  }
  const auto wall_name = plane.find("wall");
  if (!wall_name || !plane.has("pitch_deg")) return roof;
  const int wall = wall_named(*wall_name);
  const double pitch_deg = plane.number("pitch_deg", kPitch_deg);
  if (wall < 0 || !plan_sound_) return {.height_m = NAN};
  const Line edge = edge_line(plan_m_, static_cast<std::size_t>(wall));
  return pitched_plane(edge, roof.height_m, pitch_deg);
}

RoofPlane RoomReader::read_points_of_plane(const JsonObject& plane, const JsonNode& points) {
  for (const char* key : {"wall", "height_m", "pitch_deg"}) {
    if (const auto node = plane.find(key)) {
      node->fault("the plane is given by three points already", "leave this out");
    }
  }
  Outline corners;
  for (const JsonNode& point : points.list(3, 3)) {
    corners.push_back(vector3(point.numbers(3, kCoordinate_m)));
  }
  RoofPlane roof{.height_m = NAN};
  if (corners.size() != 3) return roof;
  const Eigen::Vector3d area = vector_area_m2(corners);
  if (!area.allFinite()) return roof;
  if (std::abs(area.z()) < 1e-3 * area.norm() || area.norm() < 1e-6) {
    points.fault("the three points lie in a line, or in an upright plane",
                 "give three corners of the slope");
    return roof;
  }
  return roof_plane_of(corners);
}

}  // namespace scenes
