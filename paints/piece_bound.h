#pragma once
#include <Eigen/Core>
#include <span>

namespace paints {

/// A lower bound of the distance from the origin to a piece of a curve (2 corners) or surface (3),
/// of which the corners are known and the middles of its edges as far as they lie from the middles
/// of their ends. It rests on one assumption: seen along any direction n, the piece does not come
/// nearer than its nearest corner by more than
///   kTowards max(0, -n . deviation) + kAnyway bulge,
/// the largest over the edges. Pieces of second order need 4/3 and 0; the rest is for what is
/// left of third order. Directions are those of Gilbert's iteration to the nearest point of the
/// flat piece [Gilbert1966].
/// @param bulge  at least the longest deviation
[[nodiscard]] double piece_bound(std::span<const Eigen::Vector3d> corners,
                                 std::span<const Eigen::Vector3d> deviations, double bulge);

inline constexpr double kTowards = 2, kAnyway = 0.5;

}  // namespace paints
