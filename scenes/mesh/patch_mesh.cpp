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

constexpr double kCoplanarM = 1e-9;  // faces nearer than this touch
constexpr double kMostPatches = 2e7;
constexpr double kAtEdges = 0.5;    ///< CellSize::at_edges of the room's own faces
constexpr double kCrowdedAt = 0.3;  ///< the same of all faces, and width of rings, where crowded
constexpr double kGapsInside = 3;   ///< a slot is cut as many gaps from its mouth

using Outline = std::vector<Eigen::Vector3d>;  // counter-clockwise seen from the room

/// Bottom, top and sides of a prism, counter-clockwise seen from outside.
std::vector<Outline> prism(const std::vector<Eigen::Vector2d>& plan, double low_m, double high_m) {
  const auto at = [&plan](std::size_t i, double z) {
    const Eigen::Vector2d& p = plan[i % plan.size()];
    return Eigen::Vector3d(p.x(), p.y(), z);
  };
  std::vector<Outline> faces(2);
  for (std::size_t i = 0; i < plan.size(); ++i) {
    faces[0].push_back(at(plan.size() - 1 - i, low_m));
    faces[1].push_back(at(i, high_m));
    faces.push_back({at(i, low_m), at(i + 1, low_m), at(i + 1, high_m), at(i, high_m)});
  }
  return faces;
}

/// Floor, ceiling and walls: a prism seen from inside.
std::vector<Outline> shell(const Room& room) {
  std::vector<Outline> faces = prism(room.plan_m, 0, room.height_m);
  for (Outline& face : faces) std::ranges::reverse(face);
  return faces;
}

/// Coordinates in the plane of a face, the first along its longest edge.
class PlaneCoordinates {
 public:
  explicit PlaneCoordinates(const Outline& face) {
    Eigen::Vector3d vector_area = Eigen::Vector3d::Zero(), longest = vector_area;
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Eigen::Vector3d edge = face[(i + 1) % face.size()] - face[i];
      if (edge.norm() > longest.norm()) longest = edge;
      vector_area += (face[i] - face[0]).cross(edge) / 2;
    }
    // stableNormalized is exact along an axis, so axis-aligned rooms keep their exact coordinates.
    normal_ = vector_area.stableNormalized();
    along_ = longest.stableNormalized();
    up_ = normal_.cross(along_);
    offset_m_ = normal_.dot(face[0]);
  }

  [[nodiscard]] const Eigen::Vector3d& normal() const { return normal_; }

  /// The same plane, seen from the same side (facing = 1) or from the other (-1).
  [[nodiscard]] bool same_plane(const PlaneCoordinates& other, int facing) const {
    return (normal_ - facing * other.normal_).norm() <= kCoplanarM &&
           std::abs(offset_m_ - facing * other.offset_m_) <= kCoplanarM;
  }

  [[nodiscard]] Eigen::Vector3d lift(const Eigen::Vector2d& p) const {
    return offset_m_ * normal_ + p.x() * along_ + p.y() * up_;
  }

  /// Counter-clockwise in the plane, whichever side `outline` is seen from.
  [[nodiscard]] Polygon flatten(const Outline& outline) const {
    Polygon flat;
    for (const Eigen::Vector3d& p : outline) flat.emplace_back(along_.dot(p), up_.dot(p));
    if (area(flat) < 0) std::ranges::reverse(flat);
    return flat;
  }

 private:
  Eigen::Vector3d along_, up_, normal_;
  double offset_m_ = 0;
};

/// A plane face of the room or of a piece of furniture, before it is cut into patches.
struct WholeFace {
  Outline outline;
  PlaneCoordinates plane;
  int surface = 0;
  std::vector<Region> regions;
  int plane_number = 0;
  std::vector<double> at_edges = {};  ///< CellSize::at_edges
};

WholeFace whole_face(Outline outline, int surface) {
  const PlaneCoordinates plane(outline);
  return {.outline = std::move(outline), .plane = plane, .surface = surface, .regions = {}};
}

int host_surface(const Room& room, const Surface& s) {
  const auto index = static_cast<std::size_t>(s.index);
  return s.kind == SurfaceKind::panel ? room.panels.at(index).on : 2 + room.openings.at(index).wall;
}

/// All faces, those of the shell first and in the order of Room::surfaces, with the openings and
/// panels that they hold.
std::vector<WholeFace> whole_faces(const Room& room, Cells cells) {
  std::vector<WholeFace> faces;
  for (Outline& outline : shell(room)) {
    faces.push_back(whole_face(std::move(outline), static_cast<int>(faces.size())));
    faces.back().at_edges = {cells == Cells::crowded ? kCrowdedAt : kAtEdges};
  }
  for (int i = 0; i < static_cast<int>(room.surfaces.size()); ++i) {
    const Surface& s = room.surfaces[static_cast<std::size_t>(i)];
    if (s.kind == SurfaceKind::opening || s.kind == SurfaceKind::panel) {
      WholeFace& host = faces.at(static_cast<std::size_t>(host_surface(room, s)));
      host.regions.push_back({host.plane.flatten(rectangle_of(room, i)), i});
    } else if (s.kind == SurfaceKind::furniture) {
      const Box& box = room.furniture.at(static_cast<std::size_t>(s.index));
      for (Outline& side : prism(footprint(box), box.min_m.z(), box.max_m.z())) {
        faces.push_back(whole_face(std::move(side), i));
        if (cells == Cells::crowded) faces.back().at_edges = {kCrowdedAt};
      }
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
  for (Polygon& piece : convex_pieces(touching)) {
    face.regions.push_back({std::move(piece), kCutAway});
  }
}

void add_contacts(std::vector<WholeFace>& faces) {
  const auto planes = group_by_plane(faces);
  for (auto front = planes.begin(); front != planes.end(); ++front) {
    for (auto back = front + 1; back != planes.end(); ++back) {
      if (!faces[front->front()].plane.same_plane(faces[back->front()].plane, -1)) continue;
      for (const std::size_t i : *front) {
        for (const std::size_t k : *back) {
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
  if ((n + m).norm() > kCoplanarM) return {};
  const double gap = n.dot(b.outline.front() - a.outline.front());
  return gap > -kCoplanarM ? std::optional(std::max(gap, 0.0)) : std::nullopt;
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
      if (*gap <= kCoplanarM) {
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

void require_room(const Room& room) {
  if (!(area(room.plan_m) > 0 && room.height_m > 0)) {  // written so that NaN fails too
    throw std::invalid_argument("the plan is not counter-clockwise, or the height not above 0");
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
  require_room(room);
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
