#include "scenes/mesh/patch_mesh.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "scenes/mesh/surface_cutter.h"

namespace scenes {
namespace {

constexpr double kMostPatches = 2e7;
constexpr double kAtEdges = 0.5;    ///< CellSize::at_edges of the room's own faces
constexpr double kCrowdedAt = 0.3;  ///< the same of all faces, and width of rings, where crowded
constexpr double kGapsInside = 3;   ///< a slot is cut as many gaps from its mouth

constexpr int kShell = -1, kNotThin = -2;  ///< WholeFace::thin; else a sheet, of Room::furniture

/// A plane face of the room or of a piece of furniture, before it is cut into patches.
struct WholeFace {
  Outline outline;
  PlaneCoordinates plane;
  int surface = 0;
  int thin = kNotThin;  ///< faces with one number may lie back to back
  std::vector<Region> regions;
  int plane_number = 0;
  std::vector<double> at_edges = {};  ///< CellSize::at_edges
};

WholeFace whole_face(Outline outline, int surface) {
  const PlaneCoordinates plane(outline);
  return {.outline = std::move(outline), .plane = plane, .surface = surface, .regions = {}};
}

/// Labels the convex pieces of a polygon in a face.
void add_region(WholeFace& face, const Outline& outline, int label) {
  for (Polygon& piece : convex_pieces(face.plane.flatten(outline))) {
    face.regions.push_back({std::move(piece), label});
  }
}

/// All faces, those of the shell first, with their holes and the openings and panels they hold.
std::vector<WholeFace> whole_faces(const Room& room, Cells cells) {
  std::vector<WholeFace> faces;
  for (const ShellFace& face : room.shell) {
    faces.push_back(whole_face(face.outline, face.surface));
    faces.back().at_edges = {cells == Cells::crowded ? kCrowdedAt : kAtEdges};
    faces.back().thin = kShell;  // walls may have no thickness
    for (const Outline& hole : face.holes) add_region(faces.back(), hole, kCutAway);
  }
  for (int i = 0; i < static_cast<int>(room.surfaces.size()); ++i) {
    const Surface& s = room.surfaces[static_cast<std::size_t>(i)];
    const auto index = static_cast<std::size_t>(s.index);
    const auto add_part = [&](const auto& part) {
      WholeFace& host = faces.at(static_cast<std::size_t>(part.face));
      host.regions.push_back({host.plane.flatten(part.outline), i});
    };
    if (s.kind == SurfaceKind::opening) add_part(room.openings.at(index));
    if (s.kind == SurfaceKind::panel) add_part(room.panels.at(index));
    if (s.kind != SurfaceKind::furniture) continue;
    const Body& body = room.furniture.at(index);
    for (std::size_t f = 0; f < body.faces.size(); ++f) {
      if (!body.part_of_face.empty() && body.part_of_face[f] != s.part) continue;
      faces.push_back(whole_face(body.faces[f], i));
      if (body.two_sided) faces.back().thin = s.index;
      if (cells == Cells::crowded) faces.back().at_edges = {kCrowdedAt};
    }
  }
  return faces;
}

/// Numbers the planes from 0. @return the faces in each plane
std::vector<std::vector<std::size_t>> group_by_plane(std::vector<WholeFace>& faces) {
  std::vector<std::vector<std::size_t>> planes;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const auto holds_it = [&](const std::vector<std::size_t>& plane) {
      return faces[plane.front()].plane.same_plane(faces[i].plane, 1);
    };
    const auto plane = std::ranges::find_if(planes, holds_it);
    faces[i].plane_number = static_cast<int>(plane - planes.begin());
    if (plane == planes.end()) {
      planes.push_back({i});
    } else {
      plane->push_back(i);
    }
  }
  return planes;
}

/// A convex polygon whose edges are moved outwards.
Polygon widened(const Polygon& convex, double by_m) {
  Polygon wide;
  const std::size_t n = convex.size();
  const auto outwards = [&](std::size_t i) -> Eigen::Vector2d {
    const Eigen::Vector2d along = (convex[(i + 1) % n] - convex[i]).stableNormalized();
    return {along.y(), -along.x()};
  };
  for (std::size_t i = 0; i < n; ++i) {  // a corner moves where both its edges do
    const Eigen::Vector2d before = outwards((i + n - 1) % n), after = outwards(i);
    wide.push_back(convex[i] + by_m / (1 + before.dot(after)) * (before + after));
  }
  return wide;
}

/// Cuts `face` along the outline of `other`, moved outwards or, below 0, inwards.
void add_outline(WholeFace& face, const WholeFace& other, double outwards_m) {
  for (const Polygon& piece : convex_pieces(face.plane.flatten(other.outline))) {
    Polygon outline = widened(piece, outwards_m);
    const bool turned = area(outline) <= 0;  // moved inwards past its middle
    if (!turned) face.regions.insert(face.regions.begin(), {std::move(outline), kOwn});
  }
}

/// Cuts away from `face` what `other`, in the same plane and facing it, touches.
void add_contact(WholeFace& face, const WholeFace& other) {
  const auto extent = [](const Polygon& polygon) {
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector2d& p : polygon) box.extend(p);
    return box;
  };
  const Polygon own = face.plane.flatten(face.outline),
                touching = face.plane.flatten(other.outline);
  if (!extent(own).intersects(extent(touching))) return;
  add_region(face, other.outline, kCutAway);
}

void add_contacts(std::vector<WholeFace>& faces) {
  const auto planes = group_by_plane(faces);
  for (auto front = planes.begin(); front != planes.end(); ++front) {
    for (auto back = front + 1; back != planes.end(); ++back) {
      if (!faces[front->front()].plane.same_plane(faces[back->front()].plane, -1)) continue;
      for (const std::size_t i : *front) {
        for (const std::size_t k : *back) {
          const bool back_to_back = faces[i].thin != kNotThin && faces[i].thin == faces[k].thin;
          if (back_to_back) continue;
          add_contact(faces[i], faces[k]);
          add_contact(faces[k], faces[i]);
        }
      }
    }
  }
}

/// How far apart two faces are that are parallel and look at each other.
std::optional<double> gap_m(const WholeFace& a, const WholeFace& b) {
  const Eigen::Vector3d &n = a.plane.normal(), m = b.plane.normal();
  if ((n + m).norm() > kCoplanar_m) return {};
  const double gap = n.dot(b.outline.front() - a.outline.front());
  return gap > -kCoplanar_m ? std::optional(std::max(gap, 0.0)) : std::nullopt;
}

/// Light changes fast where furniture stands on a face, and where it is nearer to one than patches
/// are long: a ring around the one, the outline of the other, and a line inside of it, where the
/// slot gets dark.
void crowd(std::vector<WholeFace>& faces, const Room& room, double patch_m) {
  const auto is_furniture = [&](const WholeFace& face) {
    return room.surfaces[static_cast<std::size_t>(face.surface)].kind == SurfaceKind::furniture;
  };
  for (WholeFace& face : faces) {
    for (const WholeFace& other : faces) {
      if (&face == &other || !is_furniture(other)) continue;
      const std::optional<double> gap = gap_m(face, other);
      if (!gap || *gap >= patch_m) continue;
      if (*gap <= kCoplanar_m) {
        add_outline(face, other, kCrowdedAt * patch_m);
      } else {
        add_outline(face, other, -kGapsInside * *gap);
        add_outline(face, other, 0);
      }
    }
  }
}

struct Patch {
  std::vector<Eigen::Vector3d> polygon;
  Eigen::Vector3d centre, normal;
  double area_m2 = 0;
  int plane = 0;
};

/// Cuts one face and files its patches under the surfaces that they belong to.
void cut_into_patches(const WholeFace& face, double patch_m,
                      std::vector<std::vector<Patch>>& of_surface) {
  const PlaneCoordinates& plane = face.plane;
  const CellSize size{.patch_m = patch_m, .at_edges = face.at_edges};
  for (const Piece& piece : cut_surface(plane.flatten(face.outline), face.regions, size)) {
    const int surface = piece.label == 0 ? face.surface : piece.label;
    Patch patch{.polygon = {},
                .centre = plane.lift(centroid(piece.outline)),
                .normal = plane.normal(),
                .area_m2 = area(piece.outline),
                .plane = face.plane_number};
    for (const Eigen::Vector2d& p : piece.outline) patch.polygon.push_back(plane.lift(p));
    of_surface.at(static_cast<std::size_t>(surface)).push_back(std::move(patch));
  }
}

void require_sensible_patches(const std::vector<WholeFace>& faces, double patch_m) {
  if (!(patch_m > 0)) {
    throw std::invalid_argument(fmt::format("patch_m is {}; want a length above 0", patch_m));
  }
  double area_m2 = 0;
  for (const WholeFace& face : faces) area_m2 += area(face.plane.flatten(face.outline));
  if (!std::isfinite(area_m2)) throw std::invalid_argument("a coordinate is not finite");
  if (area_m2 / patch_m > kMostPatches * patch_m) {
    throw std::length_error(
        fmt::format("patch_m {} m would make over {:.0e} patches; use at least {:.2g} m", patch_m,
                    kMostPatches, std::sqrt(area_m2 / kMostPatches)));
  }
}

}  // namespace

PatchMesh mesh_room(const Room& room, double patch_m, Cells cells) {
  std::vector<WholeFace> faces = whole_faces(room, cells);
  require_sensible_patches(faces, patch_m);
  if (cells == Cells::crowded) crowd(faces, room, patch_m);
  add_contacts(faces);
  std::vector<std::vector<Patch>> of_surface(room.surfaces.size());
  for (const WholeFace& face : faces) cut_into_patches(face, patch_m, of_surface);

  PatchMesh mesh;
  for (std::size_t surface = 0; surface < of_surface.size(); ++surface) {
    for (Patch& patch : of_surface[surface]) {
      mesh.polygon.push_back(std::move(patch.polygon));
      mesh.centre.push_back(patch.centre);
      mesh.normal.push_back(patch.normal);
      mesh.area_m2.push_back(patch.area_m2);
      mesh.surface.push_back(static_cast<int>(surface));
      mesh.plane.push_back(patch.plane);
    }
  }
  return mesh;
}

}  // namespace scenes
