#include "scenes/shapes/close_shell.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "scenes/shapes/enclosure.h"
#include "scenes/shapes/plates.h"
#include "scenes/shapes/shell.h"

namespace scenes {
namespace {

using Eigen::Vector3d;

std::string words(const Vector3d& p) {
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", p.x(), p.y(), p.z());
}

/// Numbers places; those within kWeld_m get one number.
class Corners {
 public:
  int number(const Vector3d& p) {
    const std::array<long, 3> cell = cell_of(p);
    for (long dx = -1; dx <= 1; ++dx) {
      for (long dy = -1; dy <= 1; ++dy) {
        for (long dz = -1; dz <= 1; ++dz) {
          const auto found = cells_.find({cell[0] + dx, cell[1] + dy, cell[2] + dz});
          if (found == cells_.end()) continue;
          for (const int i : found->second) {
            if ((at(i) - p).norm() <= kWeld_m) return i;
          }
        }
      }
    }
    points_.push_back(p);
    cells_[cell].push_back(static_cast<int>(points_.size()) - 1);
    return static_cast<int>(points_.size()) - 1;
  }

  [[nodiscard]] const Vector3d& at(int i) const { return points_[static_cast<std::size_t>(i)]; }

  [[nodiscard]] int size() const { return static_cast<int>(points_.size()); }

 private:
  static std::array<long, 3> cell_of(const Vector3d& p) {
    const auto index = [](double x) { return std::lround(x / (4 * kWeld_m)); };
    return {index(p.x()), index(p.y()), index(p.z())};
  }

  std::vector<Vector3d> points_;
  std::map<std::array<long, 3>, std::vector<int>> cells_;
};

/// A piece of an edge between two corners, as a face walks it.
struct Walk {
  std::size_t face = 0;
  bool forwards = true;  ///< from the lower number to the higher
};

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

  /// Turns faces so that neighbours walk their common edge in opposite directions, and each shell
  /// so that it encloses what is in front. Where thin walls meet others, four faces at an edge,
  /// they stay as they were given to each other. @return how many shells there are
  int orient() {
    std::vector<bool> known(faces_.size(), false);
    int shells = 0;
    for (std::size_t first = 0; first < faces_.size(); ++first) {
      if (known[first]) continue;
      ++shells;
      known[first] = true;
      std::vector<std::size_t> shell{first};
      const auto spread = [&](std::size_t from, const Neighbours& neighbours) {
        bool grown = false;
        for (const auto& [other, same] : neighbours[from]) {
          if (known[other]) continue;
          known[other] = true;
          grown = true;
          if (same != turned_[from]) turn(other);
          shell.push_back(other);
        }
        return grown;
      };
      for (std::size_t k = 0, loose = 0; loose < shell.size();) {
        while (k < shell.size()) spread(shell[k++], neighbours_);
        while (loose < shell.size() && !spread(shell[loose++], loose_neighbours_)) {
        }
      }
      double volume = 0;
      for (const std::size_t f : shell) volume += cone_m3(faces_[f]);
      if (volume < 0) std::ranges::for_each(shell, [this](std::size_t f) { turn(f); });
    }
    return shells;
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

  /// Three times the volume between a face and the origin, positive in front of it.
  static double cone_m3(const ShellFace& face) {
    double sum = -face.outline.front().dot(vector_area_m2(face.outline));
    for (const Outline& hole : face.holes) sum += hole.front().dot(vector_area_m2(hole));
    return sum;
  }

  std::vector<ShellFace>& faces_;
  Corners corners_;
  std::map<Edge, std::vector<Walk>> edges_;
  Neighbours neighbours_, loose_neighbours_;  ///< at edges of two faces, and of more
  std::vector<bool> turned_;                  ///< since the edges were walked
};

}  // namespace

std::vector<ShellFault> close_shell(std::vector<ShellFace>& faces) {
  std::vector<ShellFault> faults;
  Shell shell(faces);
  const int shells = shell.orient();
  for (ShellFace& face : faces) {
    face.frame = frame_of_plane(face.outline.front(), PlaneCoordinates(face.outline).normal());
  }
  shell.add_faults_of_edges(faults);
  if (faults.empty() && shells > 1) {
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
