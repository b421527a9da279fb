#include "solver/rooms/room_faces.h"

#include <algorithm>

#include "solver/factors/pair_factor.h"

namespace solver {
namespace {

constexpr double kNoCut_m = 1e9;  ///< a patch edge longer than any room: faces stay whole
constexpr double kOnPlane_m = 1e-12;
/// Heights above a face's plane, in facet sizes, from which 2 x 2 Gauss points leave less than
/// 1e-6.
constexpr double kHigh = 10;

double highest_m(const std::vector<Eigen::Vector3d>& vertices, const Plane& plane) {
  double highest = -1e300;
  for (const Eigen::Vector3d& v : vertices) highest = std::max(highest, plane.height_m(v));
  return highest;
}

}  // namespace

scenes::PatchMesh whole_mesh(const scenes::Room& room) { return scenes::mesh_room(room, kNoCut_m); }

std::vector<RoomFace> room_faces(const scenes::Room& room) {
  const scenes::PatchMesh mesh = whole_mesh(room);
  std::vector<RoomFace> faces;
  for (std::size_t p = 0; p < mesh.polygon.size(); ++p) {
    const auto same = [&](const RoomFace& f) {
      return f.surface == mesh.surface[p] && f.plane == mesh.plane[p];
    };
    auto face = std::ranges::find_if(faces, same);
    if (face == faces.end()) {
      face = faces.insert(faces.end(), {.surface = mesh.surface[p],
                                        .plane = mesh.plane[p],
                                        .parts = {},
                                        .normal = mesh.normal[p]});
    }
    face->parts.push_back(make_facet(mesh.polygon[p]));
    face->area_m2 += face->parts.back().area_m2;
  }
  return faces;
}

double mean_form_factor(const Facet& facet, const Facet& polygon) {
  const Plane own = facet.plane(), other = polygon.plane();
  if (highest_m(facet.vertices, other) <= kOnPlane_m) return 0;
  if (highest_m(polygon.vertices, own) <= kOnPlane_m) return 0;
  if (other.height_m(facet.centre) < kHigh * facet.size_m) {
    return exchange_area(facet, polygon) / facet.area_m2;
  }
  double sum = 0;
  for (const QuadraturePoint& p : quadrature(facet.vertices, 2)) {
    sum += p.weight_m2 * point_to_polygon(p.position, facet.normal, polygon.vertices);
  }
  return sum / facet.area_m2;
}

}  // namespace solver
