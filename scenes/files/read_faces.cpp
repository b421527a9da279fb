// A room that is given face by face, in place of a plan.
#include <fmt/format.h>

#include <algorithm>

#include "scenes/files/room_reader.h"
#include "scenes/geometry/fits.h"
#include "scenes/shapes/close_shell.h"

namespace scenes {

using Eigen::Vector3d;
using spectra::JsonNode;
using spectra::JsonObject;

namespace {

constexpr std::size_t kMostFaces = 5000, kMostCorners = 1000, kMostHoles = 100;
constexpr double kUpright = 0.5;  ///< sine of the angle from which a wall is a floor or a ceiling

/// Plane and simple; else nothing, after a fault.
std::optional<Outline> read_ring(const JsonNode& node) {
  const auto places = node.list(3, kMostCorners);
  Outline ring;
  for (const JsonNode& place : places) {
    ring.push_back(vector3(place.numbers(3, kCoordinate_m)));
    if (!ring.back().allFinite()) return {};
  }
  if (ring.size() < 3) return {};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if ((ring[(i + 1) % ring.size()] - ring[i]).norm() >= kShortest_m) continue;
    places[(i + 1) % ring.size()].fault("this corner repeats the one before",
                                        "leave one of them out; edges are at least 1 mm long");
    return {};
  }
  if (vector_area_m2(ring).norm() < kShortest_m * kShortest_m) {
    node.fault("the polygon has no area", "give its corners in their order around it");
    return {};
  }
  const PlaneCoordinates plane(ring);
  Polygon flat;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    flat.push_back(plane.flatten(ring[i]));
    const double off_m = std::abs(plane.height_m(ring[i]));
    if (off_m <= kWeld_m) continue;
    places[i].fault(fmt::format("the corners lie in no plane: this one is {:.3g} m off it", off_m),
                    "move it, or part the face into triangles");
    return {};
  }
  if (const auto edge = first_crossing_edge(flat)) {
    places[*edge].fault("the edge from this corner crosses, touches or folds back on another",
                        "give the corners in their order; give holes as \"holes_m\"");
    return {};
  }
  return ring;
}

}  // namespace

void RoomReader::read_faces(const JsonNode& node) {
  for (const char* key : {"plan_m", "wall_names", "height_m", "ceiling"}) {
    if (const auto also = top_.find(key)) {
      also->fault(fmt::format("the room has both faces and \"{}\"", key),
                  "give the shell either by faces or by a plan");
    }
  }
  const Places places = node.list(4, kMostFaces);
  walls_known_ = !places.empty();
  std::vector<ShellFace> faces;
  for (const JsonNode& place : places) {
    if (auto face = read_face(place)) faces.push_back(std::move(*face));
  }
  if (!places.empty() && faces.size() == places.size()) close_faces(std::move(faces), places);
  for (const auto& [name, kind] : shell_surfaces_) {
    if (kind == SurfaceKind::wall) wall_names_.push_back(name);
  }
}

std::optional<ShellFace> RoomReader::read_face(const JsonNode& node) {
  const JsonObject entry = node.object({"surface", "outline_m", "holes_m"});
  const std::string name = entry.name("surface");
  if (name.empty() || name == "walls") walls_known_ = false;
  const auto known =
      std::ranges::find(shell_surfaces_, name, [](const auto& s) { return s.first; });
  ShellFace face{.surface = static_cast<int>(known - shell_surfaces_.begin())};
  if (known == shell_surfaces_.end() && !name.empty()) {
    add_shell_surface(name, SurfaceKind::wall);
    if (name != "floor" && name != "ceiling") claim_name(*entry.find("surface"), name);
  }
  const auto outline = entry.need("outline_m");
  const auto ring = outline ? read_ring(*outline) : std::nullopt;
  bool sound = ring && !name.empty();
  if (ring) face.outline = *ring;
  for (const JsonNode& place : entry.list_or_empty("holes_m", kMostHoles)) {
    const auto hole = read_ring(place);
    sound = sound && hole;
    if (!ring || !hole) continue;
    const PlaneCoordinates plane(*ring);
    const Polygon around = plane.flatten(*ring);
    const bool within = std::ranges::all_of(*hole, [&](const Vector3d& p) {
      return std::abs(plane.height_m(p)) <= kWeld_m && is_inside(around, plane.flatten(p));
    });
    if (!within) {
      place.fault("the hole is not within its face", "give corners in the face's plane, inside");
      sound = false;
    }
    face.holes.push_back(*hole);
  }
  return sound ? std::optional(face) : std::nullopt;
}

/// What looks mostly up is a floor, what looks mostly down a ceiling.
void RoomReader::close_faces(std::vector<ShellFace> faces, const Places& places) {
  const std::vector<ShellFault> faults = close_shell(faces);
  for (const ShellFault& fault : faults) places[fault.face].fault(fault.problem, fault.remedy);
  std::vector<Vector3d> area_m2(shell_surfaces_.size(), Vector3d::Zero());
  for (const ShellFace& face : faces) {
    area_m2[static_cast<std::size_t>(face.surface)] += vector_area_m2(face.outline);
  }
  for (std::size_t s = 0; s < area_m2.size(); ++s) {
    const double up = area_m2[s].normalized().z();
    if (up > kUpright) shell_surfaces_[s].second = SurfaceKind::floor;
    if (up < -kUpright) shell_surfaces_[s].second = SurfaceKind::ceiling;
  }
  if (faults.empty()) set_shell(std::move(faces));
}

}  // namespace scenes
