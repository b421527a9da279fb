#include "solver/sensors/refined_field.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Vector3d;
using Barycentric = std::array<double, 3>;

/// Where a triangle is put to the test: all cubics but one are seen.
constexpr std::array<Barycentric, 5> kTests{
    {{0, 0.75, 0.25}, {0, 0.25, 0.75}, {0.5, 0.25, 0.25}, {0.75, 0, 0.25}, {0.75, 0.25, 0}}};

/// Weights of corners and middles [a, b, c, bc, ca, ab].
std::array<double, 6> quadratic(const Barycentric& at) {
  const auto& [a, b, c] = at;
  return {a * (2 * a - 1), b * (2 * b - 1), c * (2 * c - 1), 4 * b * c, 4 * c * a, 4 * a * b};
}

}  // namespace

RefinedField::RefinedField(const std::vector<Facet>& facets, const Rules& rules) {
  plant(facets);
  std::vector<Open> open;
  for (std::size_t k = 0; k < cells_.size(); ++k) open.push_back({static_cast<int>(k), 0});
  while (!open.empty()) open = refine(open, rules);
}

int RefinedField::new_node(const Vector3d& point) {
  points_.push_back(point);
  samples_.emplace_back();
  return static_cast<int>(points_.size()) - 1;
}

int RefinedField::middle_of(int a, int b) {
  const auto low = static_cast<std::uint64_t>(std::min(a, b));
  const std::uint64_t key = low << 32U | static_cast<std::uint64_t>(std::max(a, b));
  const auto [entry, fresh] = middles_.try_emplace(key, -1);
  if (fresh) {
    entry->second =
        new_node((points_[static_cast<std::size_t>(a)] + points_[static_cast<std::size_t>(b)]) / 2);
  }
  return entry->second;
}

void RefinedField::plant(const std::vector<Facet>& facets) {
  for (std::size_t f = 0; f < facets.size(); ++f) {
    roots_.emplace_back();
    const std::vector<Vector3d>& v = facets[f].vertices;
    const int centre = new_node(facets[f].centre), first = centre + 1;
    for (const Vector3d& vertex : v) (void)new_node(vertex);
    for (std::size_t k = 0; k < v.size(); ++k) {
      const std::size_t after = (k + 1) % v.size();
      const int b = first + static_cast<int>(k), c = first + static_cast<int>(after);
      const Vector3d to_b = v[k] - facets[f].centre, to_c = v[after] - facets[f].centre;
      const Vector3d n = to_b.cross(to_c);
      roots_.back().push_back({.origin_m = facets[f].centre,
                               .b_per_m = to_c.cross(n) / n.squaredNorm(),
                               .c_per_m = n.cross(to_b) / n.squaredNorm(),
                               .cell = static_cast<int>(cells_.size())});
      cells_.push_back({.facet = f,
                        .corner = {centre, b, c},
                        .middle = {middle_of(b, c), middle_of(c, centre), middle_of(centre, b)}});
    }
  }
}

void RefinedField::halve(int cell) {
  const Cell parent = cells_[static_cast<std::size_t>(cell)];
  const auto& [a, b, c] = parent.corner;
  const int m = parent.middle[0], inner = middle_of(m, a);
  cells_[static_cast<std::size_t>(cell)].halves = static_cast<int>(cells_.size());
  cells_.push_back({.facet = parent.facet,
                    .corner = {m, a, b},
                    .middle = {parent.middle[2], middle_of(b, m), inner}});
  cells_.push_back({.facet = parent.facet,
                    .corner = {m, c, a},
                    .middle = {parent.middle[1], inner, middle_of(m, c)}});
}

void RefinedField::add_nodes(int cell, Nodes& nodes) const {
  const Cell& of = cells_[static_cast<std::size_t>(cell)];
  for (const int node : of.corner) nodes.emplace_back(node, of.facet);
  for (const int node : of.middle) nodes.emplace_back(node, of.facet);
}

/// In the order of kTests; of a cell that is halved.
std::array<int, 5> RefinedField::tests_of(int cell) {
  const Cell of = cells_[static_cast<std::size_t>(cell)];
  const Cell first = cells_[static_cast<std::size_t>(of.halves)],
             second = cells_[static_cast<std::size_t>(of.halves) + 1];
  return {first.middle[1], second.middle[2], first.middle[2], middle_of(of.corner[0], of.middle[1]),
          middle_of(of.corner[0], of.middle[2])};
}

void RefinedField::evaluate(Nodes nodes, const Rules& rules) {
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  tbb::parallel_for(std::size_t{0}, nodes.size(), [&](std::size_t k) {
    const auto [node, facet] = nodes[k];
    if (samples_[node].values.size() == 0) samples_[node] = rules.sample(facet, points_[node]);
  });
}

/// Halves the cells that may be; the halves of those whose quadratic does not hold are open next.
std::vector<RefinedField::Open> RefinedField::refine(const std::vector<Open>& open,
                                                     const Rules& rules) {
  const bool full = nodes() >= static_cast<std::size_t>(rules.most_nodes);
  std::vector<Attention> attention(open.size());
  tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t k) {
    const Cell& cell = cells_[static_cast<std::size_t>(open[k].cell)];
    Triangle triangle;
    for (std::size_t n = 0; n < 3; ++n) {
      triangle[n] = points_[static_cast<std::size_t>(cell.corner[n])];
    }
    attention[k] = rules.attention(cell.facet, triangle);
  });
  Nodes nodes;
  std::vector<std::array<int, 5>> tests(open.size());
  for (std::size_t k = 0; k < open.size(); ++k) {
    const auto& [cell, error] = open[k];
    if (attention[k] == Attention::none) continue;
    add_nodes(cell, nodes);
    if (attention[k] == Attention::coarse || full) {
      if (error > rules.tolerance) largest_left_ = std::max(largest_left_, error);
      continue;
    }
    halve(cell);
    const Cell& halved = cells_[static_cast<std::size_t>(cell)];
    add_nodes(halved.halves, nodes);
    add_nodes(halved.halves + 1, nodes);
    if (attention[k] == Attention::cut) continue;
    tests[k] = tests_of(cell);
    for (const int node : tests[k]) nodes.emplace_back(node, halved.facet);
  }
  evaluate(std::move(nodes), rules);
  std::vector<Open> next;
  for (std::size_t k = 0; k < open.size(); ++k) {
    const Cell& parent = cells_[static_cast<std::size_t>(open[k].cell)];
    if (parent.halves < 0) continue;
    const double error = attention[k] == Attention::cut ? 0 : misfit(parent, tests[k]);
    if (attention[k] != Attention::cut && error <= rules.tolerance) continue;
    next.insert(next.end(), {{parent.halves, error}, {parent.halves + 1, error}});
  }
  return next;
}

double RefinedField::misfit(const Cell& cell, const std::array<int, 5>& tests) const {
  const auto sample = [&](int node) -> const Sample& {
    return samples_[static_cast<std::size_t>(node)];
  };
  double largest = 0;
  for (std::size_t t = 0; t < tests.size(); ++t) {
    const Sample& truth = sample(tests[t]);
    const std::array<double, 6> weight = quadratic(kTests[t]);
    ArrayXd error = -truth.values;
    for (std::size_t n = 0; n < 3; ++n) {
      error += weight[n] * sample(cell.corner[n]).values;
      error += weight[n + 3] * sample(cell.middle[n]).values;
    }
    const double rms = std::sqrt(error.square().mean());
    if (rms > 0) largest = std::max(largest, truth.scale > 0 ? rms / truth.scale : 1.0);
  }
  return largest;
}

void RefinedField::add(std::size_t facet, const Vector3d& point, ArrayXd& sum) const {
  int k = -1;
  Barycentric at{};
  double deepest = -1e300;
  for (const Root& root : roots_[facet]) {
    const Vector3d r = point - root.origin_m;
    const double b = root.b_per_m.dot(r), c = root.c_per_m.dot(r);
    if (const double inside = std::min({1 - b - c, b, c}); inside > deepest) {
      deepest = inside;
      k = root.cell;
      at = {1 - b - c, b, c};
    }
  }
  while (cells_[static_cast<std::size_t>(k)].halves >= 0) {
    const auto [a, b, c] = at;
    const bool first = b >= c;
    at = first ? Barycentric{2 * c, a, b - c} : Barycentric{2 * b, c - b, a};
    k = cells_[static_cast<std::size_t>(k)].halves + (first ? 0 : 1);
  }
  const Cell& cell = cells_[static_cast<std::size_t>(k)];
  const std::array<double, 6> weight = quadratic(at);
  for (std::size_t n = 0; n < 3; ++n) {
    sum += weight[n] * samples_[static_cast<std::size_t>(cell.corner[n])].values +
           weight[n + 3] * samples_[static_cast<std::size_t>(cell.middle[n])].values;
  }
}

}  // namespace solver
