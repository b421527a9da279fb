#include "solver/bounce/reflector.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::Matrix3d;
using Shape = Eigen::Matrix<double, 5, 1>;  ///< of a norm: T up to its size

/// Upper triangular with a positive diagonal: every quadratic norm has such a T.
Matrix3d scale_of(const Shape& shape) {
  Matrix3d t = Matrix3d::Zero();
  t.diagonal() << 1, std::exp(shape[0]), std::exp(shape[1]);
  t(0, 1) = shape[2];
  t(0, 2) = shape[3];
  t(1, 2) = shape[4];
  return t;
}

/// The longest of |T R T^-1|.
double contraction_in(const Matrix3d& t, const std::vector<Matrix3d>& matrices) {
  const Matrix3d inverse = t.triangularView<Eigen::Upper>().solve(Matrix3d::Identity());
  double longest = 0;
  for (const Matrix3d& matrix : matrices) {
    longest = std::max(longest, (t * matrix * inverse).operatorNorm());
  }
  return longest;
}

/// Compass search from the plain norm. No norm is shorter than the largest eigenvalue, which it
/// nearly always reaches; wherever it stops, the result is a norm and its contraction a proof. A
/// step must gain 2 % of what is left to 1: lopsided norms weaken the bounds of single bands.
Matrix3d contracting_scale(const std::vector<Matrix3d>& matrices) {
  constexpr double kFirstStep = 1, kLastStep = 1e-3, kWorthwhile = 0.02;
  Shape best = Shape::Zero();
  double contraction = contraction_in(scale_of(best), matrices);
  double step = kFirstStep;
  while (step > kLastStep) {
    bool better = false;
    for (Index k = 0; k < 2 * best.size() && !better; ++k) {
      Shape next = best;
      next[k / 2] += k % 2 == 0 ? step : -step;
      const double shorter = contraction_in(scale_of(next), matrices);
      better = shorter < contraction - kWorthwhile * std::abs(1 - contraction);
      if (better) {
        best = next;
        contraction = shorter;
      }
    }
    if (!better) step /= 2;
  }
  return scale_of(best);
}

}  // namespace

Reflector::Reflector(Bands reflectance)
    : numbers_(std::move(reflectance)),
      contraction_(numbers_.abs().colwise().maxCoeff().transpose()),
      reach_(ArrayXd::Ones(numbers_.cols())) {
  if (!numbers_.isFinite().all()) throw std::invalid_argument("a reflectance is not finite");
}

Reflector::Reflector(std::vector<Matrix3d> matrices, std::vector<int> material)
    : matrices_(std::move(matrices)), material_(std::move(material)) {
  const auto count = static_cast<int>(matrices_.size());
  for (const int m : material_) {
    if (m < 0 || m >= count) {
      throw std::invalid_argument(fmt::format("material {}; want 0 to below {}", m, count));
    }
  }
  for (const Matrix3d& matrix : matrices_) {
    if (!matrix.allFinite()) throw std::invalid_argument("a reflection matrix is not finite");
  }
  scale_ = contracting_scale(matrices_);
  // The margin covers the rounding of the singular values.
  contraction_ = ArrayXd::Constant(3, contraction_in(scale_, matrices_) * (1 + 1e-12));
  reach_ = scale_.inverse().rowwise().norm().array();
}

Index Reflector::patches() const {
  return couples_bands() ? static_cast<Index>(material_.size()) : numbers_.rows();
}

Index Reflector::bands() const { return couples_bands() ? 3 : numbers_.cols(); }

Bands Reflector::reflect(const Bands& arriving) const {
  if (!couples_bands()) return numbers_ * arriving;
  Bands leaving(arriving.rows(), 3);
  for (Index i = 0; i < arriving.rows(); ++i) {
    const auto material = static_cast<std::size_t>(material_[static_cast<std::size_t>(i)]);
    Eigen::Map<Eigen::Vector3d>(&leaving(i, 0)).noalias() =
        matrices_[material] * Eigen::Map<const Eigen::Vector3d>(&arriving(i, 0));
  }
  return leaving;
}

BandRow Reflector::reflect(Index patch, const BandRow& arriving) const {
  if (!couples_bands()) return numbers_.row(patch) * arriving;
  const auto material = static_cast<std::size_t>(material_[static_cast<std::size_t>(patch)]);
  return (arriving.matrix() * matrices_[material].transpose()).array();
}

ArrayXd Reflector::norms(const Bands& weighted) const {
  if (!couples_bands()) return weighted.matrix().colwise().norm().transpose();
  return ArrayXd::Constant(3, (weighted.matrix() * scale_.transpose()).norm());
}

ArrayXd Reflector::pooled(const ArrayXd& sums) const {
  return couples_bands() ? ArrayXd::Constant(3, sums.sum()) : sums;
}

Reflector Reflector::columns(const std::vector<Index>& bands) const {
  return couples_bands() ? *this : Reflector(Bands(numbers_(Eigen::all, bands)));
}

}  // namespace solver
