#pragma once
#include <Eigen/Core>
#include <functional>
#include <vector>

#include "solver/factors/facet.h"
#include "solver/obstacles/blocker.h"
#include "solver/sensors/camera.h"

namespace solver {

/// A convex piece of a facet as it shows on the film.
struct FilmPiece {
  std::size_t facet = 0;
  std::vector<Eigen::Vector2d> outline;  ///< in pixels, within the film
  double top = 0, bottom = 0;            ///< its least and largest row coordinate
};

/// The sides of what the camera has in view, which is in front of all of them.
[[nodiscard]] std::vector<Plane> view_planes(const Camera& camera);

/// What the camera sees, exactly: no rays. The pieces do not overlap, and fill the film if the
/// facets close the room.
[[nodiscard]] std::vector<FilmPiece> film_pieces(const Camera& camera,
                                                 const std::vector<Facet>& facets,
                                                 const std::vector<Blocker>& blockers);

/// The part of a piece that falls on one pixel.
struct Fragment {
  int column = 0;
  double area = 0;         ///< of the pixel's, up to 1
  Eigen::Vector2d middle;  ///< its centroid
  std::vector<Eigen::Vector2d> outline;
};

/// Calls `take` for each pixel of a row that a piece falls on, from left to right.
void for_each_fragment(const FilmPiece& piece, int row,
                       const std::function<void(const Fragment&)>& take);

}  // namespace solver
