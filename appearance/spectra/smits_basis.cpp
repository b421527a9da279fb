#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <stdexcept>

#include "appearance/spectra/rgb_to_spectrum.h"

namespace spectra {
namespace {

using Eigen::ArrayXd, Eigen::ArrayXi, Eigen::MatrixXd, Eigen::MatrixX3d, Eigen::Vector3d,
    Eigen::VectorXd;

/// Second differences: x' S x is the sum of squared differences of neighbours.
MatrixXd squared_slope_matrix(Eigen::Index n) {
  MatrixXd s = MatrixXd::Zero(n, n);
  s.diagonal().setConstant(2);
  s(0, 0) = s(n - 1, n - 1) = 1;
  s.diagonal(1).setConstant(-1);
  s.diagonal(-1).setConstant(-1);
  return s;
}

/// Minimise x' S x / 2 subject to weights' x = colour and 0 <= x <= 1, by the primal-dual active
/// set method: fix what is at a bound, solve the linear system of the rest, look again.
ArrayXd smoothest_within_bounds(const MatrixX3d& weights, const Vector3d& colour) {
  const Eigen::Index n = weights.rows();
  const MatrixXd slope = squared_slope_matrix(n);
  ArrayXi bound = ArrayXi::Zero(n);  // -1: held at 0; 1: held at 1; 0: free
  for (int round = 0; round < 100; ++round) {
    // Unknowns x, the multipliers of the colour, and where x is held those of the bounds.
    MatrixXd system = MatrixXd::Zero(n + 3, n + 3);
    VectorXd right = VectorXd::Zero(n + 3);
    system.topLeftCorner(n, n) = slope;
    system.topRightCorner(n, 3) = -weights;
    system.bottomLeftCorner(3, n) = weights.transpose();
    right.tail<3>() = colour;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (bound[i] == 0) continue;
      system.row(i).setZero();
      system(i, i) = 1;
      right[i] = bound[i] > 0;
    }
    const Eigen::FullPivLU<MatrixXd> lu(system);
    if (!lu.isInvertible()) break;
    const VectorXd solution = lu.solve(right);
    const ArrayXd x = solution.head(n);
    const ArrayXd push = slope * x.matrix() - weights * solution.tail<3>();
    ArrayXi next(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const bool low = bound[i] < 0 ? push[i] > 0 : x[i] < 0;
      const bool high = bound[i] > 0 ? push[i] < 0 : x[i] > 1;
      next[i] = static_cast<int>(high) - static_cast<int>(low);
    }
    if ((next == bound).all()) return x;
    bound = next;
  }
  throw std::invalid_argument(fmt::format("no reflectance of colour ({}, {}, {}) was found",
                                          colour[0], colour[1], colour[2]));
}

}  // namespace

SmitsBasis smits_basis(const RgbSpace& space, const Grid& grid) {
  MatrixX3d weights(grid.count, 3);
  for (int k = 0; k < grid.count; ++k) {
    Spectrum band = constant(grid, 0);
    band.values[k] = 1;
    weights.row(k) = rgb_of_reflectance(space, band).transpose();
  }
  SmitsBasis basis;
  for (int c = 0; c < 3; ++c) {
    basis[static_cast<std::size_t>(c)] = {
        .grid = grid, .values = smoothest_within_bounds(weights, Vector3d::Unit(c))};
  }
  return basis;
}

Spectrum smits_reflectance(const SmitsBasis& basis, const Vector3d& rgb) {
  std::array<int, 3> by_size{0, 1, 2};
  std::ranges::sort(by_size, {}, [&](int c) { return rgb[c]; });
  const auto [least, middle, most] = by_size;
  const auto primary = [&](int c) { return basis[static_cast<std::size_t>(c)].values; };
  return {.grid = basis[0].grid,
          .values = rgb[least] + (rgb[middle] - rgb[least]) * (1 - primary(least)) +
                    (rgb[most] - rgb[middle]) * primary(most)};
}

}  // namespace spectra
