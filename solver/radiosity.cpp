#include "solver/radiosity.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "solver/far_field.h"
#include "solver/radiosity_methods.h"

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kClosed = 1e-9;  ///< closure defect up to which F has norm 1, as bounds assume

void require(bool holds, const char* what, double value, const char* wanted) {
  if (!holds) throw std::invalid_argument(fmt::format("{} {}; want {}", what, value, wanted));
}

void check(const ExchangeAreas& exchange, const Bands& emission, const Bands& direct,
           const Bands& reflectance, const RadiosityOptions& options) {
  for (const Bands* b : {&emission, &direct, &reflectance}) {
    if (b->rows() != exchange.patches() || b->cols() != emission.cols()) {
      throw std::invalid_argument(fmt::format("{} x {} values; want {} patches x {} bands",
                                              b->rows(), b->cols(), exchange.patches(),
                                              emission.cols()));
    }
  }
  // Written so that NaN fails too.
  require((emission >= 0 && emission.isFinite()).all(), "emission down to", emission.minCoeff(),
          "0 or more");
  require((direct >= 0 && direct.isFinite()).all(), "direct irradiance down to", direct.minCoeff(),
          "0 or more");
  require((reflectance >= 0 && reflectance < 1).all(), "reflectance up to", reflectance.maxCoeff(),
          "0 to below 1");
  require(options.relative_error > 0, "relative error", options.relative_error, "more than 0");
  require(options.max_iterations > 0, "iterations", options.max_iterations, "more than 0");
}

/// Columns of `b` that carry light.
std::vector<Index> lit_bands(const Bands& emission, const Bands& direct) {
  std::vector<Index> lit;
  for (Index k = 0; k < emission.cols(); ++k) {
    if ((emission.col(k) > 0).any() || (direct.col(k) > 0).any()) lit.push_back(k);
  }
  return lit;
}

MethodResult run(const RadiositySystem& system, const RadiosityOptions& options) {
  switch (options.method) {
    case Method::jacobi:
      return jacobi(system, options);
    case Method::gauss_seidel:
      return gauss_seidel(system, options);
    case Method::progressive:
      return progressive(system, options);
    case Method::direct:
      return direct(system, options);
    case Method::conjugate_gradients:
      break;
  }
  return lockstep_conjugate_gradients(system, options);
}

}  // namespace

const char* to_string(Method method) {
  switch (method) {
    case Method::jacobi:
      return "jacobi";
    case Method::gauss_seidel:
      return "gauss-seidel";
    case Method::progressive:
      return "progressive";
    case Method::direct:
      return "direct";
    case Method::conjugate_gradients:
      break;
  }
  return "cg";
}

Bands gather(const ExchangeAreas& exchange, const Bands& v) {
  const Index n = v.rows(), pad = static_cast<Index>(kColumnPad);
  const Index columns = (v.cols() + pad - 1) / pad * pad;
  const Index rows = Index{exchange.unscaled.blocks} * kTile;
  Bands in = Bands::Zero(rows, columns), out(rows, columns);
  in.topLeftCorner(n, v.cols()) = v.colwise() * exchange.scaling;
  multiply(exchange.unscaled, in.data(), out.data(), static_cast<std::size_t>(columns));
  return out.topLeftCorner(n, v.cols()).colwise() * (exchange.scaling / exchange.area_m2);
}

Certificate certify(const RadiositySystem& system, const Bands& radiosity, double relative_error) {
  Certificate c;
  c.irradiance = gather(system.exchange, radiosity) + system.direct;
  c.radiosity = system.emission + system.reflectance * c.irradiance;
  c.change = c.radiosity - radiosity;
  const ArrayXd root_area = system.exchange.area_m2.sqrt();
  c.norm = (c.change.colwise() * root_area).matrix().colwise().norm().transpose().array() *
           system.relative_error_factor;
  c.allowed = relative_error *
              (c.irradiance.colwise() * root_area).matrix().colwise().norm().transpose().array();
  return c;
}

RadiositySolution solve_radiosity(const ExchangeAreas& exchange, const Bands& emission,
                                  const Bands& direct, const Bands& reflectance,
                                  const RadiosityOptions& options) {
  check(exchange, emission, direct, reflectance, options);
  RadiositySolution solution{
      .radiosity = emission,
      .irradiance = Bands::Zero(emission.rows(), emission.cols()),
      .bands = std::vector<BandReport>(static_cast<std::size_t>(emission.cols())),
      .converged = true};
  const std::vector<Index> lit = lit_bands(emission, direct);
  if (lit.empty()) return solution;

  const ArrayXd highest = reflectance(Eigen::all, lit).colwise().maxCoeff().transpose();
  const RadiositySystem system{.exchange = exchange,
                               .emission = emission(Eigen::all, lit),
                               .direct = direct(Eigen::all, lit),
                               .reflectance = reflectance(Eigen::all, lit),
                               .relative_error_factor = (1 - highest).inverse()};
  const MethodResult result = run(system, options);
  const Certificate& proof = result.certificate;
  const double root_total_area = std::sqrt(exchange.area_m2.sum());
  const double gather_norm = exchange.gather_norm.maxCoeff();
  for (std::size_t k = 0; k < lit.size(); ++k) {
    const auto column = static_cast<Index>(k);
    solution.radiosity.col(lit[k]) = proof.radiosity.col(column);
    solution.irradiance.col(lit[k]) = proof.irradiance.col(column);
    solution.bands[static_cast<std::size_t>(lit[k])] = {
        .iterations = result.iterations[column],
        .rms_error_bound = proof.norm[column] / root_total_area,
        .max_error_bound = proof.norm[column] * gather_norm,
        .norm_error_bound = proof.norm[column] * highest[column],
        .converged = proof.norm[column] <= proof.allowed[column]};
  }
  solution.converged = proof.converged() && exchange.closure_defect <= kClosed;
  return solution;
}

}  // namespace solver
