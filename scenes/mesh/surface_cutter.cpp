#include "scenes/mesh/surface_cutter.h"

#include <Eigen/Geometry>
#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>

namespace scenes {
namespace {

constexpr double kSnapM = 1e-9;       // closer than this to a line is on it; no edge is shorter
constexpr double kMinAreaM2 = 1e-14;  // no piece is smaller
constexpr double kStraightM = 1e-12;  // rounding of a corner put on an edge; true corners bend more

/// OpenMesh keeps the half-edges; places and labels are ours.
class Mesh : public OpenMesh::PolyConnectivity {
 public:
  VertexHandle add_vertex(const Eigen::Vector2d& p) {
    points_.push_back(p);
    return new_vertex();
  }

  [[nodiscard]] const Eigen::Vector2d& point(VertexHandle v) const {
    return points_[static_cast<std::size_t>(v.idx())];
  }

  int& label(FaceHandle f) {
    labels_.resize(n_faces());
    return labels_[static_cast<std::size_t>(f.idx())];
  }

 private:
  std::vector<Eigen::Vector2d> points_;
  std::vector<int> labels_;
};

using Face = Mesh::FaceHandle;
using Halfedge = Mesh::HalfedgeHandle;

struct Halves {
  std::optional<Face> left{}, right{};
};

Polygon outline_of(const Mesh& mesh, Face face) {
  Polygon polygon;
  for (const auto vertex : mesh.fv_ccw_range(face)) polygon.push_back(mesh.point(vertex));
  return polygon;
}

/// Where the inside of an edge crosses a line, if it does.
std::optional<Eigen::Vector2d> crossing(const Mesh& mesh, Halfedge edge, const Line& line) {
  const Eigen::Vector2d from = mesh.point(mesh.from_vertex_handle(edge));
  const Eigen::Vector2d to = mesh.point(mesh.to_vertex_handle(edge));
  const double start = line.left_by(from), end = line.left_by(to);
  if (std::min(start, end) >= -kSnapM || std::max(start, end) <= kSnapM) return {};
  return from + start / (start - end) * (to - from);
}

/// Puts a vertex wherever the line crosses an edge of the face.
void split_crossed_edges(Mesh& mesh, Face face, const Line& line) {
  const auto range = mesh.fh_ccw_range(face);
  for (const Halfedge h : std::vector<Halfedge>(range.begin(), range.end())) {
    const auto point = crossing(mesh, h, line);
    if (point) mesh.split_edge(mesh.edge_handle(h), mesh.add_vertex(*point));
  }
}

/// Divides the face along a new edge that ends where `before` starts and starts where `after` ends;
/// the left half keeps both.
Halves divide(Mesh& mesh, Face face, Halfedge before, Halfedge after) {
  const int label = mesh.label(face);
  const Halfedge h = mesh.insert_edge(after, before);
  const Face left = mesh.face_handle(h);
  const Face right = mesh.face_handle(mesh.opposite_halfedge_handle(h));
  mesh.label(left) = mesh.label(right) = label;
  return {.left = left, .right = right};
}

/// Cuts a convex face by a line, unless one of the halves would have no area to speak of.
Halves cut(Mesh& mesh, Face face, const Line& line) {
  const Polygon outline = outline_of(mesh, face);
  double furthest_left = 0, furthest_right = 0;
  for (const Eigen::Vector2d& p : outline) {
    furthest_left = std::max(furthest_left, line.left_by(p));
    furthest_right = std::max(furthest_right, -line.left_by(p));
  }
  const double left_area = area(clip(outline, line));
  if (furthest_left <= kSnapM || left_area < kMinAreaM2) return {.right = face};
  if (furthest_right <= kSnapM || area(outline) - left_area < kMinAreaM2) return {.left = face};

  split_crossed_edges(mesh, face, line);
  Halfedge enters, leaves;  // the one run of vertices on the left
  for (const auto h : mesh.fh_ccw_range(face)) {
    const bool from_left = line.left_by(mesh.point(mesh.from_vertex_handle(h))) > kSnapM;
    const bool to_left = line.left_by(mesh.point(mesh.to_vertex_handle(h))) > kSnapM;
    if (!from_left && to_left) enters = h;
    if (from_left && !to_left) leaves = h;
  }
  return divide(mesh, face, enters, leaves);
}

/// Cuts by parallel lines, sorted from left to right, and appends the pieces in that order. Halving
/// the lines keeps the work at (pieces) x log(lines).
void cut_by_lines(Mesh& mesh, const std::vector<Face>& faces, std::span<const Line> lines,
                  std::vector<Face>& pieces) {
  if (lines.empty()) {
    pieces.insert(pieces.end(), faces.begin(), faces.end());
    return;
  }
  const std::size_t middle = lines.size() / 2;
  std::vector<Face> left, right;
  for (const Face face : faces) {
    const Halves halves = cut(mesh, face, lines[middle]);
    if (halves.left) left.push_back(*halves.left);
    if (halves.right) right.push_back(*halves.right);
  }
  cut_by_lines(mesh, left, lines.first(middle), pieces);
  cut_by_lines(mesh, right, lines.subspan(middle + 1), pieces);
}

/// Where a ray first meets the boundary of a face: at the end of an edge, or between its ends.
struct Hit {
  double distance_m = std::numeric_limits<double>::infinity();
  Halfedge edge;
  bool at_end = false;
};

Hit first_hit(const Mesh& mesh, Face face, const Line& ray) {
  Hit first;
  for (const auto h : mesh.fh_ccw_range(face)) {
    const Eigen::Vector2d end = mesh.point(mesh.to_vertex_handle(h));
    const bool at_end = std::abs(ray.left_by(end)) <= kSnapM;
    const auto met = at_end ? std::optional(end) : crossing(mesh, h, ray);
    const double distance_m = met ? ray.direction.dot(*met - ray.point) : 0;
    if (distance_m > kSnapM && distance_m < first.distance_m) first = {distance_m, h, at_end};
  }
  return first;
}

/// Divides a face at a reflex corner, the end of `edge`, by extending this edge or the next,
/// whichever is the shorter cut.
Halves divide_at_reflex(Mesh& mesh, Face face, Halfedge edge) {
  const Halfedge next = mesh.next_halfedge_handle(edge);
  const Eigen::Vector2d corner = mesh.point(mesh.to_vertex_handle(edge));
  const auto ray_from = [&](const Eigen::Vector2d& behind) {
    return Line{corner, (corner - behind).stableNormalized()};
  };
  const Line onward = ray_from(mesh.point(mesh.from_vertex_handle(edge)));
  const Line back = ray_from(mesh.point(mesh.to_vertex_handle(next)));
  const Hit ahead = first_hit(mesh, face, onward), behind = first_hit(mesh, face, back);
  const bool go_on = ahead.distance_m <= behind.distance_m;
  const Hit& hit = go_on ? ahead : behind;
  if (!hit.edge.is_valid()) throw std::invalid_argument("the outline is not a simple polygon");

  Halfedge arrives = hit.edge;
  if (!hit.at_end) {
    const Eigen::Vector2d met = corner + hit.distance_m * (go_on ? onward : back).direction;
    const auto vertex = mesh.add_vertex(met);
    mesh.split_edge(mesh.edge_handle(hit.edge), vertex);
    if (mesh.to_vertex_handle(arrives) != vertex) arrives = mesh.prev_halfedge_handle(arrives);
  }
  return divide(mesh, face, next, arrives);
}

/// The edge before a corner of more than 180 degrees; invalid if the face is convex. The corner
/// must stand out seen from both its edges, or extending one would end on the other.
Halfedge edge_before_reflex(const Mesh& mesh, Face face) {
  for (const auto h : mesh.fh_ccw_range(face)) {
    const Eigen::Vector2d corner = mesh.point(mesh.to_vertex_handle(h));
    const Eigen::Vector2d before = corner - mesh.point(mesh.from_vertex_handle(h));
    const Eigen::Vector2d after =
        mesh.point(mesh.to_vertex_handle(mesh.next_halfedge_handle(h))) - corner;
    const double turn = before.x() * after.y() - before.y() * after.x();
    if (turn < -kSnapM * std::max(before.norm(), after.norm())) return h;
  }
  return Halfedge();
}

std::vector<Face> convex_faces(Mesh& mesh, const Polygon& outline) {
  std::vector<Mesh::VertexHandle> corners;
  for (const Eigen::Vector2d& p : outline) corners.push_back(mesh.add_vertex(p));
  std::vector<Face> convex, open{mesh.add_face(corners)};
  while (!open.empty()) {
    const Face face = open.back();
    open.pop_back();
    const Halfedge edge = edge_before_reflex(mesh, face);
    if (convex.size() + open.size() >= outline.size()) {
      throw std::invalid_argument("the outline is not a simple polygon");
    }
    if (edge.is_valid()) {
      const Halves halves = divide_at_reflex(mesh, face, edge);
      open.insert(open.end(), {*halves.right, *halves.left});
    } else {
      convex.push_back(face);
    }
  }
  return convex;
}

/// Where a grid line must be, and on which of its sides an edge of the outline has its face.
struct Stop {
  double at_m = 0;
  bool face_below = false, face_above = false;
};

/// Along one coordinate, in order: at the ends and at every edge at right angles to it.
std::vector<Stop> grid_stops(const Polygon& outline, const std::vector<Region>& regions,
                             Eigen::Index coordinate) {
  const auto along = [coordinate](const auto& p) { return p[coordinate]; };
  const auto [low, high] = std::ranges::minmax(outline, {}, along);
  std::vector<Stop> stops{{.at_m = low[coordinate]}, {.at_m = high[coordinate]}};
  const auto add_edges = [&](const Polygon& polygon, bool bounds_face) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Eigen::Vector2d edge = polygon[(i + 1) % polygon.size()] - polygon[i];
      if (std::abs(edge[coordinate]) > kSnapM) continue;
      const bool below = (edge[1 - coordinate] > 0) == (coordinate == 0);  // on its left
      stops.push_back({polygon[i][coordinate], bounds_face && below, bounds_face && !below});
    }
  };
  add_edges(outline, true);
  for (const Region& region : regions) {
    if (region.label != kCutAway && region.label != kOwn) add_edges(region.outline, false);
  }
  std::ranges::sort(stops, {}, &Stop::at_m);
  std::vector<Stop> distinct;
  for (const Stop& s : stops) {
    if (distinct.empty() || s.at_m - distinct.back().at_m > kSnapM) distinct.push_back({s.at_m});
    distinct.back().face_below |= s.face_below;
    distinct.back().face_above |= s.face_above;
  }
  return distinct;
}

/// Where cells begin between two stops, in widths of a cell: narrower ones at either end, or none
/// if they do not all fit beside a whole one.
struct CellStarts {
  std::vector<double> low, high;  ///< of the narrower cells, from the stop on
  double less = 0;                ///< by how much all of them are narrower than whole cells
};

CellStarts narrower_cells(const std::vector<double>& widths, bool low, bool high) {
  CellStarts starts;
  double from_stop = 0;
  for (const double width : widths) {
    if (low) starts.low.push_back(from_stop);
    from_stop += width;
    if (high) starts.high.push_back(from_stop);
    starts.less += (low ? 1 - width : 0) + (high ? 1 - width : 0);
  }
  return starts;
}

/// Lines at right angles to one coordinate, from left to right: at every stop, and in between in
/// cells of one width, but for those at an edge of the outline.
std::vector<Line> grid_lines(const std::vector<Stop>& stops, Eigen::Index coordinate,
                             const CellSize& size) {
  const Eigen::Vector2d direction =
      coordinate == 0 ? Eigen::Vector2d(0, 1) : Eigen::Vector2d(-1, 0);
  std::vector<Line> lines;
  for (std::size_t i = 1; i < stops.size(); ++i) {
    const Stop &low = stops[i - 1], &high = stops[i];
    const double length_m = high.at_m - low.at_m;
    const bool one_cell = length_m - kSnapM <= size.patch_m;
    const CellStarts ends =
        narrower_cells(size.at_edges, low.face_above && !one_cell, high.face_below && !one_cell);
    const double whole_cells = (length_m - kSnapM) / size.patch_m;
    const int narrower = static_cast<int>(ends.low.size() + ends.high.size());
    const int cells = std::max({1, narrower, static_cast<int>(std::ceil(whole_cells + ends.less))});
    const double widths = cells - ends.less;
    const double less_low = ends.low.empty() ? 0 : ends.high.empty() ? ends.less : ends.less / 2;
    for (int k = 0; k < cells; ++k) {
      const auto at = static_cast<std::size_t>(k),
                 from_end = static_cast<std::size_t>(cells - 1 - k);
      double before = k - less_low;
      if (at < ends.low.size())
        before = ends.low[at];
      else if (from_end < ends.high.size())
        before = widths - ends.high[from_end];
      const double stop_m = low.at_m + before * length_m / widths;
      lines.push_back({.point = Eigen::Vector2d::Constant(stop_m), .direction = direction});
    }
  }
  return lines;
}

Eigen::AlignedBox2d bounds(const Polygon& polygon) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& p : polygon) box.extend(p);
  return box;
}

/// Cuts out of the faces what lies in the region and labels it. Faces beside it stay whole.
std::vector<Face> cut_out(Mesh& mesh, const std::vector<Face>& faces, const Region& region) {
  std::vector<Face> pieces;
  for (const Face face : faces) {
    const bool meets = mesh.label(face) != kCutAway &&
                       shared_area(outline_of(mesh, face), region.outline) >= kMinAreaM2;
    std::optional<Face> inside = face;
    for (std::size_t i = 0; meets && inside && i < region.outline.size(); ++i) {
      const Halves halves = cut(mesh, *inside, edge_line(region.outline, i));
      if (halves.right) pieces.push_back(*halves.right);
      inside = halves.left;
    }
    if (!inside) continue;
    if (meets) mesh.label(*inside) = region.label;
    pieces.push_back(*inside);
  }
  return pieces;
}

std::vector<Face> cut_out(Mesh& mesh, const std::vector<Face>& faces,
                          const std::vector<Region>& regions) {
  std::vector<Eigen::AlignedBox2d> extents;
  for (const Region& region : regions) extents.push_back(bounds(region.outline));
  std::vector<Face> pieces;
  for (const Face face : faces) {
    const Eigen::AlignedBox2d extent = bounds(outline_of(mesh, face));
    std::vector<Face> of_face{face};
    for (std::size_t i = 0; i < regions.size(); ++i) {
      if (extents[i].intersects(extent)) of_face = cut_out(mesh, of_face, regions[i]);
    }
    pieces.insert(pieces.end(), of_face.begin(), of_face.end());
  }
  return pieces;
}

/// Halves faces across their longest edge until none is longer than patch_m: slanting edges in a
/// square grid may be.
std::vector<Face> shorten_edges(Mesh& mesh, std::vector<Face> open, double patch_m) {
  std::vector<Face> pieces;
  std::ranges::reverse(open);
  while (!open.empty()) {
    const Face face = open.back();
    open.pop_back();
    const Polygon outline = without_collinear_corners(outline_of(mesh, face), kStraightM);
    double longest_m = patch_m + kSnapM;
    Halves halves;
    Line across;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Eigen::Vector2d edge = outline[(i + 1) % outline.size()] - outline[i];
      if (edge.norm() <= longest_m) continue;
      longest_m = edge.norm();
      across = {.point = outline[i] + edge / 2,
                .direction = Eigen::Vector2d(-edge.y(), edge.x()) / longest_m};
    }
    if (longest_m > patch_m + kSnapM) halves = cut(mesh, face, across);
    if (halves.left && halves.right) {
      open.insert(open.end(), {*halves.right, *halves.left});
    } else {
      pieces.push_back(face);
    }
  }
  return pieces;
}

}  // namespace

std::vector<Polygon> convex_pieces(const Polygon& outline) {
  Mesh mesh;
  std::vector<Polygon> pieces;
  for (const Face face : convex_faces(mesh, outline)) pieces.push_back(outline_of(mesh, face));
  return pieces;
}

std::vector<Piece> cut_surface(const Polygon& outline, const std::vector<Region>& regions,
                               const CellSize& size) {
  const auto lines = [&](Eigen::Index coordinate) {
    return grid_lines(grid_stops(outline, regions, coordinate), coordinate, size);
  };
  Mesh mesh;
  std::vector<Face> rows, faces;
  cut_by_lines(mesh, convex_faces(mesh, outline), lines(1), rows);
  const std::vector<Line> columns = lines(0);
  for (const Face row : rows) cut_by_lines(mesh, {row}, columns, faces);

  std::vector<Piece> pieces;
  for (const Face face : shorten_edges(mesh, cut_out(mesh, faces, regions), size.patch_m)) {
    const int label = mesh.label(face);
    if (label == kCutAway) continue;
    pieces.push_back({without_collinear_corners(outline_of(mesh, face), kStraightM), label});
  }
  return pieces;
}

}  // namespace scenes
