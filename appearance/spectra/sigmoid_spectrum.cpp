#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "appearance/spectra/cie_tables.h"
#include "appearance/spectra/photometry.h"
#include "appearance/spectra/rgb_to_spectrum.h"

namespace spectra {
namespace {

using Eigen::ArrayXd, Eigen::Matrix3d, Eigen::MatrixX3d, Eigen::Vector3d;

ArrayXd sigmoid(const ArrayXd& x) { return 0.5 + 0.5 * x * (1 + x.square()).rsqrt(); }

/// Find c with weights' sigmoid(powers c) = xyz.
struct Fit {
  MatrixX3d powers;   ///< t^2, t, 1 with t = -1 .. 1 over the grid
  MatrixX3d weights;  ///< a perfect diffuser has Y = 1

  [[nodiscard]] Vector3d colour(const Vector3d& c) const {
    return weights.transpose() * sigmoid((powers * c).array()).matrix();
  }

  [[nodiscard]] Matrix3d jacobian(const Vector3d& c) const {
    const ArrayXd x = (powers * c).array();
    const ArrayXd slope = 0.5 * (1 + x.square()).pow(-1.5);
    return weights.transpose() * slope.matrix().asDiagonal() * powers;
  }
};

constexpr double kTolerance = 1e-12;  // of a Y of 1

/// Damped Gauss-Newton from c; true if the residual went below the tolerance.
bool refine(const Fit& fit, const Vector3d& xyz, Vector3d& c) {
  constexpr int kMaxSteps = 200;
  double damping = 1e-3;
  Vector3d missing = xyz - fit.colour(c);
  for (int step = 0; step < kMaxSteps && !(missing.norm() < kTolerance); ++step) {
    const Matrix3d j = fit.jacobian(c);
    Matrix3d normal = j.transpose() * j;
    normal.diagonal() *= 1 + damping;
    const Vector3d next = c + normal.ldlt().solve(j.transpose() * missing);
    const Vector3d next_missing = xyz - fit.colour(next);
    const bool better = next_missing.norm() < missing.norm();
    damping = std::clamp(damping * (better ? 0.1 : 10), 1e-15, 1e15);
    if (!better) continue;
    c = next;
    missing = next_missing;
  }
  return missing.norm() < kTolerance;
}

Fit make_fit(const Spectrum& light) {
  const Eigen::Index n = light.values.size();
  const ArrayXd t = ArrayXd::LinSpaced(n, -1, 1);
  Fit fit{.powers = MatrixX3d::Ones(n, 3), .weights = colour_matching(light.grid)};
  fit.powers.col(0) = t.square();
  fit.powers.col(1) = t;
  fit.weights.array().colwise() *= light.values;
  fit.weights /= fit.weights.col(1).sum();
  return fit;
}

/// The coefficients of t = (nm - middle) / half as those of nm.
Vector3d in_nanometres(const Vector3d& c, const Grid& grid) {
  const double middle = (grid.first_nm + grid.last_nm()) / 2;
  const double half = (grid.last_nm() - grid.first_nm) / 2;
  const double square = c[0] / (half * half), linear = c[1] / half;
  return {square, linear - 2 * square * middle, (square * middle - linear) * middle + c[2]};
}

}  // namespace

Spectrum sigmoid_spectrum(const Grid& grid, const Vector3d& coefficients) {
  const ArrayXd nm = ArrayXd::LinSpaced(grid.count, grid.first_nm, grid.last_nm());
  const auto& c = coefficients;
  return {.grid = grid, .values = sigmoid((c[0] * nm + c[1]) * nm + c[2])};
}

Reconstruction reconstruct_sigmoid(const RelativeXyz& xyz, const Spectrum& light) {
  if (!(luminous(light) > 0)) {
    throw std::invalid_argument("a colour cannot be reconstructed under a light without luminance");
  }
  const Fit fit = make_fit(light);
  const Vector3d target = Vector3d(xyz.x, xyz.y, xyz.z) / 100;
  Vector3d c = Vector3d::Zero();
  const bool converged = refine(fit, target, c);
  const Spectrum rho = sigmoid_spectrum(light.grid, in_nanometres(c, light.grid));
  return {.reflectance = rho,
          .converged = converged && rho.values.minCoeff() > 0 && rho.values.maxCoeff() < 1};
}

}  // namespace spectra
