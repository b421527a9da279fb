#include <Eigen/Cholesky>
#include <algorithm>

#include "solver/bounce/radiosity_methods.h"

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;

/// The form factors as one dense matrix, for methods that walk along rows and columns.
MatrixXd dense_form_factors(const ExchangeAreas& exchange) {
  MatrixXd f(exchange.rows(), exchange.rows());
  for (int j = 0; j < exchange.rows(); ++j) {
    for (int i = 0; i < exchange.rows(); ++i) f(i, j) = exchange.form_factor(i, j);
  }
  return f;
}

/// What is left to shoot, and where it will end if every patch sees every other as in a sphere,
/// F_ij = A_j / sum A: unshot light u makes the mean irradiance u / (1 - mean rho) everywhere
/// [Cohen1988].
class Shooting {
 public:
  explicit Shooting(const RadiositySystem& system)
      : reflectance_(system.reflector.numbers()),
        weight_(system.exchange.area_m2 / system.exchange.area_m2.sum()),
        share_(shares(system.exchange)),
        fading_(1 - (share_.transpose() * reflectance_.matrix()).array()),
        radiosity_(system.emission + reflectance_ * system.direct),
        unshot_(radiosity_) {}

  /// The row with most power left, of either sign, summed over bands; with `overshoot`, with most
  /// of what it should have shot in the end.
  [[nodiscard]] Index brightest(bool overshoot) const {
    Index j = 0;
    if (overshoot) {
      const Bands expected = unshot_ + later();
      (expected.abs().rowwise().sum() * weight_).maxCoeff(&j);
    } else {
      (unshot_.abs().rowwise().sum() * weight_).maxCoeff(&j);
    }
    return j;
  }

  /// What is shot ahead of its arrival is owed: the patch is left with less than nothing.
  void shoot(Index j, const MatrixXd& form_factors, bool overshoot) {
    const bool mean = share_[j] > 0;
    const BandRow ahead = overshoot && mean ? BandRow(reflectance_.row(j) * ambient())
                                            : BandRow::Zero(unshot_.cols());
    const Eigen::RowVectorXd shot = unshot_.row(j) + ahead;
    unshot_.row(j) = -ahead;
    const Bands arriving = (form_factors.col(j) * shot).array() * reflectance_;
    radiosity_ += arriving;
    unshot_ += arriving;
  }

  [[nodiscard]] Bands answer(bool with_ambient) const {
    return with_ambient ? radiosity_ + later() : radiosity_;
  }

 private:
  /// Of each patch in the area; 0 for slopes.
  static Eigen::VectorXd shares(const ExchangeAreas& exchange) {
    Eigen::VectorXd share = Eigen::VectorXd::Zero(exchange.rows());
    share.head(exchange.patches()) =
        (exchange.area_m2.head(exchange.patches()) / exchange.total_area_m2()).matrix();
    return share;
  }

  /// What patches will reflect of all unshot light; it changes no slope.
  [[nodiscard]] Bands later() const {
    Bands later = reflectance_.rowwise() * ambient();
    for (Index i = 0; i < later.rows(); ++i) {
      if (share_[i] == 0) later.row(i) = 0;
    }
    return later;
  }

  [[nodiscard]] BandRow ambient() const {
    return (share_.transpose() * unshot_.matrix()).array() / fading_;
  }

  const Bands& reflectance_;
  ArrayXd weight_;  ///< of each row in the area of all
  Eigen::VectorXd share_;
  BandRow fading_;            ///< 1 - mean rho
  Bands radiosity_, unshot_;  ///< the first includes the second
};

Eigen::ArrayXi count(const RadiositySystem& system, int iterations) {
  return Eigen::ArrayXi::Constant(system.bands(), iterations);
}

}  // namespace

/// Each sweep adds one bounce.
MethodResult jacobi(const RadiositySystem& system, const RadiosityOptions& options) {
  Certificate proof = certify(system, system.emission, options.relative_error);
  int sweeps = 1;
  for (; sweeps < options.max_iterations && !proof.converged(); ++sweeps) {
    proof = certify(system, proof.radiosity, options.relative_error);
  }
  return {std::move(proof), count(system, sweeps)};
}

/// As Jacobi, but a patch gathers what the patches before it have just become.
MethodResult gauss_seidel(const RadiositySystem& system, const RadiosityOptions& options) {
  const MatrixXd f = dense_form_factors(system.exchange).transpose();  // column i: row i of F
  Bands b = system.emission;
  Certificate proof = certify(system, b, options.relative_error);
  int sweeps = 0;
  for (; sweeps < options.max_iterations && !proof.converged(); ++sweeps) {
    for (Index i = 0; i < system.rows(); ++i) {
      const Eigen::RowVectorXd gathered = f.col(i).transpose() * b.matrix();
      const BandRow arriving = gathered.array() + system.direct.row(i);
      b.row(i) = system.emission.row(i) + system.reflector.reflect(i, arriving);
    }
    proof = certify(system, b, options.relative_error);
  }
  return {std::move(proof), count(system, sweeps)};
}

/// Southwell relaxation [Cohen1988]: the patch with most unshot power shoots all of it. A gather
/// for the bound costs little beside as many shots as there are patches.
MethodResult progressive(const RadiositySystem& system, const RadiosityOptions& options) {
  const MatrixXd f = dense_form_factors(system.exchange);
  Shooting shooting(system);
  Certificate proof = certify(system, shooting.answer(options.ambient), options.relative_error);
  int sweeps = 0;
  for (; sweeps < options.max_iterations && !proof.converged(); ++sweeps) {
    for (Index shot = 0; shot < system.rows(); ++shot) {
      shooting.shoot(shooting.brightest(options.overshoot), f, options.overshoot);
    }
    proof = certify(system, shooting.answer(options.ambient), options.relative_error);
  }
  return {std::move(proof), count(system, sweeps)};
}

/// Cholesky of the symmetric form, band by band.
MethodResult direct(const RadiositySystem& system, const RadiosityOptions& options) {
  const Index n = system.rows();
  const ArrayXd root_area = system.exchange.area_m2.sqrt();
  const MatrixXd g = root_area.matrix().asDiagonal() * dense_form_factors(system.exchange) *
                     root_area.inverse().matrix().asDiagonal();
  Bands b = system.emission;
  for (Index k = 0; k < system.bands(); ++k) {
    const ArrayXd r = system.reflector.numbers().col(k).sqrt();
    const MatrixXd m =
        MatrixXd::Identity(n, n) - r.matrix().asDiagonal() * g * r.matrix().asDiagonal();
    const Eigen::VectorXd arriving = g * (root_area * system.emission.col(k)).matrix();
    const ArrayXd rhs = r * (arriving.array() + root_area * system.direct.col(k));
    const Eigen::VectorXd z = m.llt().solve(rhs.matrix());
    b.col(k) = system.emission.col(k) + r * z.array() / root_area;
  }
  return {certify(system, b, options.relative_error), count(system, 1)};
}

}  // namespace solver
