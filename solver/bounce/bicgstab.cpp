#include "solver/bounce/radiosity_methods.h"

namespace solver {
namespace {

using Eigen::ArrayXd;

/// a / b, and 0 where a step has nowhere to go.
ArrayXd ratio(const ArrayXd& a, const ArrayXd& b) { return (b != 0).select(a / b, 0.0); }

/// Inner products, weighted by area; one for all bands that are one system.
ArrayXd dot(const RadiositySystem& system, const Bands& a, const Bands& b) {
  const Bands product = (a * b).colwise() * system.exchange.area_m2;
  return system.reflector.pooled(product.colwise().sum().transpose());
}

/// (1 - R F) x
Bands apply(const RadiositySystem& system, const Bands& x) {
  return x - system.reflector.reflect(gather(system.exchange, x));
}

struct Round {
  Bands radiosity;
  int sweeps = 0;
};

/// BiCGSTAB from radiosities and their residual, until the residual seems small enough, breaks down
/// or `most` sweeps are spent.
Round descend(const RadiositySystem& system, const Certificate& from, Bands b, int most) {
  Bands r = from.change, p = r;
  const Bands shadow = r;
  ArrayXd rho = dot(system, shadow, r);
  Round round;
  while (round.sweeps < most && (rho != 0).any() &&
         (error_norms(system, r) > 0.5 * from.allowed).any()) {
    const Bands v = apply(system, p);
    const ArrayXd alpha = ratio(rho, dot(system, shadow, v));
    const Bands s = r - v.rowwise() * alpha.transpose();
    const Bands t = apply(system, s);
    const ArrayXd omega = ratio(dot(system, t, s), dot(system, t, t));
    b += p.rowwise() * alpha.transpose() + s.rowwise() * omega.transpose();
    r = s - t.rowwise() * omega.transpose();
    const ArrayXd next = dot(system, shadow, r);
    const ArrayXd beta = ratio(next, rho) * ratio(alpha, omega);
    p = r + (p - v.rowwise() * omega.transpose()).rowwise() * beta.transpose();
    rho = next;
    round.sweeps += 2;
  }
  round.radiosity = std::move(b);
  return round;
}

}  // namespace

/// Stabilised bi-conjugate gradients [VanDerVorst1992]: no symmetry needed. The change B' - B is
/// the residual of B; each round starts anew from the true one, and rounding has the last word when
/// a round gains nothing.
MethodResult bicgstab(const RadiositySystem& system, const RadiosityOptions& options) {
  Bands b = system.emission;
  Certificate proof = certify(system, b, options.relative_error);
  int sweeps = 1;
  while (sweeps < options.max_iterations && !proof.converged()) {
    Round round = descend(system, proof, std::move(b), options.max_iterations - sweeps);
    b = std::move(round.radiosity);
    const ArrayXd before = proof.norm;
    proof = certify(system, b, options.relative_error);
    sweeps += round.sweeps + 1;
    if (!(proof.norm < 0.5 * before || proof.norm <= proof.allowed).all()) break;
  }
  return {std::move(proof), Eigen::ArrayXi::Constant(system.bands(), sweeps)};
}

}  // namespace solver
