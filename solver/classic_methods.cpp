#include <Eigen/Cholesky>
#include <algorithm>

#include "solver/radiosity_methods.h"

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;

/// The form factors as one dense matrix, for methods that walk along rows and columns.
MatrixXd dense_form_factors(const ExchangeAreas& exchange) {
  MatrixXd f(exchange.patches(), exchange.patches());
  for (int j = 0; j < exchange.patches(); ++j) {
    for (int i = 0; i < exchange.patches(); ++i) f(i, j) = exchange.form_factor(i, j);
  }
  return f;
}

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
    for (Index i = 0; i < system.patches(); ++i) {
      const Eigen::RowVectorXd gathered = f.col(i).transpose() * b.matrix();
      const BandRow arriving = gathered.array() + system.direct.row(i);
      b.row(i) = system.emission.row(i) + system.reflector.reflect(i, arriving);
    }
    proof = certify(system, b, options.relative_error);
  }
  return {std::move(proof), count(system, sweeps)};
}

/// Southwell relaxation [Cohen1988]: the patch with most unshot power, summed over bands, shoots
/// all of it. The unshot radiosities U are the residual, (1 - rho F)(B_exact - B) = U, so they
/// bound the error without a gather.
MethodResult progressive(const RadiositySystem& system, const RadiosityOptions& options) {
  const MatrixXd f = dense_form_factors(system.exchange);
  const ArrayXd& area = system.exchange.area_m2;
  const Bands& reflectance = system.reflector.numbers();
  Bands b = system.emission + reflectance * system.direct, unshot = b;
  Certificate proof = certify(system, b, options.relative_error);
  int sweeps = 0;
  for (; sweeps < options.max_iterations && !proof.converged(); ++sweeps) {
    for (Index shot = 0; shot < system.patches(); ++shot) {
      Index j = 0;
      (unshot.rowwise().sum() * area).maxCoeff(&j);
      const Eigen::RowVectorXd power = unshot.row(j);
      unshot.row(j).setZero();
      const Bands arriving = (f.col(j) * power).array() * reflectance;
      b += arriving;
      unshot += arriving;
    }
    if ((error_norms(system, unshot) <= proof.allowed).all()) {
      proof = certify(system, b, options.relative_error);
    }
  }
  proof = certify(system, b, options.relative_error);
  return {std::move(proof), count(system, sweeps)};
}

/// Cholesky of the symmetric form, band by band.
MethodResult direct(const RadiositySystem& system, const RadiosityOptions& options) {
  const Index n = system.patches();
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
