#include "scenes/shapes/enclosure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scenes/geometry/fits.h"
#include "scenes/shapes/bodies.h"
#include "scenes/shapes/plates.h"

namespace scenes {
namespace {

using Eigen::Vector3d;

constexpr double kFar_m = std::numeric_limits<double>::infinity();

Eigen::AlignedBox3d bounds(const ConvexPart& part) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& c : part.corners) box.extend(c);
  return box;
}

Eigen::AlignedBox3d bounds(const Body& body) {
  Eigen::AlignedBox3d box;
  for (const ConvexPart& part : body.parts) box.extend(bounds(part));
  return box;
}

const Vector3d& corner(const ConvexPart& part, int index) {
  return part.corners[static_cast<std::size_t>(index)];
}

/// Directions that differ, whichever way they point.
void add_direction(std::vector<Vector3d>& directions, const Vector3d& direction) {
  const double length = direction.norm();
  if (!(length > 1e-9)) return;
  const Vector3d unit = direction / length;
  const bool known = std::ranges::any_of(
      directions, [&](const Vector3d& d) { return d.cross(unit).norm() < 1e-12; });
  if (!known) directions.push_back(unit);
}

struct Directions {
  std::vector<Vector3d> normals, edges;
};

Directions directions_of(const ConvexPart& part) {
  Directions d;
  for (const std::vector<int>& face : part.faces) {
    const Vector3d &a = corner(part, face[0]), &b = corner(part, face[1]);
    add_direction(d.normals, (b - a).cross(corner(part, face[2]) - a).normalized());
    for (std::size_t k = 0; k < face.size(); ++k) {
      add_direction(
          d.edges,
          (corner(part, face[(k + 1) % face.size()]) - corner(part, face[k])).normalized());
    }
  }
  return d;
}

/// No plane with this normal has one on either side. Plates that lie in one such plane are not
/// parted by it.
bool meet_along(const Vector3d& axis, const ConvexPart& a, const ConvexPart& b, bool plates_part,
                double touch_m) {
  const auto range = [&](const ConvexPart& part) {
    std::pair<double, double> r{kFar_m, -kFar_m};
    for (const Vector3d& c : part.corners) {
      r.first = std::min(r.first, axis.dot(c));
      r.second = std::max(r.second, axis.dot(c));
    }
    return r;
  };
  const auto [a_low, a_high] = range(a);
  const auto [b_low, b_high] = range(b);
  const bool both_flat = a_high - a_low <= touch_m && b_high - b_low <= touch_m;
  const bool in_one_plane = both_flat && std::abs(a_low - b_low) <= touch_m;
  if (in_one_plane && !plates_part) return true;
  return a_low < b_high - touch_m && b_low < a_high - touch_m;
}

/// By the theorem of the separating axis. @param plates_part  plates in one plane do not overlap
bool overlap(const ConvexPart& a, const ConvexPart& b, bool plates_part,
             double touch_m = kTouch_m) {
  const Eigen::AlignedBox3d box_a = bounds(a), box_b = bounds(b);
  if (!box_a.intersects(box_b)) return false;
  const Directions da = directions_of(a), db = directions_of(b);
  std::vector<Vector3d> axes = da.normals;
  axes.insert(axes.end(), db.normals.begin(), db.normals.end());
  const auto add_crossed = [&](const std::vector<Vector3d>& some,
                               const std::vector<Vector3d>& others) {
    for (const Vector3d& s : some) {
      for (const Vector3d& o : others) {
        if (s.cross(o).norm() > 1e-9) axes.push_back(s.cross(o).normalized());
      }
    }
  };
  add_crossed(da.edges, db.edges);
  add_crossed(da.normals, da.edges);  // the edges of plates
  add_crossed(db.normals, db.edges);
  return std::ranges::all_of(
      axes, [&](const Vector3d& axis) { return meet_along(axis, a, b, plates_part, touch_m); });
}

/// Outside, a lower bound; negative within.
double distance_to_parts_m(const Body& body, const Vector3d& point) {
  double nearest_m = kFar_m;
  for (const ConvexPart& part : body.parts) {
    double outside_m = -kFar_m;
    for (const std::vector<int>& face : part.faces) {
      const Vector3d &a = corner(part, face[0]), &b = corner(part, face[1]);
      const Vector3d normal = (b - a).cross(corner(part, face[2]) - a).normalized();
      outside_m = std::max(outside_m, normal.dot(point - a));
    }
    nearest_m = std::min(nearest_m, outside_m);
  }
  return nearest_m;
}

/// Fronts look outwards, so a closed body goes once around what is within, from behind.
double distance_to_faces_m(const Body& body, const Vector3d& point) {
  double nearest_m = kFar_m, turns = 0;
  for (const Outline& outline : body.faces) {
    const FlatFace face(outline);
    nearest_m = std::min(nearest_m, face.distance_m(point));
    turns += face.turns_around(point);
  }
  return turns < -0.5 ? -nearest_m : nearest_m;
}

/// Both sides of a wall without thickness.
bool back_to_back(const ShellFace& a, const ShellFace& b) {
  const PlaneCoordinates plane(a.outline);
  return plane.normal().dot(PlaneCoordinates(b.outline).normal()) < 0 &&
         std::ranges::all_of(b.outline,
                             [&](const Vector3d& p) { return std::abs(plane.height_m(p)) < 2e-6; });
}

double distance_to_edge_m(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d edge = b - a;
  const double t = std::clamp((p - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
  return (p - a - t * edge).norm();
}

/// Solid angle of a triangle [VanOosterom1983], sr.
double solid_angle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return -2 * std::atan2(a.dot(b.cross(c)),
                         la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace

FlatFace::FlatFace(const Outline& outline, const std::vector<Outline>& holes)
    : rings_{outline}, plane_(outline) {
  rings_.insert(rings_.end(), holes.begin(), holes.end());
  for (const Outline& ring : rings_) flat_.push_back(plane_.flatten(ring));
}

double FlatFace::distance_m(const Vector3d& point) const {
  const Eigen::Vector2d foot = plane_.flatten(point);
  bool inside = is_inside(flat_.front(), foot);
  for (std::size_t k = 1; k < flat_.size(); ++k) inside = inside && !is_inside(flat_[k], foot);
  if (inside) return std::abs(plane_.height_m(point));
  double nearest_m = kFar_m;
  for (const Outline& ring : rings_) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      nearest_m =
          std::min(nearest_m, distance_to_edge_m(point, ring[k], ring[(k + 1) % ring.size()]));
    }
  }
  return nearest_m;
}

double FlatFace::turns_around(const Vector3d& point) const {
  double sum = 0;
  for (const Outline& ring : rings_) {
    const double sign = &ring == &rings_.front() ? 1 : -1;
    for (std::size_t k = 2; k < ring.size(); ++k) {
      sum += sign * solid_angle(ring[0] - point, ring[k - 1] - point, ring[k] - point);
    }
  }
  return sum / (4 * std::numbers::pi);
}

Enclosure::Enclosure(const std::vector<ShellFace>& shell) {
  for (const ShellFace& face : shell) {
    faces_.emplace_back(face.outline, face.holes);
    std::vector<ConvexPart>& plates = plates_.emplace_back();
    for (const Outline& part : convex_parts(face.outline, face.holes))
      plates.push_back(plate(part));
  }
}

double Enclosure::clearance_m(const Vector3d& point) const {
  double nearest_m = kFar_m, turns = 0;
  for (const FlatFace& face : faces_) {
    nearest_m = std::min(nearest_m, face.distance_m(point));
    turns += face.turns_around(point);
  }
  return turns > 0.5 ? nearest_m : -nearest_m;
}

int Enclosure::reached_through(const Body& body) const {
  for (std::size_t f = 0; f < plates_.size(); ++f) {
    for (const ConvexPart& plate : plates_[f]) {
      if (std::ranges::any_of(body.parts,
                              [&](const ConvexPart& part) { return overlap(part, plate, true); })) {
        return static_cast<int>(f);
      }
    }
  }
  return -1;
}

std::vector<std::pair<std::size_t, std::size_t>> crossing_faces(const std::vector<ShellFace>& shell,
                                                                bool thin_walls) {
  constexpr double kTouching_m = 4e-6;  // corners may lie 1e-6 m off their planes
  std::vector<std::vector<ConvexPart>> plates(shell.size());
  std::vector<Eigen::AlignedBox3d> extents(shell.size());
  for (std::size_t f = 0; f < shell.size(); ++f) {
    for (const Vector3d& p : shell[f].outline) extents[f].extend(p);
    for (const Outline& part : convex_parts(shell[f].outline, shell[f].holes)) {
      plates[f].push_back(plate(part));
    }
  }
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t f = 0; f < shell.size(); ++f) {
    for (std::size_t g = f + 1; g < shell.size(); ++g) {
      if (!extents[f].intersects(extents[g])) continue;
      if (thin_walls && back_to_back(shell[f], shell[g])) continue;
      const bool cross = std::ranges::any_of(plates[f], [&](const ConvexPart& a) {
        return std::ranges::any_of(
            plates[g], [&](const ConvexPart& b) { return overlap(a, b, false, kTouching_m); });
      });
      if (cross) pairs.emplace_back(f, g);
    }
  }
  return pairs;
}

double distance_m(const Body& body, const Vector3d& point) {
  const bool solid =
      std::ranges::all_of(body.parts, [](const ConvexPart& part) { return part.faces.size() > 2; });
  return solid ? distance_to_parts_m(body, point) : distance_to_faces_m(body, point);
}

Vector3d middle_of(const ConvexPart& part) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& c : part.corners) sum += c;
  return sum / static_cast<double>(part.corners.size());
}

bool overlap(const Body& a, const Body& b) {
  if (!bounds(a).intersects(bounds(b))) return false;
  const auto within = [](const Body& some, const Body& other) {  // a part of it, and all of that
    return std::ranges::any_of(some.parts, [&](const ConvexPart& part) {
      return distance_m(other, middle_of(part)) < -kTouch_m;
    });
  };
  if (within(a, b) || within(b, a)) return true;
  for (const ConvexPart& part : a.parts) {
    for (const ConvexPart& other : b.parts) {
      if (overlap(part, other, false)) return true;
    }
  }
  return false;
}

}  // namespace scenes
