#include "appearance/spectra/reconstruct.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

#include "appearance/spectra/cie_tables.h"
#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/photometry.h"
#include "appearance/spectra/srgb_transfer.h"

namespace spectra {
namespace {

using Eigen::ArrayXd, Eigen::MatrixXd, Eigen::VectorXd;

/// Minimise |slope of z|^2 / 2 subject to weights' rho = xyz, with rho = (1 + tanh z) / 2: the
/// stationary point of the Lagrangian is a root of `residual` [Burns2020].
struct Problem {
  MatrixXd weights;     ///< one column each for X, Y, Z; a perfect diffuser has Y = 1
  Eigen::Vector3d xyz;  ///< on the same scale

  [[nodiscard]] Eigen::Index bands() const { return weights.rows(); }
};

ArrayXd reflectance(const VectorXd& z) { return 1 / (1 + (-2 * z.array()).exp()); }

VectorXd squared_slope_gradient(const VectorXd& z) {
  VectorXd gradient = VectorXd::Zero(z.size());
  const VectorXd rise = z.tail(z.size() - 1) - z.head(z.size() - 1);
  gradient.tail(rise.size()) += rise;
  gradient.head(rise.size()) -= rise;
  return gradient;
}

VectorXd residual(const Problem& p, const VectorXd& unknowns) {
  const VectorXd z = unknowns.head(p.bands());
  const ArrayXd rho = reflectance(z), slope = 2 * rho * (1 - rho);
  VectorXd r(unknowns.size());
  r.head(p.bands()) = squared_slope_gradient(z);
  r.head(p.bands()).array() += slope * (p.weights * unknowns.tail<3>()).array();
  r.tail<3>() = p.weights.transpose() * rho.matrix() - p.xyz;
  return r;
}

MatrixXd jacobian(const Problem& p, const VectorXd& unknowns) {
  const Eigen::Index n = p.bands();
  const ArrayXd rho = reflectance(unknowns.head(n)), slope = 2 * rho * (1 - rho);
  const ArrayXd curvature = 2 * slope * (1 - 2 * rho);
  MatrixXd j = MatrixXd::Zero(n + 3, n + 3);
  j.diagonal().head(n).array() = 2 + curvature * (p.weights * unknowns.tail<3>()).array();
  j(0, 0) -= 1;
  j(n - 1, n - 1) -= 1;
  j.diagonal(1).head(n - 1).setConstant(-1);
  j.diagonal(-1).head(n - 1).setConstant(-1);
  j.topRightCorner(n, 3) = p.weights.array().colwise() * slope;
  j.bottomLeftCorner(3, n) = j.topRightCorner(n, 3).transpose();
  return j;
}

/// Newton from a flat 0.5 with a line search: without it some chips of the renotation run away.
bool solve(const Problem& p, VectorXd& unknowns) {
  constexpr int kMaxSteps = 200;        // chips close to the surface of the solid take up to 150
  constexpr double kTolerance = 1e-12;  // of a Y of 1; the round trip is asked for to 1e-9 of 100
  VectorXd r = residual(p, unknowns);
  for (int step = 0; step < kMaxSteps && !(r.norm() < kTolerance); ++step) {
    const VectorXd direction = jacobian(p, unknowns).partialPivLu().solve(-r);
    double length = 1;
    VectorXd next, next_r;
    do {
      next = unknowns + length * direction;
      next_r = residual(p, next);
      length /= 2;
    } while (!(next_r.norm() < r.norm()) && length > 1e-10);
    if (!(next_r.norm() < r.norm())) break;
    unknowns = next;
    r = next_r;
  }
  return r.norm() < kTolerance;
}

/// The primaries of IEC 61966-2-1 (those of BT.709), balanced to the white of the bands instead of
/// the rounded (0.3127, 0.3290), so that a grey has a flat reflectance.
Eigen::Matrix3d srgb_to_xyz(const Eigen::Vector3d& white) {
  Eigen::Matrix3d primaries;      // x, y, 1 - x - y in each column
  primaries << 0.64, 0.30, 0.15,  //
      0.33, 0.60, 0.06,           //
      0.03, 0.10, 0.79;
  return primaries * primaries.partialPivLu().solve(white).asDiagonal();
}

const Spectrum& d65_bands() {
  static const Spectrum d65 = light_on(kTransportGrid, illuminant("D65"));
  return d65;
}

}  // namespace

Reconstruction reconstruct_reflectance(const RelativeXyz& xyz, const Spectrum& light) {
  if (!(luminous(light) > 0)) {
    throw std::invalid_argument("a colour cannot be reconstructed under a light without luminance");
  }
  const Eigen::Matrix<double, Eigen::Dynamic, 3> tristimulus =
      colour_matching(light.grid).array().colwise() * light.values;
  return reconstruct_from_sums(light.grid, tristimulus / tristimulus.col(1).sum(),
                               Eigen::Vector3d(xyz.x, xyz.y, xyz.z) / 100);
}

Reconstruction reconstruct_from_sums(const Grid& grid,
                                     const Eigen::Matrix<double, Eigen::Dynamic, 3>& weights,
                                     const Eigen::Vector3d& xyz) {
  const Problem p{.weights = weights, .xyz = xyz};
  VectorXd unknowns = VectorXd::Zero(p.bands() + 3);
  const bool solved = solve(p, unknowns);
  const ArrayXd rho = reflectance(unknowns.head(p.bands()));
  return {.reflectance = {.grid = grid, .values = rho},
          .converged = solved && rho.minCoeff() > 0 && rho.maxCoeff() < 1};
}

RelativeXyz srgb_xyz(const Eigen::Vector3d& rgb) {
  if (!((rgb.array() >= 0).all() && (rgb.array() <= 1).all())) {
    throw std::invalid_argument(fmt::format(
        "an sRGB colour has components from 0 to 1, not ({}, {}, {})", rgb[0], rgb[1], rgb[2]));
  }
  const RelativeXyz white = relative_xyz(constant(kTransportGrid, 1), d65_bands());
  const Eigen::Vector3d xyz =
      srgb_to_xyz({white.x, white.y, white.z}) * rgb.unaryExpr(&srgb_decoded);
  return {.x = xyz[0], .y = xyz[1], .z = xyz[2]};
}

Reconstruction reconstruct_srgb(double r, double g, double b) {
  const RelativeXyz xyz = srgb_xyz({r, g, b});
  if (r == 0 && g == 0 && b == 0) {
    return {.reflectance = constant(kTransportGrid, 0), .converged = true};
  }
  return reconstruct_reflectance(xyz, d65_bands());
}

}  // namespace spectra
