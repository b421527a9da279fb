// Parts of the shell that are something else: the openings of a room file, and where panels are.
#include <fmt/format.h>

#include <algorithm>

#include "scenes/files/room_reader.h"
#include "scenes/geometry/fits.h"
#include "scenes/shapes/shell.h"

namespace scenes {

using spectra::JsonNode;
using spectra::JsonObject;
using spectra::Limits;

namespace {

constexpr Limits kNotNegative_m{.least = 0, .most = 1e4};
constexpr double kOnFace_m = 1e-6;  ///< how far corners may lie off the face that they are on
constexpr std::size_t kMostCorners = 100;

bool is_convex(const Polygon& polygon) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Line edge = edge_line(polygon, i);
    const bool kept = std::ranges::all_of(
        polygon, [&](const Eigen::Vector2d& p) { return edge.left_by(p) >= -kTouch_m; });
    if (!kept) return false;
  }
  return true;
}

}  // namespace

void RoomReader::read_openings() {
  for (const JsonNode& node : top_.list_or_empty("openings")) {
    const JsonObject entry =
        node.object({"name", "wall", "offset_m", "sill_m", "width_m", "height_m", "on", "center_m",
                     "size_m", "outline_m", "transmittance", "glass"});
    const bool in_wall = !entry.has("on") && !entry.has("outline_m") && !top_.has("faces");
    const FacePart part = in_wall ? read_part_of_wall(entry) : read_part(entry, "opening");
    const auto transmittance = entry.find("transmittance"), glass = entry.find("glass");
    if (transmittance && glass) {
      transmittance->fault("the opening has a transmittance and glass",
                           "keep one of them; that of glass depends on the angle");
    }
    const std::string name = entry.name("name");
    if (const auto place = entry.find("name")) claim_name(*place, name);
    if (!part.outline.empty()) check_overlap(part, node, "opening");
    room_.openings.push_back({.name = name,
                              .face = part.face,
                              .outline = part.outline,
                              .transmittance = transmittance ? curves_.transmittance(*transmittance)
                                                             : spectra::constant(curves_.grid(), 1),
                              .glass = glass ? read_glass(*glass) : std::nullopt});
    opening_places_.push_back(node);
    opening_area_m2_.push_back(part.area_m2);
  }
}

RoomReader::FacePart RoomReader::read_part_of_wall(const JsonObject& opening) {
  for (const char* key : {"center_m", "size_m"}) {
    if (const auto node = opening.find(key)) {
      node->fault(fmt::format("\"{}\" goes with \"on\"", key),
                  "leave it out, or give \"on\" in place of \"wall\"");
    }
  }
  const auto wall_name = opening.need("wall");
  const int wall = wall_name ? wall_named(*wall_name) : -1;
  const double offset_m = opening.number("offset_m", kNotNegative_m),
               sill_m = opening.number("sill_m", kNotNegative_m),
               width_m = opening.number("width_m", kLength_m),
               height_m = opening.number("height_m", kLength_m);
  FacePart part{.area_m2 = width_m * height_m};
  if (wall < 0 || !shell_sound_ || !std::isfinite(offset_m + sill_m + width_m + height_m)) {
    return part;
  }
  part.face = face_under(wall + 2, {});
  const Eigen::Vector2d low(offset_m, sill_m);
  part.outline = rectangle_in(room_.shell[static_cast<std::size_t>(part.face)].frame, low,
                              low + Eigen::Vector2d(width_m, height_m));
  const auto first = static_cast<std::size_t>(wall);
  const double length_m = (plan_m_[(first + 1) % plan_m_.size()] - plan_m_[first]).norm();
  if (offset_m + width_m > length_m + kTouch_m) {
    opening.fault(fmt::format("it ends {} m along a wall of {} m", offset_m + width_m, length_m),
                  "make offset_m or width_m smaller");
  } else if (!fits_on_face(part)) {
    opening.fault(fmt::format("its top is at {} m, above the wall's", sill_m + height_m),
                  "make sill_m or height_m smaller");
  }
  return part;
}

RoomReader::FacePart RoomReader::read_part(const JsonObject& shape, const std::string& what) {
  const auto outline = shape.find("outline_m");
  if (!outline && top_.has("faces")) {
    shape.fault(fmt::format("the {} has no outline", what),
                "in a room of faces, give \"outline_m\"");
    return {};
  }
  if (!outline) return read_rectangle(shape, what);
  for (const char* key :
       {"on", "center_m", "size_m", "wall", "offset_m", "sill_m", "width_m", "height_m"}) {
    if (const auto node = shape.find(key)) {
      node->fault(fmt::format("the {} has an outline already", what), "leave this out");
    }
  }
  return read_polygon(*outline, what);
}

RoomReader::FacePart RoomReader::read_rectangle(const JsonObject& shape, const std::string& what) {
  for (const char* key : {"wall", "offset_m", "sill_m", "width_m", "height_m"}) {
    if (const auto node = shape.find(key)) {
      node->fault(fmt::format("\"{}\" does not go with \"on\"", key),
                  "give \"on\", \"center_m\" and \"size_m\"");
    }
  }
  const std::vector<double> at = shape.numbers("center_m", 2, kCoordinate_m),
                            wide = shape.numbers("size_m", 2, kLength_m);
  const auto on = shape.need("on");
  const int surface = on ? surface_named(*on) : -1;
  const Eigen::Vector2d centre_m(at[0], at[1]), size_m(wide[0], wide[1]);
  FacePart part{.area_m2 = size_m.prod()};
  if (surface < 0 || !shell_sound_ || !centre_m.allFinite() || !size_m.allFinite()) return part;
  part.face = face_under(surface, centre_m);
  if (part.face >= 0) {
    Frame frame = room_.shell[static_cast<std::size_t>(part.face)].frame;
    Eigen::Vector2d middle = centre_m;
    if (surface == 1 && std::abs(frame.normal.z()) < 1) {  // on a slope, above that place
      const Eigen::Vector3d &n = frame.normal, foot(centre_m.x(), centre_m.y(), 0);
      frame.origin_m = foot + n.dot(frame.origin_m - foot) / n.z() * Eigen::Vector3d::UnitZ();
      middle.setZero();
    }
    part.outline = rectangle_in(frame, middle - size_m / 2, middle + size_m / 2);
  }
  if (part.face < 0 || !fits_on_face(part)) {
    shape.fault(fmt::format("the {} reaches beyond the surface that it is on", what),
                "move it or make it smaller; on a wall, center_m is [along, up]");
  }
  return part;
}

RoomReader::FacePart RoomReader::read_polygon(const JsonNode& outline, const std::string& what) {
  FacePart part;
  for (const JsonNode& corner : outline.list(3, kMostCorners)) {
    part.outline.push_back(vector3(corner.numbers(3, kCoordinate_m)));
  }
  const auto finite = [](const Eigen::Vector3d& p) { return p.allFinite(); };
  if (!shell_sound_ || part.outline.size() < 3 || !std::ranges::all_of(part.outline, finite)) {
    return {};
  }
  for (std::size_t f = 0; f < room_.shell.size(); ++f) {
    const PlaneCoordinates plane(room_.shell[f].outline);
    const auto on = [&](const Eigen::Vector3d& p) {
      return std::abs(plane.height_m(p)) <= kOnFace_m;
    };
    if (!std::ranges::all_of(part.outline, on)) continue;
    FacePart here{.face = static_cast<int>(f), .outline = {}};
    const Polygon polygon =
        without_collinear_corners(flat(here.face, part.outline), kTouch_m);  // in its order
    for (const Eigen::Vector2d& p : polygon) here.outline.push_back(plane.lift(p));
    here.area_m2 = area(polygon);
    if (polygon.size() < 3 || first_crossing_edge(polygon) || here.area_m2 < 1e-6) {
      outline.fault("the outline crosses itself, or has no area",
                    "give its corners in their order");
      return {};
    }
    if (!is_convex(polygon)) {
      outline.fault("the outline is not convex", "make it of several that are");
      return {};
    }
    if (fits_on_face(here)) return here;
  }
  outline.fault(fmt::format("the {} lies on no face of the room", what),
                "give corners in the plane of a wall, floor or ceiling, within its edges");
  return {};
}

int RoomReader::face_under(int surface, const Eigen::Vector2d& point_m) const {
  int first = -1;
  for (std::size_t f = 0; f < room_.shell.size(); ++f) {
    const ShellFace& face = room_.shell[f];
    if (face.surface != surface) continue;
    if (first < 0) first = static_cast<int>(f);
    if (surface > 1) break;  // a wall has one face
    Polygon seen_from_above;
    for (const Eigen::Vector3d& p : face.outline) seen_from_above.push_back(p.head<2>());
    if (is_inside_or_on(seen_from_above, point_m)) return static_cast<int>(f);
  }
  return surface > 1 ? first : -1;
}

Polygon RoomReader::flat(int face, const Outline& outline) const {
  return PlaneCoordinates(room_.shell[static_cast<std::size_t>(face)].outline).flatten(outline);
}

bool RoomReader::fits_on_face(const FacePart& part) const {
  const ShellFace& face = room_.shell[static_cast<std::size_t>(part.face)];
  const Polygon extent = flat(part.face, part.outline);
  if (!fits_into(flat(part.face, face.outline), extent)) return false;
  return std::ranges::none_of(face.holes, [&](const Outline& hole) {
    const Polygon edge = flat(part.face, hole);
    return !std::ranges::none_of(edge, [&](const auto& p) { return is_inside(extent, p); }) ||
           !std::ranges::none_of(extent, [&](const auto& p) { return is_inside(edge, p); });
  });
}

void RoomReader::check_overlap(const FacePart& part, const JsonNode& place,
                               const std::string& what) const {
  const Polygon extent = flat(part.face, part.outline);
  const auto check = [&](const auto& others, const char* kind) {
    for (const auto& other : others) {
      if (other.face != part.face || other.outline.empty()) continue;
      if (!overlap(extent, flat(part.face, other.outline))) continue;
      place.fault(fmt::format("the {} overlaps the {} \"{}\"", what, kind, other.name),
                  "move one of them");
    }
  };
  check(room_.openings, "opening");
  check(room_.panels, "panel");
}

}  // namespace scenes
