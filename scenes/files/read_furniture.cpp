// The furniture of a room file.
#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "scenes/files/room_reader.h"
#include "scenes/geometry/fits.h"
#include "scenes/shapes/bodies.h"

namespace scenes {

using Eigen::Vector3d;
using spectra::JsonNode;
using spectra::JsonObject;
using spectra::Limits;

namespace {

const std::vector<std::string> kShapes{"box_m", "prism", "cylinder", "stairs", "sheet", "mesh"};
constexpr Limits kTurn_deg{.least = -360, .most = 360};
constexpr double kFlat_m = 1e-6;  ///< how far corners of a sheet may lie off its plane
constexpr std::size_t kMostCorners = 1000;

bool all_finite(const Polygon& polygon) {
  return std::ranges::all_of(polygon, [](const auto& p) { return p.allFinite(); });
}

/// A plan that is simple and turns left; else nothing, after a fault.
std::optional<Polygon> read_plan_of_body(const JsonNode& node) {
  Polygon plan;
  const auto corners = node.list(3, kMostCorners);
  for (const JsonNode& corner : corners) {
    const std::vector<double> xy = corner.numbers(2, kCoordinate_m);
    plan.emplace_back(xy[0], xy[1]);
  }
  if (plan.size() < 3 || !all_finite(plan)) return {};
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if ((plan[(i + 1) % plan.size()] - plan[i]).norm() >= kShortest_m) continue;
    corners[(i + 1) % plan.size()].fault("this corner repeats the one before",
                                         "leave one of them out; edges are at least 1 mm long");
    return {};
  }
  if (const auto edge = first_crossing_edge(plan)) {
    corners[*edge].fault("the edge from this corner crosses, touches or folds back on another",
                         "give the corners in their order");
    return {};
  }
  if (area(plan) < 0) std::ranges::reverse(plan);
  return plan;
}

/// From z to z; else nothing, after a fault.
std::optional<Eigen::Vector2d> read_heights(const JsonObject& shape) {
  const std::vector<double> z = shape.numbers("z_m", 2, kCoordinate_m);
  if (!std::isfinite(z[0] + z[1])) return {};
  if (z[1] - z[0] < kShortest_m) {
    shape.find("z_m")->fault("the second height is not above the first by at least 1 mm",
                             "give [from, to]");
    return {};
  }
  return Eigen::Vector2d(z[0], z[1]);
}

std::optional<Body> read_prism(const JsonNode& node, const std::string& name) {
  const JsonObject shape = node.object({"plan_m", "z_m"});
  const auto plan_node = shape.need("plan_m");
  const auto plan = plan_node ? read_plan_of_body(*plan_node) : std::nullopt;
  const auto z = read_heights(shape);
  if (!plan || !z) return {};
  return prism_body(name, *plan, z->x(), z->y());
}

std::optional<Body> read_cylinder(const JsonNode& node, const std::string& name) {
  const JsonObject shape = node.object({"center_m", "radius_m", "z_m", "sides"});
  const std::vector<double> centre = shape.numbers("center_m", 2, kCoordinate_m);
  const double radius_m = shape.number("radius_m", kLength_m);
  const auto sides = shape.find("sides");
  const int count = sides ? sides->whole_number(3, 96) : 24;
  const auto z = read_heights(shape);
  if (!z || !std::isfinite(centre[0] + centre[1] + radius_m)) return {};
  const Polygon plan = regular_polygon({centre[0], centre[1]}, radius_m, count);
  if ((plan[1] - plan[0]).norm() < kShortest_m) {
    node.fault("its sides are shorter than 1 mm", "give fewer sides, or a larger radius");
    return {};
  }
  return prism_body(name, plan, z->x(), z->y());
}

std::optional<Body> read_stairs(const JsonNode& node, const std::string& name) {
  const JsonObject shape =
      node.object({"foot_m", "direction_deg", "width_m", "rise_m", "going_m", "steps"});
  const std::vector<double> foot = shape.numbers("foot_m", 3, kCoordinate_m);
  const auto steps = shape.need("steps");
  const Stairs stairs{.foot_m = vector3(foot),
                      .direction_deg = shape.number_or("direction_deg", 0, kTurn_deg),
                      .width_m = shape.number("width_m", kLength_m),
                      .rise_m = shape.number("rise_m", kLength_m),
                      .going_m = shape.number("going_m", kLength_m),
                      .steps = steps ? steps->whole_number(1, 100) : 0};
  const double all = stairs.direction_deg + stairs.width_m + stairs.rise_m + stairs.going_m;
  if (!steps || !stairs.foot_m.allFinite() || !std::isfinite(all)) return {};
  return stairs_body(name, stairs);
}

std::optional<Body> read_sheet(const JsonNode& node, const std::string& name) {
  const JsonObject shape = node.object({"outline_m"});
  const auto outline_node = shape.need("outline_m");
  if (!outline_node) return {};
  const auto corners = outline_node->list(3, kMostCorners);
  Outline outline;
  for (const JsonNode& corner : corners) {
    outline.push_back(vector3(corner.numbers(3, kCoordinate_m)));
    if (!outline.back().allFinite()) return {};
  }
  if (outline.size() < 3) return {};
  if (vector_area_m2(outline).norm() < kShortest_m * kShortest_m) {
    outline_node->fault("the sheet has no area", "give its corners in their order around it");
    return {};
  }
  const PlaneCoordinates plane(outline);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const double off_m = plane.height_m(outline[i]);
    if (std::abs(off_m) <= kFlat_m) continue;
    corners[i].fault(
        fmt::format("the corners lie in no plane: this one is {:.3g} m off it", std::abs(off_m)),
        "move it, or make the sheet of triangles");
    return {};
  }
  Polygon flat;
  for (const Vector3d& p : outline) flat.push_back(plane.flatten(p));
  if (const auto edge = first_crossing_edge(flat)) {
    corners[*edge].fault("the edge from this corner crosses, touches or folds back on another",
                         "give the corners in their order");
    return {};
  }
  for (std::size_t i = 0; i < flat.size(); ++i) outline[i] = plane.lift(flat[i]);
  return sheet_body(name, outline);
}

}  // namespace

void RoomReader::read_furniture() {
  std::vector<std::string> keys{"name", "rotate_z_deg", "rotate"};
  keys.insert(keys.end(), kShapes.begin(), kShapes.end());
  for (const JsonNode& node : top_.list_or_empty("furniture")) {
    const JsonObject entry = node.object(keys);
    const std::string name = entry.name("name");
    if (const auto place = entry.find("name")) claim_name(*place, name);
    std::optional<Body> body = read_body(entry, name);
    if (const auto rotate = entry.find("rotate"); rotate && body) {
      const auto motion = read_rotation(*rotate, *body);
      body = motion ? std::optional(moved(*body, *motion)) : std::nullopt;
    }
    body_read_.push_back(body ? 1 : 0);
    body_places_.push_back(node);
    room_.furniture.push_back(body.value_or(Body{.name = name, .faces = {}, .parts = {}}));
    if (body && shell_sound_) check_body(room_.furniture.size() - 1);
  }
}

std::optional<Body> RoomReader::read_body(const JsonObject& entry, const std::string& name) {
  std::vector<std::string> given;
  std::ranges::copy_if(kShapes, std::back_inserter(given),
                       [&](const std::string& key) { return entry.has(key); });
  if (given.size() != 1) {
    entry.fault(given.empty() ? "the furniture has no shape"
                              : fmt::format("the furniture is both {} and {}", given[0], given[1]),
                "give exactly one of " + spectra::alternatives(kShapes));
    return {};
  }
  const auto turn = entry.find("rotate_z_deg");
  if (turn && given[0] != "box_m") {
    turn->fault("\"rotate_z_deg\" turns boxes only", "give \"rotate\" with an axis and an angle");
  }
  if (turn && entry.has("rotate")) {
    turn->fault("the furniture is turned twice", "keep one of rotate_z_deg and rotate");
  }
  const JsonNode shape = *entry.find(given[0]);
  if (given[0] == "prism") return read_prism(shape, name);
  if (given[0] == "cylinder") return read_cylinder(shape, name);
  if (given[0] == "stairs") return read_stairs(shape, name);
  if (given[0] == "sheet") return read_sheet(shape, name);
  if (given[0] == "mesh") return read_mesh(shape, name);
  return read_box(entry, name);
}

std::optional<Body> RoomReader::read_box(const JsonObject& entry, const std::string& name) {
  const JsonNode extent = *entry.find("box_m");
  const JsonObject corners = extent.object({"min", "max"});
  const Vector3d min_m = vector3(corners.numbers("min", 3, kCoordinate_m)),
                 max_m = vector3(corners.numbers("max", 3, kCoordinate_m));
  const double turn_deg = entry.number_or("rotate_z_deg", 0, kTurn_deg);
  if (((max_m - min_m).array() < kShortest_m).any()) {
    extent.fault("\"max\" is not above \"min\" in x, y and z by at least 1 mm",
                 "give the lowest and the highest corner");
    return {};
  }
  if (!min_m.allFinite() || !max_m.allFinite() || !std::isfinite(turn_deg)) return {};
  return box_body(name, min_m, max_m, turn_deg);
}

std::optional<Eigen::Isometry3d> RoomReader::read_rotation(const JsonNode& node, const Body& body) {
  const JsonObject rotate = node.object({"axis", "angle_deg", "about_m"});
  const std::vector<double> axis = rotate.numbers("axis", 3, kCoordinate_m);
  const double angle_deg = rotate.number("angle_deg", kTurn_deg);
  Eigen::AlignedBox3d extent;
  for (const Outline& face : body.faces) {
    for (const Vector3d& p : face) extent.extend(p);
  }
  Vector3d about_m = extent.center();
  if (rotate.has("about_m")) about_m = vector3(rotate.numbers("about_m", 3, kCoordinate_m));
  const Vector3d direction = vector3(axis);
  if (direction.norm() < 1e-9) {
    rotate.find("axis")->fault("the axis has no direction", "give for example [0, 0, 1]");
    return {};
  }
  if (!direction.allFinite() || !std::isfinite(angle_deg) || !about_m.allFinite()) return {};
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.translate(about_m);
  motion.rotate(Eigen::AngleAxisd(angle_deg * std::numbers::pi / 180, direction.normalized()));
  motion.translate(-about_m);
  return motion;
}

void RoomReader::check_body(std::size_t index) const {
  const Body& body = room_.furniture[index];
  const JsonNode& place = body_places_[index];
  const int through = enclosure_.reached_through(body);
  if (through >= 0) {
    const int surface = room_.shell[static_cast<std::size_t>(through)].surface;
    const std::string& name = shell_surfaces_[static_cast<std::size_t>(surface)].first;
    place.fault(fmt::format("it reaches through \"{}\"", name),
                "keep it, as rotated, within the room; it may touch walls, floor and ceiling");
  } else if (std::ranges::any_of(body.parts, [this](const ConvexPart& part) {
               return enclosure_.clearance_m(middle_of(part)) < -kTouch_m;
             })) {
    place.fault("it stands outside the room, or a part of it does", "move it into the room");
  }
  for (std::size_t i = 0; i < index; ++i) {
    const Body& other = room_.furniture[i];
    if (body_read_[i] != 0 && overlap(body, other)) {
      place.fault(fmt::format("it overlaps \"{}\"", other.name),
                  "move one of them; they may touch");
    }
  }
}

/// Furniture that touches all of an opening or panel leaves nothing of it.
void RoomReader::check_covered() const {
  const auto check = [&](const auto& part, std::size_t b) {
    if (part.face < 0 || part.outline.empty()) return;
    const PlaneCoordinates plane(room_.shell[static_cast<std::size_t>(part.face)].outline);
    const Polygon extent = plane.flatten(part.outline);
    const bool covered = std::ranges::any_of(room_.furniture[b].faces, [&](const Outline& face) {
      if (!plane.same_plane(PlaneCoordinates(face), -1)) return false;
      const Polygon contact = plane.flatten(face);
      return std::ranges::all_of(
          extent, [&](const auto& corner) { return is_inside_or_on(contact, corner); });
    });
    if (covered) {
      body_places_[b].fault(fmt::format("it covers \"{}\" wholly", part.name), "move one of them");
    }
  };
  for (std::size_t b = 0; b < room_.furniture.size(); ++b) {
    if (body_read_[b] == 0) continue;
    for (const Opening& o : room_.openings) check(o, b);
    for (const Panel& p : room_.panels) check(p, b);
  }
}

}  // namespace scenes
