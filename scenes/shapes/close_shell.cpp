#include "scenes/shapes/close_shell.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "scenes/geometry/corner_weld.h"
#include "scenes/shapes/enclosure.h"
#include "scenes/shapes/plates.h"
#include "scenes/shapes/shell.h"

namespace scenes {
namespace {

using Eigen::Vector3d;

std::string words(const Vector3d& p) {
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", p.x(), p.y(), p.z());
}

/// A piece of an edge between two corners, as a face walks it.
struct Walk {
  std::size_t face = 0;
  bool forwards = true;  ///< from the lower number to the higher
};

constexpr double kNothing = 1e-6;  ///< fullness of what encloses nothing

using Edge = std::pair<int, int>;  ///< lower number first

class Shell {
 public:
  explicit Shell(std::vector<ShellFace>& faces) : faces_(faces) {
    for (ShellFace& face : faces_) {
      weld(face.outline);
      const Vector3d front = vector_area_m2(face.outline);
      for (Outline& hole : face.holes) {
        weld(hole);
        if (vector_area_m2(hole).dot(front) < 0) std::ranges::reverse(hole);
      }
    }
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      walk(faces_[f].outline, f, true);
      for (const Outline& hole : faces_[f].holes) walk(hole, f, false);
    }
    turned_.resize(faces_.size(), false);
    neighbours_.resize(faces_.size());
    loose_neighbours_.resize(faces_.size());
    for (const auto& [edge, walks] : edges_) connect(walks);
  }

  /// Turns faces so that neighbours walk their common edge in opposite directions, and what hangs
  /// together so that it encloses what is in front. What encloses nothing, the two sides of a thin
  /// wall, stays as it was given to the faces that it meets. @return how many shells there are
  int orient() {
    std::vector<std::vector<std::size_t>> thin;
    std::vector<bool> known(faces_.size(), false);
    for (std::size_t first = 0; first < faces_.size(); ++first) {
      if (known[first]) continue;
      const std::vector<std::size_t> piece = spread_from(first, known);
      const double fullness = fullness_of(piece);
      if (fullness < 0) std::ranges::for_each(piece, [this](std::size_t f) { turn(f); });
      if (std::abs(fullness) < kNothing) thin.push_back(piece);
    }
    for (const std::vector<std::size_t>& piece : thin) turn_like_neighbours(piece);
    return count_shells();
  }

  /// Faces that do not look at the air: not once around what is before them.
  void add_faults_of_fronts(std::vector<ShellFault>& faults) const {
    std::vector<FlatFace> flat;
    for (const ShellFace& face : faces_) flat.emplace_back(face.outline, face.holes);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const Outline part = convex_parts(faces_[f].outline, faces_[f].holes).front();
      Vector3d before = Vector3d::Zero();
      for (const Vector3d& p : part) before += p / static_cast<double>(part.size());
      before += 10 * kWeld_m * flat[f].plane().normal();
      double turns = 0;
      for (const FlatFace& face : flat) turns += face.turns_around(before);
      if (std::abs(turns - 1) < 0.01) continue;
      faults.push_back({.face = f,
                        .problem = "its front does not look at the air that the others enclose",
                        .remedy = "give all faces from the same side, or leave it out"});
    }
  }

  /// Edges that are not walked as often one way as the other: thin walls have four faces at one.
  void add_faults_of_edges(std::vector<ShellFault>& faults) const {
    for (const auto& [edge, walks] : edges_) {
      const auto forwards = std::ranges::count_if(
          walks, [this](const Walk& walk) { return walk.forwards != turned_[walk.face]; });
      if (2 * forwards == static_cast<std::ptrdiff_t>(walks.size())) continue;
      const std::string where = fmt::format("from {} to {}", words(corners_.at(edge.first)),
                                            words(corners_.at(edge.second)));
      faults.push_back(
          walks.size() == 1
              ? ShellFault{.face = walks[0].face,
                           .problem = "its edge " + where + " meets no other face",
                           .remedy = "close the room there; all faces together enclose the air"}
              : ShellFault{.face = walks[0].face,
                           .problem = fmt::format("its edge {} is one of {} faces, which close "
                                                  "nothing together",
                                                  where, walks.size()),
                           .remedy = "leave only those that the air lies between"});
    }
  }

 private:
  /// The faces next to each face, and whether they walk the common edge the same way.
  using Neighbours = std::vector<std::vector<std::pair<std::size_t, bool>>>;

  /// All faces that are joined to one by edges of two faces, turned as it is.
  std::vector<std::size_t> spread_from(std::size_t first, std::vector<bool>& known) {
    known[first] = true;
    std::vector<std::size_t> piece{first};
    for (std::size_t k = 0; k < piece.size(); ++k) {
      for (const auto& [other, same] : neighbours_[piece[k]]) {
        if (known[other]) continue;
        known[other] = true;
        if (same != turned_[piece[k]]) turn(other);
        piece.push_back(other);
      }
    }
    return piece;
  }

  /// Volume before the faces, seen from their middle, over area times length; a third of the sine
  /// of their mean angle.
  [[nodiscard]] double fullness_of(const std::vector<std::size_t>& piece) const {
    Eigen::AlignedBox3d extent;
    for (const std::size_t f : piece) {
      for (const Vector3d& p : faces_[f].outline) extent.extend(p);
    }
    double volume = 0, area_m2 = 0;
    for (const std::size_t f : piece) {
      const auto add = [&](const Outline& ring, double sign) {
        const Vector3d area = sign * vector_area_m2(ring);
        volume -= (ring.front() - extent.center()).dot(area) / 3;
        area_m2 += area.norm();
      };
      add(faces_[f].outline, 1);
      for (const Outline& hole : faces_[f].holes) add(hole, -1);
    }
    return volume / (area_m2 * extent.diagonal().norm());
  }

  void turn_like_neighbours(const std::vector<std::size_t>& piece) {
    for (const std::size_t f : piece) {
      for (const auto& [other, same] : loose_neighbours_[f]) {
        if (std::ranges::find(piece, other) != piece.end()) continue;
        if (turned_[f] != turned_[other]) std::ranges::for_each(piece, [this](auto p) { turn(p); });
        return;
      }
    }
  }

  [[nodiscard]] int count_shells() const {
    std::vector<bool> known(faces_.size(), false);
    int shells = 0;
    for (std::size_t first = 0; first < faces_.size(); ++first) {
      if (known[first]) continue;
      ++shells;
      known[first] = true;
      std::vector<std::size_t> open{first};
      while (!open.empty()) {
        const std::size_t f = open.back();
        open.pop_back();
        for (const Neighbours* neighbours : {&neighbours_, &loose_neighbours_}) {
          for (const auto& [other, same] : (*neighbours)[f]) {
            if (!known[other]) open.push_back(other);
            known[other] = true;
          }
        }
      }
    }
    return shells;
  }

  void connect(const std::vector<Walk>& walks) {
    for (std::size_t k = 1; k < walks.size(); ++k) {
      const Walk &a = walks[k - 1], &b = walks[k];
      if (a.face == b.face) continue;
      const bool pair = walks.size() == 2, same = pair && a.forwards == b.forwards;
      Neighbours& neighbours = pair ? neighbours_ : loose_neighbours_;
      neighbours[a.face].emplace_back(b.face, same);
      neighbours[b.face].emplace_back(a.face, same);
    }
  }

  void weld(Outline& ring) {
    for (Vector3d& p : ring) p = corners_.at(corners_.number(p));
  }

  /// Adds the edges of a ring, parted where other corners lie on them.
  void walk(const Outline& ring, std::size_t face, bool outer) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vector3d &a = ring[k], &b = ring[(k + 1) % ring.size()];
      const std::vector<std::pair<double, int>> stops = on_edge(a, b);
      for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
        const int from = stops[i].second, to = stops[i + 1].second;
        edges_[std::minmax(from, to)].push_back({face, (from < to) == outer});
      }
    }
  }

  [[nodiscard]] std::vector<std::pair<double, int>> on_edge(const Vector3d& a, const Vector3d& b) {
    const double length_m = (b - a).norm();
    const Vector3d along = (b - a) / length_m;
    std::vector<std::pair<double, int>> stops;
    for (int i = 0; i < corners_.size(); ++i) {
      const Vector3d r = corners_.at(i) - a;
      const double t = along.dot(r);
      const bool inside = t > kWeld_m && t < length_m - kWeld_m;
      if (inside && (r - t * along).norm() <= kWeld_m) stops.emplace_back(t, i);
    }
    stops.emplace_back(0.0, corners_.number(a));
    stops.emplace_back(length_m, corners_.number(b));
    std::ranges::sort(stops);
    return stops;
  }

  void turn(std::size_t f) {
    turned_[f] = !turned_[f];
    std::ranges::reverse(faces_[f].outline);
    for (Outline& hole : faces_[f].holes) std::ranges::reverse(hole);
  }

  std::vector<ShellFace>& faces_;
  CornerWeld corners_{kWeld_m};
  std::map<Edge, std::vector<Walk>> edges_;
  Neighbours neighbours_, loose_neighbours_;  ///< at edges of two faces, and of more
  std::vector<bool> turned_;                  ///< since the edges were walked
};

}  // namespace

std::vector<ShellFault> close_shell(std::vector<ShellFace>& faces, bool several) {
  std::size_t corners = 0;
  for (const ShellFace& face : faces) {
    corners += face.outline.size();
    for (const Outline& hole : face.holes) corners += hole.size();
  }
  if (corners > kMostShellCorners) {
    return {{.face = 0,
             .problem = fmt::format("the faces have {} corners", corners),
             .remedy = fmt::format("simplify them to {} at most", kMostShellCorners)}};
  }
  std::vector<ShellFault> faults;
  Shell shell(faces);
  const int shells = shell.orient();
  for (ShellFace& face : faces) {
    face.frame = frame_of_plane(face.outline.front(), PlaneCoordinates(face.outline).normal());
  }
  shell.add_faults_of_edges(faults);
  if (faults.empty() && shells > 1 && !several) {
    faults.push_back({.face = 0,
                      .problem = fmt::format("the faces make {} shells", shells),
                      .remedy = "give the one that the air is in, and the rest as furniture"});
  }
  if (faults.empty()) shell.add_faults_of_fronts(faults);
  for (const auto& [face, other] : crossing_faces(faces)) {
    faults.push_back({.face = other,
                      .problem = fmt::format("it crosses face {} or lies on it", face + 1),
                      .remedy = "move one of them; faces meet at edges only"});
  }
  return faults;
}

}  // namespace scenes
