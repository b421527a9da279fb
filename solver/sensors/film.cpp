#include "solver/sensors/film.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace solver {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Outline = std::vector<Vector2d>;

constexpr double kNear_m = 1e-6;    ///< nothing in the air is as near to the eye
constexpr double kNothing = 1e-12;  ///< share of a pixel that is left out

/// The part of a polygon where sign * coordinate <= sign * limit.
void cut(const Outline& polygon, int axis, double limit, double sign, Outline& kept) {
  kept.clear();
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector2d &a = polygon[k], &b = polygon[k + 1 < polygon.size() ? k + 1 : 0];
    const double before = sign * (limit - a[axis]), after = sign * (limit - b[axis]);
    if (before >= 0) kept.push_back(a);
    if ((before > 0 && after < 0) || (before < 0 && after > 0)) {
      Vector2d between = a + before / (before - after) * (b - a);
      between[axis] = limit;
      kept.push_back(between);
    }
  }
}

/// Sets area and centroid by the outline.
void measure(Fragment& fragment) {
  const Outline& v = fragment.outline;
  double twice = 0;
  Vector2d moment = Vector2d::Zero();
  for (std::size_t k = 1; k + 1 < v.size(); ++k) {
    const Vector2d a = v[k] - v[0], b = v[k + 1] - v[0];
    const double cross = a.x() * b.y() - a.y() * b.x();
    twice += cross;
    moment += cross * (a + b) / 3;
  }
  fragment.area = std::abs(twice) / 2;
  if (twice != 0) fragment.middle = v[0] + moment / twice;
}

/// From where to where a line of the film lies in a convex outline.
struct Extent {
  double left = 1e300, right = -1e300;

  void add(double s) {
    left = std::min(left, s);
    right = std::max(right, s);
  }
};

Extent extent_at(const Outline& strip, double t) {
  Extent extent;
  for (const Vector2d& v : strip) {
    if (v.y() == t) extent.add(v.x());
  }
  return extent;
}

}  // namespace

std::vector<Plane> view_planes(const Camera& camera) {
  const double w = camera.width(), h = camera.height();
  const std::array<Vector3d, 4> corner{camera.direction({0, 0}), camera.direction({0, h}),
                                       camera.direction({w, h}), camera.direction({w, 0})};
  std::vector<Plane> planes{{camera.forward(), camera.forward().dot(camera.eye_m()) + kNear_m}};
  for (std::size_t k = 0; k < corner.size(); ++k) {
    Vector3d inwards = corner[k].cross(corner[(k + 1) % corner.size()]).normalized();
    if (inwards.dot(camera.forward()) < 0) inwards = -inwards;
    planes.push_back({inwards, inwards.dot(camera.eye_m())});
  }
  return planes;
}

std::vector<FilmPiece> film_pieces(const Camera& camera, const std::vector<Facet>& facets,
                                   const std::vector<Blocker>& blockers) {
  const std::vector<Plane> planes = view_planes(camera);
  const Vector2d film(camera.width(), camera.height());
  const Shadows hidden(blockers, from_point(camera.eye_m()));
  std::vector<FilmPiece> pieces;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    if (facets[f].plane().height_m(camera.eye_m()) <= 0) continue;
    for (std::vector<Vector3d>& part : hidden.lit_parts(facets[f].vertices)) {
      for (const Plane& plane : planes) {
        if (!part.empty()) part = clip(part, plane);
      }
      if (part.empty()) continue;
      FilmPiece piece{.facet = f, .outline = {}, .top = 1e300, .bottom = -1e300};
      for (const Vector3d& v : part) {
        piece.outline.push_back(camera.film_of(v).cwiseMax(0).cwiseMin(film));  // rounding
        piece.top = std::min(piece.top, piece.outline.back().y());
        piece.bottom = std::max(piece.bottom, piece.outline.back().y());
      }
      pieces.push_back(std::move(piece));
    }
  }
  return pieces;
}

void for_each_fragment(const FilmPiece& piece, int row,
                       const std::function<void(const Fragment&)>& take) {
  const double top = row, bottom = row + 1;
  if (piece.bottom <= top || piece.top >= bottom) return;
  Outline strip, scratch;
  cut(piece.outline, 1, bottom, 1, scratch);
  cut(scratch, 1, top, -1, strip);
  if (strip.size() < 3) return;
  Extent all;
  for (const Vector2d& v : strip) all.add(v.x());
  const Extent above = extent_at(strip, top), below = extent_at(strip, bottom);
  // The left edge of a convex outline bends outwards: between the two lines nothing is missing.
  const double full_from = std::max(above.left, below.left);
  const double full_to = std::min(above.right, below.right);
  Fragment fragment;
  const int first = static_cast<int>(std::floor(all.left));
  for (int column = first; column < all.right; ++column) {
    fragment.column = column;
    if (column >= full_from && column + 1 <= full_to) {
      fragment.area = 1;
      fragment.middle = {column + 0.5, row + 0.5};
      fragment.outline = {{column, top}, {column, bottom}, {column + 1, bottom}, {column + 1, top}};
    } else {
      cut(strip, 0, column + 1, 1, scratch);
      cut(scratch, 0, column, -1, fragment.outline);
      if (fragment.outline.size() < 3) continue;
      measure(fragment);
      if (fragment.area < kNothing) continue;
    }
    take(fragment);
  }
}

}  // namespace solver
