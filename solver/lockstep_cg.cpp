#include <algorithm>
#include <cmath>

#include "solver/far_field.h"
#include "solver/radiosity_methods.h"

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Floats = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Rounding of float sums keeps a residual from falling much further in one round.
constexpr double kFloatReduction = 3e-6;
constexpr int kMostRounds = 40;

/// M z = z - s X (s z) with s = d sqrt(rho / A): symmetric, eigenvalues from 1 - rho_max up. In
/// float, all bands of a round in one pass over X.
class FloatOperator {
 public:
  explicit FloatOperator(const RadiositySystem& system)
      : tiles_(system.exchange.unscaled),
        scale_(Floats::Zero(Index{tiles_.blocks} * kTile, padded(system.bands()))) {
    const ArrayXd d_per_root_area = system.exchange.scaling / system.exchange.area_m2.sqrt();
    scale_.topLeftCorner(system.patches(), system.bands()) =
        (system.reflector.numbers().sqrt().colwise() * d_per_root_area).cast<float>();
  }

  [[nodiscard]] Floats zero() const { return Floats::Zero(scale_.rows(), scale_.cols()); }

  /// s X v
  [[nodiscard]] Floats scattered(const Floats& v) const {
    Floats product(v.rows(), v.cols());
    multiply(tiles_, v.data(), product.data(), static_cast<std::size_t>(v.cols()));
    return scale_ * product;
  }

  [[nodiscard]] Floats apply(const Floats& z) const { return z - scattered(scale_ * z); }

 private:
  static Index padded(Index bands) {
    constexpr auto kPad = static_cast<Index>(kColumnPad);
    return (bands + kPad - 1) / kPad * kPad;
  }

  const SymmetricTiles& tiles_;
  Floats scale_;
};

ArrayXd dot(const Floats& a, const Floats& b) {
  ArrayXd sum = ArrayXd::Zero(a.cols());
  for (Index i = 0; i < a.rows(); ++i) {
    sum += (a.row(i) * b.row(i)).cast<double>().transpose();
  }
  return sum;
}

/// Conjugate gradients on every column in step, until each has reduced its residual by `reduction`;
/// a column that has arrived waits with step length 0.
Floats reduce(const FloatOperator& m, const Floats& rhs, const ArrayXd& reduction, int most,
              Eigen::ArrayXi& iterations) {
  Floats z = Floats::Zero(rhs.rows(), rhs.cols()), r = rhs, p = rhs;
  ArrayXd rr = dot(r, r);
  const ArrayXd enough = reduction.square() * rr;
  for (int k = 0; k < most && (rr > enough).any(); ++k) {
    const Floats mp = m.apply(p);
    const ArrayXd pmp = dot(p, mp);
    const auto active = (rr > enough && pmp > 0).eval();
    if (!active.any()) break;
    const Eigen::ArrayXf alpha = active.select(rr / pmp, 0.0).cast<float>();
    z += p.rowwise() * alpha.transpose();
    r -= mp.rowwise() * alpha.transpose();
    const ArrayXd next = dot(r, r);
    const Eigen::ArrayXf beta = active.select(next / rr, 0.0).cast<float>();
    p = r + p.rowwise() * beta.transpose();
    rr = active.select(next, 0.0);
    iterations += active.head(iterations.size()).cast<int>();
  }
  return z;
}

}  // namespace

/// Iterative refinement: gather in double, correct in float. With change = B' - B, the correction e
/// of z = sqrt(rho A) H solves M e = sqrt(rho A) F change, and B' + sqrt(rho / A) e is better than
/// B'.
MethodResult lockstep_conjugate_gradients(const RadiositySystem& system,
                                          const RadiosityOptions& options) {
  const FloatOperator m(system);
  const Index n = system.patches(), bands = system.bands();
  const Bands to_radiosity =
      system.reflector.numbers().sqrt().colwise() * system.exchange.area_m2.rsqrt();
  Eigen::ArrayXi iterations = Eigen::ArrayXi::Zero(bands);
  Certificate proof = certify(system, system.emission, options.relative_error);
  for (int round = 0; round < kMostRounds && !proof.converged(); ++round) {
    const int left = options.max_iterations - iterations.maxCoeff();
    if (left <= 0) break;
    // Each band is scaled to norm 1, so that float neither overflows nor loses small bands.
    const ArrayXd root_area = system.exchange.area_m2.sqrt();
    ArrayXd size = (proof.change.colwise() * root_area).matrix().colwise().norm().transpose();
    size = (size > 0).select(size, 1.0);
    const Bands unit_change = proof.change.rowwise() / size.transpose();
    Floats change = m.zero();
    change.topLeftCorner(n, bands) =
        (unit_change.colwise() * system.exchange.scaling).cast<float>();

    ArrayXd reduction = ArrayXd::Ones(change.cols());
    reduction.head(bands) = (0.3 * proof.allowed / proof.norm).max(kFloatReduction).min(1.0);
    const Floats e = reduce(m, m.scattered(change), reduction, left, iterations);
    const Bands correction = e.topLeftCorner(n, bands).cast<double>() * to_radiosity;
    const ArrayXd before = proof.norm;
    proof = certify(system, proof.radiosity + (correction.rowwise() * size.transpose()),
                    options.relative_error);
    const bool some_progress = (proof.norm < 0.5 * before || proof.norm <= proof.allowed).all();
    if (!some_progress) break;  // rounding has the last word
  }
  return {std::move(proof), std::move(iterations)};
}

}  // namespace solver
