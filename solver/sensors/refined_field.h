#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include "solver/factors/facet.h"

namespace solver {

/// What a field does with a triangle.
enum class Attention {
  none,    ///< nobody asks for it
  coarse,  ///< it is small enough
  fine,    ///< refined where values bend
  cut      ///< too large to be judged: refined in any case
};

/// Values on convex facets, costly at a point and smooth in most places: known at the nodes of
/// triangles, which are halved where the values bend, and quadratic on each triangle.
///
/// Each facet is a fan of triangles around its centre. What is halved is the edge opposite to the
/// newest corner (newest vertex bisection), which keeps triangles from growing thin and a symmetric
/// facet symmetric. A triangle has six nodes, its corners and the middles of its edges. Its
/// quadratic is put to the test at the three nodes that its halves have more, and half-way to the
/// middles of the two other edges. If it holds there, the halves, with about an eighth of its
/// error, stay as they are.
class RefinedField {
 public:
  using Triangle = std::array<Eigen::Vector3d, 3>;

  struct Sample {
    Eigen::ArrayXd values;
    double scale = 0;  ///< that errors of the values are relative to
  };

  struct Rules {
    /// At a point of a facet. Called by many threads.
    std::function<Sample(std::size_t facet, const Eigen::Vector3d& point)> sample;
    /// Of a triangle of a facet, before any of its values is known.
    std::function<Attention(std::size_t facet, const Triangle& triangle)> attention;
    /// RMS over the values of a point, relative to its scale; an estimate, not a bound.
    double tolerance = 0.01;
    int most_nodes = 1000000;  ///< beyond which nothing is refined
  };

  RefinedField(const std::vector<Facet>& facets, const Rules& rules);

  /// Adds the values at a point of a facet, in a triangle that had attention.
  void add(std::size_t facet, const Eigen::Vector3d& point, Eigen::ArrayXd& sum) const;

  [[nodiscard]] std::size_t nodes() const { return samples_.size(); }

  /// The largest error of a triangle that was too small, or came too late, to be refined further.
  [[nodiscard]] double largest_left() const { return largest_left_; }

 private:
  /// Corners a, b, c, with b-c to be halved; `middle` are the nodes of b-c, c-a and a-b.
  struct Cell {
    std::size_t facet = 0;
    std::array<int, 3> corner{}, middle{};
    int halves = -1;  ///< the first of two cells
  };

  /// A triangle of a fan, with the barycentric coordinates of b and c.
  struct Root {
    Eigen::Vector3d origin_m, b_per_m, c_per_m;
    int cell = 0;
  };

  /// A cell to be looked at, and how far its parent missed the truth.
  struct Open {
    int cell = 0;
    double error = 0;
  };

  [[nodiscard]] int new_node(const Eigen::Vector3d& point);
  [[nodiscard]] int middle_of(int a, int b);
  void plant(const std::vector<Facet>& facets);
  void halve(int cell);
  /// The nodes of a cell, and that it is put to the test at.
  using Nodes = std::vector<std::pair<std::size_t, std::size_t>>;  ///< node, facet
  void add_nodes(int cell, Nodes& nodes) const;
  [[nodiscard]] std::array<int, 5> tests_of(int cell);
  void evaluate(Nodes nodes, const Rules& rules);
  [[nodiscard]] std::vector<Open> refine(const std::vector<Open>& open, const Rules& rules);
  [[nodiscard]] double misfit(const Cell& cell, const std::array<int, 5>& tests) const;

  std::vector<Cell> cells_;
  std::vector<std::vector<Root>> roots_;  ///< of each facet
  std::vector<Eigen::Vector3d> points_;
  std::vector<Sample> samples_;  ///< of each node; without values: not asked for
  std::unordered_map<std::uint64_t, int> middles_;
  double largest_left_ = 0;
};

}  // namespace solver
