#include "scenes/shapes/mesh_body.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "scenes/geometry/corner_weld.h"
#include "scenes/geometry/fits.h"
#include "scenes/shapes/close_shell.h"
#include "scenes/shapes/enclosure.h"
#include "scenes/shapes/plates.h"

namespace scenes {
namespace {

using Eigen::Vector3d;

constexpr double kNoArea_m2 = 1e-10;
constexpr double kOnePlane = 1e-6;  ///< m, and sine of the angle between normals

/// Sets that are joined two by two.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  [[nodiscard]] std::size_t of(std::size_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }

  void join(std::size_t a, std::size_t b) {
    a = of(a), b = of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

std::string place_of(const Outline& outline) {
  const Vector3d& p = outline.front();
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", p.x(), p.y(), p.z());
}

bool is_plane(const Outline& outline) {
  const PlaneCoordinates plane(outline);
  return std::ranges::all_of(
      outline, [&](const Vector3d& p) { return std::abs(plane.height_m(p)) <= kWeld_m; });
}

/// What all of a mesh is made of, and what was done to it.
class Cleaning {
 public:
  explicit Cleaning(MeshBody& result) : result_(result) {}

  std::vector<ShellFace> faces(const std::vector<MeshPolygon>& polygons) {
    CornerWeld corners(kWeld_m);
    for (const MeshPolygon& polygon : polygons) {
      add(corners.welded(polygon.outline), polygon.part);
    }
    if (without_area_ > 0) {
      result_.notes.push_back(fmt::format("{} faces have no area; left out", without_area_));
    }
    if (bent_ > 0) {
      result_.notes.push_back(fmt::format("{} bent quadrilaterals are parted in two", bent_));
    }
    return std::move(faces_);
  }

 private:
  void add(const Outline& outline, int part) {
    if (outline.size() < 3 || vector_area_m2(outline).norm() < kNoArea_m2) {
      ++without_area_;
    } else if (is_plane(outline)) {
      add_plane(outline, part);
    } else if (outline.size() == 4) {
      ++bent_;
      const std::size_t k =
          (outline[2] - outline[0]).norm() <= (outline[3] - outline[1]).norm() ? 0 : 1;
      add({outline[k], outline[k + 1], outline[k + 2]}, part);
      add({outline[k + 2], outline[(k + 3) % 4], outline[k]}, part);
    } else {
      result_.faults.push_back("the face from " + place_of(outline) +
                               " is not plane; triangulate the model");
    }
  }

  void add_plane(const Outline& outline, int part) {
    if (first_crossing_edge(PlaneCoordinates(outline).flatten(outline))) {
      result_.faults.push_back("the face from " + place_of(outline) +
                               " crosses or touches itself; triangulate the model");
      return;
    }
    faces_.push_back({.surface = part, .outline = outline});
  }

  MeshBody& result_;
  std::vector<ShellFace> faces_;
  int without_area_ = 0, bent_ = 0;
};

using Step = std::pair<int, int>;  ///< from corner to corner

/// The one ring around faces in a plane that are joined by edges; none if it has holes or touches
/// itself.
std::optional<Outline> ring_around(const std::vector<std::vector<int>>& rings,
                                   const CornerWeld& corners) {
  std::map<Step, int> steps;
  for (const std::vector<int>& ring : rings) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      ++steps[{ring[k], ring[(k + 1) % ring.size()]}];
    }
  }
  std::map<int, int> next;
  for (const auto& [step, count] : steps) {
    if (steps.contains({step.second, step.first})) continue;
    if (count > 1 || !next.emplace(step).second) return {};
  }
  Outline outline;
  int at = next.begin()->first;
  const int first = at;
  do {
    outline.push_back(corners.at(at));
    const auto step = next.find(at);
    if (step == next.end() || outline.size() > next.size()) return {};
    at = step->second;
  } while (at != first);
  return outline.size() == next.size() ? std::optional(outline) : std::nullopt;
}

Outline straightened(const Outline& outline) {
  const PlaneCoordinates plane(outline);
  Polygon flat;
  for (const Vector3d& p : outline) flat.push_back(plane.flatten(p));
  Outline kept;
  for (const Eigen::Vector2d& p : without_collinear_corners(flat, kWeld_m / 10)) {
    kept.push_back(outline[static_cast<std::size_t>(std::ranges::find(flat, p) - flat.begin())]);
  }
  return kept;
}

/// Joins faces that share an edge, a part and a plane. They are oriented.
std::vector<ShellFace> joined(const std::vector<ShellFace>& faces) {
  CornerWeld corners(kWeld_m);
  std::vector<std::vector<int>> rings;
  std::vector<PlaneCoordinates> planes;
  std::map<Step, std::size_t> of_step;
  for (const ShellFace& face : faces) {
    std::vector<int>& ring = rings.emplace_back();
    for (const Vector3d& p : face.outline) ring.push_back(corners.number(p));
    planes.emplace_back(face.outline);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      of_step[{ring[k], ring[(k + 1) % ring.size()]}] = rings.size() - 1;
    }
  }
  Groups groups(faces.size());
  for (const auto& [step, f] : of_step) {
    const auto other = of_step.find({step.second, step.first});
    if (other == of_step.end() || faces[f].surface != faces[other->second].surface) continue;
    const PlaneCoordinates &a = planes[f], &b = planes[other->second];
    const bool one_plane = (a.normal() - b.normal()).norm() <= kOnePlane &&
                           std::ranges::all_of(faces[other->second].outline, [&](const auto& p) {
                             return std::abs(a.height_m(p)) <= kOnePlane;
                           });
    if (one_plane) groups.join(f, other->second);
  }
  std::map<std::size_t, std::vector<std::size_t>> members;
  for (std::size_t f = 0; f < faces.size(); ++f) members[groups.of(f)].push_back(f);
  std::vector<ShellFace> result;
  for (const auto& [first, group] : members) {
    std::vector<std::vector<int>> of_group;
    for (const std::size_t f : group) of_group.push_back(rings[f]);
    const auto ring = group.size() > 1 ? ring_around(of_group, corners) : std::nullopt;
    if (ring && is_plane(*ring)) {
      result.push_back({.surface = faces[first].surface, .outline = straightened(*ring)});
      continue;
    }
    for (const std::size_t f : group) {
      result.push_back({.surface = faces[f].surface, .outline = straightened(faces[f].outline)});
    }
  }
  return result;
}

/// Faces that hang together by corners: what is convex hides as a whole, all else face by face.
void add_parts(Body& body) {
  CornerWeld corners(kWeld_m);
  std::vector<std::vector<int>> rings;
  for (const Outline& face : body.faces) {
    std::vector<int>& ring = rings.emplace_back();
    for (const Vector3d& p : face) ring.push_back(corners.number(p));
  }
  Groups groups(static_cast<std::size_t>(corners.size()));
  for (const std::vector<int>& ring : rings) {
    for (const int c : ring) {
      groups.join(static_cast<std::size_t>(ring[0]), static_cast<std::size_t>(c));
    }
  }
  std::map<std::size_t, std::vector<std::size_t>> shells;
  for (std::size_t f = 0; f < rings.size(); ++f) {
    shells[groups.of(static_cast<std::size_t>(rings[f][0]))].push_back(f);
  }
  for (const auto& [first, faces] : shells) {
    std::map<int, int> renumbered;
    ConvexPart part;
    for (const std::size_t f : faces) {
      std::vector<int>& ring = part.faces.emplace_back();
      for (const int c : rings[f]) {
        const auto [at, is_new] = renumbered.emplace(c, static_cast<int>(part.corners.size()));
        if (is_new) part.corners.push_back(corners.at(c));
        ring.push_back(at->second);
      }
    }
    const bool convex = std::ranges::all_of(faces, [&](std::size_t f) {
      const PlaneCoordinates plane(body.faces[f]);
      return std::ranges::all_of(part.corners,
                                 [&](const Vector3d& p) { return plane.height_m(p) <= kWeld_m; });
    });
    if (convex) {
      body.parts.push_back(std::move(part));
      continue;
    }
    for (const std::size_t f : faces) {
      for (const Outline& piece : convex_parts(body.faces[f])) body.parts.push_back(plate(piece));
    }
  }
}

}  // namespace

MeshBody mesh_body(std::string name, const std::vector<MeshPolygon>& polygons, bool two_sided) {
  MeshBody result;
  Body& body = result.body;
  body.name = std::move(name);
  body.two_sided = two_sided;
  constexpr std::size_t kMostGiven = 5 * kMostMeshFaces;  // before faces in one plane are joined
  if (polygons.size() > kMostGiven) {
    result.faults.push_back(
        fmt::format("the mesh has {} faces; simplify it to {}, or to {} that are not in one plane",
                    polygons.size(), kMostGiven, kMostMeshFaces));
    return result;
  }
  std::vector<ShellFace> faces = Cleaning(result).faces(polygons);
  if (two_sided) {
    for (const auto& [f, g] : crossing_faces(faces, false)) {
      result.faults.push_back("the faces from " + place_of(faces[f].outline) + " and " +
                              place_of(faces[g].outline) + " cross or lie on each other");
    }
  } else {
    for (const ShellFault& fault : close_shell(faces, true)) {
      result.faults.push_back("the face from " + place_of(faces[fault.face].outline) + ": " +
                              fault.problem);
    }
  }
  if (!result.faults.empty()) return result;
  faces = joined(faces);
  if (faces.size() > kMostMeshFaces) {
    result.faults.push_back(fmt::format("the mesh has {} plane faces; at most {} are taken",
                                        faces.size(), kMostMeshFaces));
    return result;
  }
  for (const ShellFace& face : faces) {
    body.faces.emplace_back(face.outline.rbegin(), face.outline.rend());
    body.part_of_face.push_back(face.surface);
    if (!two_sided) continue;
    body.faces.push_back(face.outline);
    body.part_of_face.push_back(face.surface);
    for (const Outline& piece : convex_parts(face.outline)) body.parts.push_back(plate(piece));
  }
  if (!two_sided) add_parts(body);
  return result;
}

}  // namespace scenes
