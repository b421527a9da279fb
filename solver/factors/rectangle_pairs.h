#pragma once
#include <array>
#include <cstddef>
#include <optional>

#include "solver/factors/facet.h"

namespace solver {

struct Span {
  double from = 0, to = 0;
};

enum class Planes { parallel, perpendicular };

/// Two rectangles with edges along common axes that face each other. In parallel planes x and xi
/// are the edges of the first and of the second along one axis, y and eta along the other. In
/// perpendicular ones x and xi are distances from the line where the planes meet (>= 0), y and eta
/// run along it. Touching edges are allowed.
struct RectanglePair {
  Planes planes;
  Span x, y, xi, eta;
  double gap_m = 0;  ///< between parallel planes, > 0
};

struct AxedRectangle {
  Eigen::Vector3d centre, normal, along;  ///< along: direction of the first edge, unit
  std::array<double, 2> half_edge_m;
};

/// Empty if the facet is not a rectangle.
[[nodiscard]] std::optional<AxedRectangle> rectangle_of(const Facet& facet);

/// Two rectangles as the closed forms see them, clipped to what faces each other; empty if their
/// edges do not lie along common axes.
/// @param i, j  part of each is in front of the other
[[nodiscard]] std::optional<RectanglePair> aligned(const AxedRectangle& i, const AxedRectangle& j);

/// A_1 F_12 in closed form, m^2. Its terms are as large as the squared distance of the farthest
/// corners; times kClosedFormRounding this bounds the error.
[[nodiscard]] double exchange_area(const RectanglePair& pair);

inline constexpr double kClosedFormRounding = 3e-16;

/// The same for as many pairs of one kind as a vector of doubles holds.
class RectangleBatch {
 public:
  static constexpr std::size_t kCapacity = 64;  ///< a multiple of every vector length
  using Values = std::array<double, kCapacity>;

  explicit RectangleBatch(Planes planes) : planes_(planes) {}

  [[nodiscard]] std::size_t size() const { return size_; }

  void add(const RectanglePair& pair);

  /// A_1 F_12 of the pairs in the order in which they were added, m^2; empties the batch.
  const Values& evaluate();

 private:
  Planes planes_;
  std::size_t size_ = 0;
  std::array<Values, 9> edges_{};  ///< x, y, xi, eta: from, to; gap
  Values exchange_area_m2_{};
};

}  // namespace solver
