#include "solver/bounce/radiosity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solver/bounce/radiosity_methods.h"
#include "solver/bounce/repeated_bands.h"

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

void require(bool holds, const char* what, double value, const char* wanted) {
  if (!holds) throw std::invalid_argument(fmt::format("{} {}; want {}", what, value, wanted));
}

/// Of the means; slopes have either sign. Written so that NaN fails too.
void require_physical(Index patches, const Bands& emission, const Bands& direct,
                      const Bands& reflectance) {
  const Index means = std::min(patches, std::min(emission.rows(), direct.rows()));
  const auto emitted = emission.topRows(means), arriving = direct.topRows(means);
  require((emitted >= 0).all(), "emission down to", emitted.minCoeff(), "0 or more");
  require((arriving >= 0).all(), "direct irradiance down to", arriving.minCoeff(), "0 or more");
  require((reflectance >= 0 && reflectance < 1).all(), "reflectance up to", reflectance.maxCoeff(),
          "0 to below 1");
}

void check(const ExchangeAreas& exchange, const Bands& emission, const Bands& direct,
           const Reflector& reflector, const RadiosityOptions& options) {
  const auto require_shape = [&](Index rows, Index columns) {
    if (rows == exchange.rows() && columns == emission.cols()) return;
    throw std::invalid_argument(
        fmt::format("{} x {} values; want {} patches x {} functions of each x {} bands", rows,
                    columns, exchange.patches(), exchange.modes, emission.cols()));
  };
  require_shape(emission.rows(), emission.cols());
  require_shape(direct.rows(), direct.cols());
  require_shape(reflector.patches(), reflector.bands());
  require(emission.isFinite().all(), "emission up to", emission.maxCoeff(), "finite values");
  require(direct.isFinite().all(), "direct irradiance up to", direct.maxCoeff(), "finite values");
  require(options.relative_error > 0, "relative error", options.relative_error, "more than 0");
  require(options.max_iterations > 0, "iterations", options.max_iterations, "more than 0");
  if ((options.ambient || options.overshoot) && options.method != Method::progressive) {
    throw std::invalid_argument("ambient term and overshoot need the method progressive");
  }
}

/// Bands that carry light; all or none where they exchange it; all without `skip`.
std::vector<Index> lit_bands(const Bands& emission, const Bands& direct, const Reflector& reflector,
                             bool skip) {
  std::vector<Index> lit;
  for (Index k = 0; k < emission.cols(); ++k) {
    if (!skip || (emission.col(k) != 0).any() || (direct.col(k) != 0).any()) lit.push_back(k);
  }
  if (reflector.couples_bands() && !lit.empty()) lit = {0, 1, 2};
  return lit;
}

/// The solution of a band, times the factor.
void repeat(RadiositySolution& solution, const RepeatedBand& r) {
  solution.radiosity.col(r.band) = r.factor * solution.radiosity.col(r.of);
  solution.irradiance.col(r.band) = r.factor * solution.irradiance.col(r.of);
  BandReport report = solution.bands[static_cast<std::size_t>(r.of)];
  report.rms_error_bound *= std::abs(r.factor);
  report.max_error_bound *= std::abs(r.factor);
  report.norm_error_bound *= std::abs(r.factor);
  solution.bands[static_cast<std::size_t>(r.band)] = report;
}

/// The factor by which light grows or fades from bounce to bounce, per band: the power method from
/// values without a pattern.
ArrayXd bounce_growth(const ExchangeAreas& exchange, const Reflector& reflector) {
  constexpr int kBounces = 60, kAveraged = 30;
  constexpr double kGoldenRatio = 0.6180339887498949;
  double seed = 0;
  Bands light = Bands::NullaryExpr(exchange.rows(), reflector.bands(), [&] {
    seed = std::fmod(seed + kGoldenRatio, 1);
    return seed;
  });
  ArrayXd log_growth = ArrayXd::Zero(reflector.bands());
  for (int bounce = 0; bounce < kBounces; ++bounce) {
    light = reflector.reflect(gather(exchange, light));
    const ArrayXd size =
        reflector.pooled(light.matrix().colwise().squaredNorm().transpose()).sqrt();
    light.rowwise() /= (size > 0).select(size, 1.0).transpose();
    if (bounce >= kBounces - kAveraged) log_growth += size.log();
  }
  return (log_growth / kAveraged).exp();
}

MethodResult run(const RadiositySystem& system, const RadiosityOptions& options) {
  if (!(system.contraction < 1).all()) {
    return {certify(system, system.emission, options.relative_error),
            Eigen::ArrayXi::Ones(system.bands())};
  }
  switch (options.method) {
    case Method::jacobi:
      return jacobi(system, options);
    case Method::gauss_seidel:
      return gauss_seidel(system, options);
    case Method::progressive:
      return progressive(system, options);
    case Method::direct:
      return direct(system, options);
    case Method::bicgstab:
      return bicgstab(system, options);
    case Method::automatic:
    case Method::conjugate_gradients:
      break;
  }
  return lockstep_conjugate_gradients(system, options);
}

/// What a method found for the bands `lit`.
void put(const MethodResult& result, const RadiositySystem& system, const std::vector<Index>& lit,
         RadiositySolution& solution) {
  const Certificate& proof = result.certificate;
  const double root_total_area = std::sqrt(system.exchange.total_area_m2());
  const double gather_norm = system.exchange.gather_norm.maxCoeff();
  for (std::size_t k = 0; k < lit.size(); ++k) {
    const auto column = static_cast<Index>(k);
    solution.radiosity.col(lit[k]) = proof.radiosity.col(column);
    solution.irradiance.col(lit[k]) = proof.irradiance.col(column);
    solution.bands[static_cast<std::size_t>(lit[k])] = {
        .iterations = result.iterations[column],
        .rms_error_bound = proof.norm[column] / root_total_area,
        .max_error_bound = proof.norm[column] * gather_norm,
        .norm_error_bound = proof.norm[column] * system.contraction[column],
        .contraction = system.contraction[column],
        .converged = proof.norm[column] <= proof.allowed[column]};
  }
}

}  // namespace

RadiositySolution solve_radiosity(const ExchangeAreas& exchange, const Bands& emission,
                                  const Bands& direct, const Bands& reflectance,
                                  const RadiosityOptions& options) {
  require_physical(exchange.patches(), emission, direct, reflectance);
  return solve_radiosity(exchange, emission, direct, Reflector(reflectance), options);
}

RadiositySolution solve_radiosity(const ExchangeAreas& exchange, const Bands& emission,
                                  const Bands& direct, const Reflector& reflector,
                                  const RadiosityOptions& options) {
  check(exchange, emission, direct, reflector, options);
  RadiositySolution solution{
      .radiosity = emission,
      .irradiance = Bands::Zero(emission.rows(), emission.cols()),
      .bands = std::vector<BandReport>(static_cast<std::size_t>(emission.cols())),
      .method = method_for(reflector, options.method),
      .converged = true};
  std::vector<Index> lit = lit_bands(emission, direct, reflector, options.skip);
  std::vector<RepeatedBand> repeats;
  if (options.skip && !reflector.couples_bands()) {
    Bands light(2 * emission.rows(), emission.cols());
    light << emission, direct;
    repeats = take_repeated_bands(light, reflector.numbers(), lit);
  }
  if (lit.empty()) return solution;

  RadiositySystem system{.exchange = exchange,
                         .emission = emission(Eigen::all, lit),
                         .direct = direct(Eigen::all, lit),
                         .reflector = reflector.columns(lit),
                         .contraction = {}};
  system.contraction = system.reflector.contraction();
  solution.proven = exchange.modes == 1 && (system.contraction < 1).all();
  if (!(system.contraction < 1).all()) {
    const ArrayXd proven = system.contraction;
    system.contraction =
        (proven < 1).select(proven, bounce_growth(exchange, system.reflector).min(proven));
  }
  RadiosityOptions chosen = options;
  chosen.method = solution.method;
  const MethodResult result = run(system, chosen);
  put(result, system, lit, solution);
  for (const RepeatedBand& r : repeats) repeat(solution, r);
  solution.converged = result.certificate.converged() && exchange.closure_defect <= kClosed;
  return solution;
}

}  // namespace solver
