#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "solver/bounce/coarse_room.h"
#include "solver/bounce/radiosity_methods.h"

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Floats = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Rounding of float sums keeps a residual from falling much further in one round.
constexpr double kFloatReduction = 3e-6;
constexpr int kMostRounds = 40;

Index padded(Index bands) {
  constexpr auto kPad = static_cast<Index>(kColumnPad);
  return (bands + kPad - 1) / kPad * kPad;
}

/// Some columns, and zeros up to a multiple of kColumnPad.
template <typename Wide>
Floats columns_of(const Wide& wide, Index rows, const std::vector<Index>& keep) {
  Floats narrow = Floats::Zero(rows, padded(static_cast<Index>(keep.size())));
  for (Index i = 0; i < wide.rows(); ++i) {
    for (std::size_t k = 0; k < keep.size(); ++k) {
      narrow(i, static_cast<Index>(k)) = static_cast<float>(wide(i, keep[k]));
    }
  }
  return narrow;
}

/// M z = z - s X (s z) with s = d sqrt(rho / A): symmetric, eigenvalues from 1 - rho_max up. In
/// float, all its bands in one pass over X.
class FloatOperator {
 public:
  FloatOperator(const RadiositySystem& system, const CoarseRoom& coarse,
                const std::vector<Index>& bands)
      : tiles_(system.exchange.unscaled), coarse_(coarse), bands_(bands) {
    const ArrayXd d_per_root_area = system.exchange.scaling / system.exchange.area_m2.sqrt();
    const Index rows = Index{tiles_.blocks} * kTile;
    scale_ = columns_of(Bands(system.reflector.numbers().sqrt().colwise() * d_per_root_area), rows,
                        bands);
    if (!coarse.empty()) weights_ = columns_of(coarse.weights(), rows, bands);
  }

  [[nodiscard]] Index rows() const { return scale_.rows(); }

  /// Which band each column is.
  [[nodiscard]] const std::vector<Index>& bands() const { return bands_; }

  /// s X v
  [[nodiscard]] Floats scattered(const Floats& v) const {
    Floats product(v.rows(), v.cols());
    multiply(tiles_, v.data(), product.data(), static_cast<std::size_t>(v.cols()));
    return scale_ * product;
  }

  [[nodiscard]] Floats apply(const Floats& z) const { return z - scattered(scale_ * z); }

  /// r + P (M_c^-1 - I) P^T r: close to M^-1 where light is even over clusters, the identity where
  /// it is not. The eigenvalues that remain are those of light with a finer pattern, around 1.
  [[nodiscard]] Floats preconditioned(const Floats& r) const {
    if (coarse_.empty()) return r;
    const std::vector<int>& cluster = coarse_.cluster();
    Bands sum = Bands::Zero(coarse_.clusters(), r.cols());
    for (std::size_t i = 0; i < cluster.size(); ++i) {
      const auto row = static_cast<Index>(i);
      sum.row(cluster[i]) += (weights_.row(row) * r.row(row)).cast<double>();
    }
    for (std::size_t k = 0; k < bands_.size(); ++k) {
      const auto column = static_cast<Index>(k);
      const Eigen::VectorXd before = sum.col(column).matrix();
      sum.col(column) = (coarse_.inverse(bands_[k]) * before - before).array();
    }
    Floats z = r;
    for (std::size_t i = 0; i < cluster.size(); ++i) {
      const auto row = static_cast<Index>(i);
      z.row(row) += weights_.row(row) * sum.row(cluster[i]).cast<float>();
    }
    return z;
  }

  /// For some of its columns.
  void narrow(const std::vector<Index>& columns) {
    scale_ = columns_of(scale_, scale_.rows(), columns);
    if (!coarse_.empty()) weights_ = columns_of(weights_, scale_.rows(), columns);
    std::vector<Index> bands;
    for (const Index c : columns) bands.push_back(bands_[static_cast<std::size_t>(c)]);
    bands_ = std::move(bands);
  }

 private:
  const SymmetricTiles& tiles_;
  const CoarseRoom& coarse_;
  std::vector<Index> bands_;
  Floats scale_, weights_;
};

ArrayXd dot(const Floats& a, const Floats& b) {
  ArrayXd sum = ArrayXd::Zero(a.cols());
  for (Index i = 0; i < a.rows(); ++i) {
    sum += (a.row(i) * b.row(i)).cast<double>().transpose();
  }
  return sum;
}

/// Preconditioned conjugate gradients on every column in step.
class LockstepSolve {
 public:
  /// @param enough  residual norm at which a column has arrived, per column
  LockstepSolve(FloatOperator m, Floats rhs, const ArrayXd& enough)
      : m_(std::move(m)),
        solution_(Floats::Zero(rhs.rows(), rhs.cols())),
        z_(solution_),
        r_(std::move(rhs)),
        p_(m_.preconditioned(r_)),
        rp_(dot(r_, p_)),
        rr_(dot(r_, r_)),
        enough_(ArrayXd::Zero(r_.cols())),
        column_(m_.bands().size()) {
    enough_.head(enough.size()) = enough.square();
    std::iota(column_.begin(), column_.end(), Index{0});
  }

  /// Takes columns that have arrived out of the product, if that makes it narrower. @return whether
  /// any is left
  bool drop_arrived() {
    std::vector<Index> left;
    for (std::size_t k = 0; k < column_.size(); ++k) {
      const auto column = static_cast<Index>(k);
      if (rr_[column] > enough_[column]) left.push_back(column);
    }
    if (!left.empty() && padded(static_cast<Index>(left.size())) < r_.cols()) narrow(left);
    return !left.empty();
  }

  /// One product with X; a column that has arrived waits with step length 0.
  void step(Eigen::ArrayXi& iterations) {
    const Floats mp = m_.apply(p_);
    const ArrayXd pmp = dot(p_, mp);
    const auto active = (rr_ > enough_ && pmp > 0).eval();
    const Eigen::ArrayXf alpha = active.select(rp_ / pmp, 0.0).cast<float>();
    z_ += p_.rowwise() * alpha.transpose();
    r_ -= mp.rowwise() * alpha.transpose();
    const Floats preconditioned = m_.preconditioned(r_);
    const ArrayXd next = dot(r_, preconditioned);
    const Eigen::ArrayXf beta = active.select(next / rp_, 0.0).cast<float>();
    p_ = preconditioned + p_.rowwise() * beta.transpose();
    rp_ = next;
    rr_ = active.select(dot(r_, r_), 0.0);  // one without a direction left has arrived too
    for (std::size_t k = 0; k < column_.size(); ++k) {
      iterations[m_.bands()[k]] += active[static_cast<Index>(k)] ? 1 : 0;
    }
  }

  [[nodiscard]] const Floats& solution() {
    keep();
    return solution_;
  }

 private:
  void keep() {
    for (std::size_t k = 0; k < column_.size(); ++k) {
      solution_.col(column_[k]) = z_.col(static_cast<Index>(k));
    }
  }

  void narrow(const std::vector<Index>& left) {
    keep();
    m_.narrow(left);
    for (Floats* wide : {&z_, &r_, &p_}) *wide = columns_of(*wide, wide->rows(), left);
    std::vector<Index> column;
    for (const Index k : left) column.push_back(column_[static_cast<std::size_t>(k)]);
    column_ = std::move(column);
    for (ArrayXd* wide : {&rp_, &rr_, &enough_}) {
      const ArrayXd all = std::exchange(*wide, ArrayXd::Zero(r_.cols()));
      wide->head(static_cast<Index>(left.size())) = all(left);
    }
  }

  FloatOperator m_;
  Floats solution_, z_, r_, p_;
  ArrayXd rp_, rr_, enough_;
  std::vector<Index> column_;  ///< in `solution_`, of each that is left
};

/// What the bands that have not arrived lack in radiosity: with change = B' - B, e solves M e =
/// sqrt(rho A) F change, and B' + sqrt(rho / A) e is better than B'.
Bands correction(const RadiositySystem& system, const CoarseRoom& coarse, const Certificate& proof,
                 int most, Eigen::ArrayXi& iterations) {
  Bands result = Bands::Zero(system.rows(), system.bands());
  std::vector<Index> open;
  for (Index k = 0; k < system.bands(); ++k) {
    if (proof.norm[k] > proof.allowed[k]) open.push_back(k);
  }
  const FloatOperator m(system, coarse, open);
  // Each band is scaled to norm 1, so that float neither overflows nor loses small bands.
  const ArrayXd root_area = system.exchange.area_m2.sqrt();
  ArrayXd size = (proof.change.colwise() * root_area).matrix().colwise().norm().transpose();
  size = (size > 0).select(size, 1.0);
  const Bands unit_change =
      (proof.change.rowwise() / size.transpose()).colwise() * system.exchange.scaling;
  const Floats rhs = m.scattered(columns_of(unit_change, m.rows(), open));

  const ArrayXd reduction = (0.3 * proof.allowed / proof.norm).max(kFloatReduction);
  LockstepSolve solve(m, rhs, reduction(open) * dot(rhs, rhs).head(Index(open.size())).sqrt());
  for (int k = 0; k < most && solve.drop_arrived(); ++k) solve.step(iterations);
  const Floats& e = solve.solution();
  for (std::size_t k = 0; k < open.size(); ++k) {
    result.col(open[k]) = e.col(static_cast<Index>(k)).head(system.rows()).cast<double>() *
                          system.reflector.numbers().col(open[k]).sqrt() / root_area *
                          size[open[k]];
  }
  return result;
}

}  // namespace

/// Iterative refinement: gather in double, correct in float. The first correction is that of the
/// coarse room, in double, since the light that fades most slowly is many times the light sent.
MethodResult lockstep_conjugate_gradients(const RadiositySystem& system,
                                          const RadiosityOptions& options) {
  const CoarseRoom coarse(system);
  Eigen::ArrayXi iterations = Eigen::ArrayXi::Zero(system.bands());
  Certificate proof = certify(system, system.emission, options.relative_error);
  if (!coarse.empty() && !proof.converged()) {
    const Bands later = system.reflector.numbers() * coarse.irradiance(proof.change);
    proof = certify(system, proof.radiosity + later, options.relative_error);
  }
  for (int round = 0; round < kMostRounds && !proof.converged(); ++round) {
    const int left = options.max_iterations - iterations.maxCoeff();
    if (left <= 0) break;
    const ArrayXd before = proof.norm;
    proof = certify(system, proof.radiosity + correction(system, coarse, proof, left, iterations),
                    options.relative_error);
    const bool some_progress = (proof.norm < 0.5 * before || proof.norm <= proof.allowed).all();
    if (!some_progress) break;  // rounding has the last word
  }
  return {std::move(proof), std::move(iterations)};
}

}  // namespace solver
